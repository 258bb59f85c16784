#pragma once

#include <pavior/brep/edge_mesh.hpp>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace pavior {

namespace detail {

PAVIOR_INLINE double ArcLength::parameter(double s) const {
    const auto above = std::upper_bound(length.begin() + 1, length.end() - 1, s);
    const auto i = static_cast<std::size_t>(above - length.begin()) - 1;
    const double width = length[i + 1] - length[i];
    const double part = width > 0 ? std::clamp((s - length[i]) / width, 0.0, 1.0) : 0.0;
    return first + step * (static_cast<double>(i) + part);
}

}  // namespace detail

PAVIOR_INLINE std::vector<double> equal_fractions(int intervals) {
    std::vector<double> fractions;
    for (int i = 0; i <= intervals; ++i) {
        fractions.push_back(static_cast<double>(i) / intervals);
    }
    return fractions;
}

}  // namespace pavior
