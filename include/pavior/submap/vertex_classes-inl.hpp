#pragma once

#include <pavior/submap/vertex_classes.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace pavior {

PAVIOR_INLINE std::vector<Umbrella> umbrellas(const SolidBoundary& boundary) {
    std::vector<std::size_t> previous(boundary.half_edges.size());
    for (std::size_t h = 0; h < previous.size(); ++h) {
        previous[boundary.half_edges[h].next] = h;
    }
    std::vector<Umbrella> result;
    std::vector<bool> seen(previous.size(), false);
    for (std::size_t first = 0; first < previous.size(); ++first) {
        if (seen[first]) {
            continue;
        }
        Umbrella umbrella{boundary.half_edges[first].start, {}};
        for (std::size_t h = first; !seen[h]; h = boundary.half_edges[previous[h]].twin) {
            seen[h] = true;
            umbrella.half_edges.push_back(h);
        }
        result.push_back(std::move(umbrella));
    }
    return result;
}

PAVIOR_INLINE std::vector<std::uint8_t> dihedral_classes(double angle, const CornerOptions& options) {
    std::vector<std::uint8_t> result;
    for (const CornerClass c : corner_classes(angle, options)) {
        result.push_back(static_cast<std::uint8_t>(c));
    }
    return result;
}

namespace detail {

PAVIOR_INLINE UmbrellaSearch::UmbrellaSearch(std::span<const double> corners, std::span<const double> dihedrals,
                                             const CornerOptions& options)
    : corners_(corners), dihedrals_(dihedrals) {
    for (std::size_t i = 0; i < corners.size(); ++i) {
        corner_choice_.push_back(corner_classes(corners[i], options));
        dihedral_choice_.push_back(dihedral_classes(dihedrals[i], options));
    }
    current_.corner.resize(corners.size());
    current_.dihedral.resize(corners.size());
    step(0, SignedAxis{1}, SignedAxis{3});
}

PAVIOR_INLINE void UmbrellaSearch::step(std::size_t i, SignedAxis d, SignedAxis n) {
    const std::size_t count = corners_.size();
    if (++steps_ > max_steps) {
        return;
    }
    if (i == count) {
        if (d == SignedAxis{1} && n == SignedAxis{3} && sound()) {
            found_.push_back(current_);
        }
        return;
    }
    const std::size_t next = (i + 1) % count;
    for (const CornerClass c : corner_choice_[i]) {
        const SignedAxis d_next = turned(d, n, static_cast<int>(c));
        for (const std::uint8_t m : dihedral_choice_[next]) {
            const double cost =
                corner_cost(corners_[i], c) + 0.5 * corner_cost(dihedrals_[next], static_cast<CornerClass>(m));
            current_.corner[i] = c;
            current_.dihedral[next] = m;
            current_.cost += cost;
            step(i + 1, d_next, turned(n, d_next, m - 2));
            current_.cost -= cost;
        }
    }
}

PAVIOR_INLINE bool UmbrellaSearch::sound() const {
    int octants = 4 - 2 * static_cast<int>(corners_.size());
    for (const std::uint8_t m : current_.dihedral) {
        octants += m;
    }
    return octants >= 1 && octants <= 8;
}

}  // namespace detail

}  // namespace pavior
