#pragma once

#include <pavior/one_to_one/side_roles.hpp>
#include <pavior/one_to_one/side_stacking.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace pavior {

namespace detail {

PAVIOR_INLINE void RolePatterns::make(const SolidBoundary& solid, const SolidBoundary::Face& f,
                                      const StackingOptions& options, std::vector<RolePattern>& result) {
    std::vector<double> angles;
    std::vector<int> turns;         // quarters at each vertex
    std::vector<std::size_t> free;  // vertices that may be corners or not
    std::vector<std::size_t> notches;
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
        if (notch && options.flat_notches && notches.size() < max_notches) {
            notches.push_back(h - f.begin);
        }
        turns.push_back(notch ? -1 : corner && !kink ? 1 : 0);
        missing -= turns.back();
        angles.push_back(angle);
    }
    std::stable_sort(free.begin(), free.end(), [&](auto p, auto q) { return angles[p] < angles[q]; });
    free.resize(std::min(free.size(), max_free));
    Weighted weighted;
    flatten_notches(angles, notches, 0, free, missing, turns, weighted);
    std::stable_sort(weighted.begin(), weighted.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    for (auto& [weight, pattern] : weighted) {
        result.push_back(std::move(pattern));
    }
}

PAVIOR_INLINE void RolePatterns::choose_corners(const std::vector<double>& angles, const std::vector<std::size_t>& free,
                                                std::size_t at, int missing, std::vector<int>& turns,
                                                Weighted& result) {
    if (missing == 0) {
        add_rotations(angles, turns, result);
    }
    for (std::size_t i = at; missing > 0 && i < free.size(); ++i) {
        turns[free[i]] = 1;
        choose_corners(angles, free, i + 1, missing - 1, turns, result);
        turns[free[i]] = 0;
    }
}

PAVIOR_INLINE void RolePatterns::flatten_notches(const std::vector<double>& angles,
                                                 const std::vector<std::size_t>& notches, std::size_t at,
                                                 const std::vector<std::size_t>& free, int missing,
                                                 std::vector<int>& turns, Weighted& result) {
    if (at == notches.size()) {
        choose_corners(angles, free, 0, missing, turns, result);
        return;
    }
    flatten_notches(angles, notches, at + 1, free, missing, turns, result);
    turns[notches[at]] = 0;
    flatten_notches(angles, notches, at + 1, free, missing - 1, turns, result);
    turns[notches[at]] = -1;
}

PAVIOR_INLINE void RolePatterns::add_rotations(const std::vector<double>& angles, const std::vector<int>& turns,
                                               Weighted& result) {
    constexpr double flattening = 360.0;  // more than all angles of a usual face are off
    double weight = 0.0;
    for (std::size_t i = 0; i < angles.size(); ++i) {
        const bool flat_notch = turns[i] == 0 && angles[i] > 230.0;
        weight += std::abs(angles[i] - (180.0 - 90.0 * turns[i])) + (flat_notch ? flattening : 0.0);
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

PAVIOR_INLINE std::optional<SweepTopology> StackingSearch::run() {
    if (possible()) {
        roles_.assign(solid_.half_edges.size(), SideRole::none);
        done_.assign(solid_.faces.size(), false);
        done_[source_] = done_[target_] = true;
        extend();
    }
    return std::move(found_);
}

PAVIOR_INLINE bool StackingSearch::possible() const {
    for (std::size_t face = 0; face < solid_.faces.size(); ++face) {
        if (face != source_ && face != target_ && patterns_[face].empty()) {
            return false;
        }
    }
    return true;
}

PAVIOR_INLINE bool StackingSearch::fits(std::size_t face, const RolePattern& pattern, std::size_t& known) const {
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

PAVIOR_INLINE std::vector<const RolePattern*> StackingSearch::fitting_patterns(std::size_t face, bool& known) {
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

PAVIOR_INLINE std::size_t StackingSearch::pick(std::vector<const RolePattern*>& fitting) {
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

PAVIOR_INLINE void StackingSearch::extend() {
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

}  // namespace detail

}  // namespace pavior
