#pragma once
/// \file
/// Linking sides that lie above each other along the sweep: a search for consistent logical sides.

#include <pavior/model/side_roles.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace pavior {

/// Which vertices of a side face may be corners of its logical rectangle. Only for solids with sides above each other.
struct StackingOptions {
    double corner_tolerance = 65.0;  ///< a corner's interior angle is 90 +- this, degrees
    double kink_tolerance = 50.0;    ///< at a vertex inside a logical side it is 180 +- this, degrees
    std::size_t max_steps = 2000;    ///< faces tried before the search for one pair of caps gives up
};

namespace detail {

/// Depth-first search over the ways to see each side face as a rectangle, most constrained face first, best angles
/// first; the first consistent assignment that makes a sweep is taken.
class StackingSearch {
public:
    StackingSearch(const SolidBoundary& solid, std::size_t source, std::size_t target, const StackingOptions& options)
        : solid_(solid),
          source_(source),
          target_(target),
          steps_left_(options.max_steps),
          roles_(solid.half_edges.size(), SideRole::none),
          patterns_(solid.faces.size()),
          done_(solid.faces.size(), false) {
        const std::vector<SideRole> direct = direct_roles(solid, source, target);
        for (std::size_t face = 0; face < solid.faces.size(); ++face) {
            done_[face] = face == source || face == target;
            if (!done_[face]) {
                patterns_[face] = make_patterns(face, options);
                add_direct(face, direct, options);
                possible_ = possible_ && !patterns_[face].empty();
            }
        }
    }

    [[nodiscard]] std::optional<SweepTopology> run() {
        if (possible_) {
            extend();
        }
        return std::move(found_);
    }

private:
    using Pattern = std::vector<SideRole>;  ///< a role for each half-edge of a face

    [[nodiscard]] bool corner_allowed(std::size_t h, const StackingOptions& options) const {
        return std::abs(solid_.half_edges[h].angle - 90.0) <= options.corner_tolerance;
    }
    [[nodiscard]] bool kink_allowed(std::size_t h, const StackingOptions& options) const {
        return std::abs(solid_.half_edges[h].angle - 180.0) <= options.kink_tolerance;
    }

    /// All ways to choose four corners of a face and one of them as start of the bottom, best angles first.
    [[nodiscard]] std::vector<Pattern> make_patterns(std::size_t face, const StackingOptions& options) const {
        std::vector<Pattern> result;
        const SolidBoundary::Face& f = solid_.faces[face];
        if (f.loops.size() != 1) {
            return result;
        }
        std::vector<std::size_t> free, corners;  // vertices that may be either, vertices that must be corners
        for (std::size_t h = f.begin; h < f.end; ++h) {
            const bool corner = corner_allowed(h, options), kink = kink_allowed(h, options);
            if (!corner && !kink) {
                return result;
            }
            if (corner) {
                (kink ? free : corners).push_back(h - f.begin);
            }
        }
        std::vector<std::pair<double, Pattern>> weighted;
        choose_corners(f, free, 0, corners, weighted);
        std::stable_sort(weighted.begin(), weighted.end(),
                         [](const auto& a, const auto& b) { return a.first < b.first; });
        for (auto& [weight, pattern] : weighted) {
            result.push_back(std::move(pattern));
        }
        return result;
    }

    /// A face that reaches from cap to cap by topology needs no angles but at the kinks of its ribs.
    void add_direct(std::size_t face, const std::vector<SideRole>& direct, const StackingOptions& options) {
        const SolidBoundary::Face& f = solid_.faces[face];
        if (f.loops.size() != 1 || !side_from_roles(solid_, face, direct)) {
            return;
        }
        for (std::size_t h = f.begin; h < f.end; ++h) {
            const SideRole role = direct[h];
            const bool inside = role == direct[h == f.begin ? f.end - 1 : h - 1];
            if (inside && (role == SideRole::left || role == SideRole::right) && !kink_allowed(h, options)) {
                return;
            }
        }
        patterns_[face].emplace(patterns_[face].begin(), direct.begin() + offset(face),
                                direct.begin() + end_offset(face));
    }

    void choose_corners(const SolidBoundary::Face& f, const std::vector<std::size_t>& free, std::size_t at,
                        std::vector<std::size_t>& corners, std::vector<std::pair<double, Pattern>>& result) const {
        if (corners.size() == 4) {
            add_rotations(f, corners, result);
        } else if (corners.size() < 4) {
            for (std::size_t i = at; i < free.size(); ++i) {
                corners.push_back(free[i]);
                choose_corners(f, free, i + 1, corners, result);
                corners.pop_back();
            }
        }
    }

    void add_rotations(const SolidBoundary::Face& f, std::vector<std::size_t> corners,
                       std::vector<std::pair<double, Pattern>>& result) const {
        std::sort(corners.begin(), corners.end());
        const std::size_t n = f.end - f.begin;
        double weight = 0.0;
        for (std::size_t i = 0; i < n; ++i) {
            const bool corner = std::binary_search(corners.begin(), corners.end(), i);
            weight += std::abs(solid_.half_edges[f.begin + i].angle - (corner ? 90.0 : 180.0));
        }
        for (std::size_t rotation = 0; rotation < 4; ++rotation) {
            Pattern pattern(n);
            for (std::size_t i = 0; i < n; ++i) {
                const auto passed = static_cast<std::size_t>(
                    std::upper_bound(corners.begin(), corners.end(), i) - corners.begin());
                pattern[i] = static_cast<SideRole>((passed + 3 + rotation) % 4);
            }
            result.emplace_back(weight, std::move(pattern));
        }
    }

    /// The pattern agrees with the caps and the roles given so far. \p known counts the half-edges that it had to meet.
    [[nodiscard]] bool fits(std::size_t face, const Pattern& pattern, std::size_t& known) const {
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
    [[nodiscard]] std::vector<const Pattern*> fitting_patterns(std::size_t face, bool& known) const {
        std::vector<const Pattern*> result;
        std::size_t met = 0;
        known = false;
        for (const Pattern& pattern : patterns_[face]) {
            if (fits(face, pattern, met)) {
                result.push_back(&pattern);
            }
            known = known || met != 0;
        }
        return result;
    }

    /// The unfinished face with the fewest fitting patterns, of those that have something to meet if there are any;
    /// faces.size() if all are done.
    [[nodiscard]] std::size_t pick(std::vector<const Pattern*>& fitting) const {
        std::size_t best = solid_.faces.size();
        std::pair<bool, std::size_t> best_rank;
        for (std::size_t face = 0; face < solid_.faces.size(); ++face) {
            if (done_[face]) {
                continue;
            }
            bool known = false;
            std::vector<const Pattern*> candidates = fitting_patterns(face, known);
            const std::pair rank(!known, candidates.size());
            if (best == solid_.faces.size() || rank < best_rank) {
                best = face;
                best_rank = rank;
                fitting = std::move(candidates);
            }
        }
        return best;
    }

    void extend() {
        std::vector<const Pattern*> fitting;
        const std::size_t face = pick(fitting);
        if (face == solid_.faces.size()) {
            found_ = sweep_from_roles(solid_, source_, target_, roles_);
            return;
        }
        done_[face] = true;
        for (const Pattern* pattern : fitting) {
            if (found_ || steps_left_ == 0) {
                break;
            }
            --steps_left_;
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
    std::size_t source_, target_;
    std::size_t steps_left_;
    std::vector<SideRole> roles_;
    std::vector<std::vector<Pattern>> patterns_;
    std::vector<bool> done_;
    bool possible_ = true;
    std::optional<SweepTopology> found_;
};

/// A sweep from \p source to \p target (positions) with sides above each other, or nothing. Exact for the angles
/// allowed by \p options as long as the search stays below options.max_steps.
[[nodiscard]] inline std::optional<SweepTopology> find_stacked_sweep(const SolidBoundary& solid, std::size_t source,
                                                                     std::size_t target,
                                                                     const StackingOptions& options) {
    return StackingSearch(solid, source, target, options).run();
}

}  // namespace detail

}  // namespace pavior
