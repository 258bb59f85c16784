#pragma once
/// \file
/// Linking sides that lie above each other along the sweep: a search for consistent logical sides.

#include <pavior/one_to_one/side_roles.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace pavior {

/// Which vertices of a side face may be corners of its logical rectangle, or union of rectangles. Only for solids with
/// sides above each other.
struct StackingOptions {
    double corner_tolerance = 65.0;   ///< a corner's interior angle is 90 +- this, degrees
    double notch_tolerance = 40.0;    ///< a corner between two parts of an L-shaped side has 270 +- this, degrees
    double kink_tolerance = 50.0;     ///< at a vertex inside a logical side it is 180 +- this, degrees
    std::size_t max_tests = 5000000;  ///< ways to see a face tried for one solid before the search gives up
};

namespace detail {

/// A role for each half-edge of a face.
using RolePattern = std::vector<SideRole>;

/// All ways to see each face of a solid as a rectangle, or a union of rectangles, that its angles allow, best angles
/// first. Independent of the caps, so made once a solid.
class RolePatterns {
public:
    RolePatterns(const SolidBoundary& solid, const StackingOptions& options) : patterns_(solid.faces.size()) {
        for (std::size_t face = 0; face < solid.faces.size(); ++face) {
            make(solid, solid.faces[face], options, patterns_[face]);
        }
    }

    [[nodiscard]] const std::vector<RolePattern>& operator[](std::size_t face) const { return patterns_[face]; }

private:
    using Weighted = std::vector<std::pair<double, RolePattern>>;
    static constexpr std::size_t max_free = 12;  ///< of the vertices that may be corners, the sharpest are tried

    static void make(const SolidBoundary& solid, const SolidBoundary::Face& f, const StackingOptions& options,
                     std::vector<RolePattern>& result) {
        std::vector<double> angles;
        std::vector<int> turns;         // quarters at each vertex
        std::vector<std::size_t> free;  // vertices that may be corners or not
        int missing = 4;
        for (std::size_t h = f.begin; h < f.end; ++h) {
            const double angle = solid.half_edges[h].angle;
            const bool corner = std::abs(angle - 90.0) <= options.corner_tolerance;
            const bool kink = std::abs(angle - 180.0) <= options.kink_tolerance;
            const bool notch = !kink && std::abs(angle - 270.0) <= options.notch_tolerance;
            if (f.loops.size() != 1 || (!corner && !kink && !notch)) {
                return;
            }
            if (corner && kink) {
                free.push_back(h - f.begin);
            }
            turns.push_back(notch ? -1 : corner && !kink ? 1 : 0);
            missing -= turns.back();
            angles.push_back(angle);
        }
        std::stable_sort(free.begin(), free.end(), [&](auto p, auto q) { return angles[p] < angles[q]; });
        free.resize(std::min(free.size(), max_free));
        Weighted weighted;
        choose_corners(angles, free, 0, missing, turns, weighted);
        std::stable_sort(weighted.begin(), weighted.end(),
                         [](const auto& a, const auto& b) { return a.first < b.first; });
        for (auto& [weight, pattern] : weighted) {
            result.push_back(std::move(pattern));
        }
    }

    /// Makes \p missing more corners of vertices of \p free from position \p at on, in all ways.
    static void choose_corners(const std::vector<double>& angles, const std::vector<std::size_t>& free, std::size_t at,
                               int missing, std::vector<int>& turns, Weighted& result) {
        if (missing == 0) {
            add_rotations(angles, turns, result);
        }
        for (std::size_t i = at; missing > 0 && i < free.size(); ++i) {
            turns[free[i]] = 1;
            choose_corners(angles, free, i + 1, missing - 1, turns, result);
            turns[free[i]] = 0;
        }
    }

    static void add_rotations(const std::vector<double>& angles, const std::vector<int>& turns, Weighted& result) {
        double weight = 0.0;
        for (std::size_t i = 0; i < angles.size(); ++i) {
            weight += std::abs(angles[i] - (180.0 - 90.0 * turns[i]));
        }
        for (int rotation = 0; rotation < 4; ++rotation) {
            RolePattern pattern(angles.size());
            int role = 3 + rotation;
            for (std::size_t i = 0; i < angles.size(); ++i) {
                role += turns[i] + 4;
                pattern[i] = static_cast<SideRole>(role % 4);
            }
            result.emplace_back(weight, std::move(pattern));
        }
    }

    std::vector<std::vector<RolePattern>> patterns_;
};

/// Depth-first search over the ways to see each side face as a rectangle, most constrained face first, best angles
/// first; the first consistent assignment that makes a sweep is taken.
class StackingSearch {
public:
    /// \p tests_left counts down the ways to see a face that are tried, over all searches of a solid.
    StackingSearch(const SolidBoundary& solid, const RolePatterns& patterns, std::size_t source, std::size_t target,
                   std::size_t& tests_left)
        : solid_(solid), patterns_(patterns), source_(source), target_(target), tests_left_(tests_left) {}

    [[nodiscard]] std::optional<SweepTopology> run() {
        if (possible()) {
            roles_.assign(solid_.half_edges.size(), SideRole::none);
            done_.assign(solid_.faces.size(), false);
            done_[source_] = done_[target_] = true;
            extend();
        }
        return std::move(found_);
    }

private:
    /// Every side face has a pattern.
    [[nodiscard]] bool possible() const {
        for (std::size_t face = 0; face < solid_.faces.size(); ++face) {
            if (face != source_ && face != target_ && patterns_[face].empty()) {
                return false;
            }
        }
        return true;
    }

    /// The pattern agrees with the caps and the roles given so far. \p known counts the half-edges that it had to meet.
    [[nodiscard]] bool fits(std::size_t face, const RolePattern& pattern, std::size_t& known) const {
        known = 0;
        for (std::size_t i = 0; i < pattern.size(); ++i) {
            const std::size_t h = solid_.faces[face].begin + i, twin = solid_.half_edges[h].twin;
            const std::size_t other = solid_.half_edges[twin].face;
            SideRole wanted = other == source_ ? SideRole::bottom : other == target_ ? SideRole::top : SideRole::none;
            if (other == face) {
                wanted = opposite(pattern[twin - solid_.faces[face].begin]);
            } else if (wanted == SideRole::none) {
                wanted = opposite(roles_[twin]);
            }
            if (wanted != SideRole::none) {
                ++known;
                if (pattern[i] != wanted) {
                    return false;
                }
            }
        }
        return true;
    }

    /// The patterns of a face that fit; \p known tells whether the face had anything to meet.
    [[nodiscard]] std::vector<const RolePattern*> fitting_patterns(std::size_t face, bool& known) {
        std::vector<const RolePattern*> result;
        std::size_t met = 0;
        known = false;
        for (const RolePattern& pattern : patterns_[face]) {
            if (fits(face, pattern, met)) {
                result.push_back(&pattern);
            }
            known = known || met != 0;
        }
        tests_left_ -= std::min(tests_left_, patterns_[face].size());
        return result;
    }

    /// The unfinished face with the fewest fitting patterns, of those that have something to meet if there are any;
    /// faces.size() if all are done.
    [[nodiscard]] std::size_t pick(std::vector<const RolePattern*>& fitting) {
        std::size_t best = solid_.faces.size();
        std::pair<bool, std::size_t> best_rank;
        for (std::size_t face = 0; face < solid_.faces.size(); ++face) {
            if (done_[face]) {
                continue;
            }
            bool known = false;
            std::vector<const RolePattern*> candidates = fitting_patterns(face, known);
            const std::pair rank(!known, candidates.size());
            if (best == solid_.faces.size() || rank < best_rank) {
                best = face;
                best_rank = rank;
                fitting = std::move(candidates);
            }
            if (best_rank.second == 0) {
                break;
            }
        }
        return best;
    }

    void extend() {
        std::vector<const RolePattern*> fitting;
        const std::size_t face = pick(fitting);
        if (face == solid_.faces.size()) {
            found_ = sweep_from_roles(solid_, source_, target_, roles_);
            return;
        }
        done_[face] = true;
        for (const RolePattern* pattern : fitting) {
            if (found_ || tests_left_ == 0) {
                break;
            }
            std::copy(pattern->begin(), pattern->end(), roles_.begin() + offset(face));
            extend();
        }
        std::fill(roles_.begin() + offset(face), roles_.begin() + end_offset(face), SideRole::none);
        done_[face] = false;
    }

    [[nodiscard]] std::ptrdiff_t offset(std::size_t face) const {
        return static_cast<std::ptrdiff_t>(solid_.faces[face].begin);
    }
    [[nodiscard]] std::ptrdiff_t end_offset(std::size_t face) const {
        return static_cast<std::ptrdiff_t>(solid_.faces[face].end);
    }

    const SolidBoundary& solid_;
    const RolePatterns& patterns_;
    std::size_t source_, target_;
    std::size_t& tests_left_;
    std::vector<SideRole> roles_;
    std::vector<bool> done_;
    std::optional<SweepTopology> found_;
};

/// A sweep from \p source to \p target (positions) with sides above each other, or nothing. Exact for the angles that
/// \p patterns allow as long as \p tests_left, which is counted down, does not reach 0.
[[nodiscard]] inline std::optional<SweepTopology> find_stacked_sweep(const SolidBoundary& solid,
                                                                     const RolePatterns& patterns, std::size_t source,
                                                                     std::size_t target, std::size_t& tests_left) {
    return tests_left == 0 ? std::nullopt : StackingSearch(solid, patterns, source, target, tests_left).run();
}

}  // namespace detail

}  // namespace pavior
