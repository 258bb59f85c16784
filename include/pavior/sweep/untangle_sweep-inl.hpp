#pragma once

#include <pavior/math/quadrilateral.hpp>
#include <pavior/smooth/detail/cell_shape.hpp>
#include <pavior/smooth/detail/untangle.hpp>
#include <pavior/smooth/hexes.hpp>
#include <pavior/sweep/untangle_sweep.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace pavior {

namespace detail {

/// The shapes that the hexahedra of a sweep should have: its source cap extruded straight along its normal by layers of
/// the mean thickness. Node numbers as in the sweep.
[[nodiscard]] inline std::vector<Vec3> straight_sweep(const SweepMesh& swept, const Loops& loops) {
    const std::span<const Vec3> source = swept.level(0);
    double extent = 0;
    for (const Vec3& x : source) {
        extent = std::max(extent, (x - source[0]).stableNorm());
    }
    const auto local = [&](Index i) { return Vec3((source[i] - source[0]) / extent); };  // squares must not overflow
    Vec3 area = Vec3::Zero();
    for (const QuadCorners& q : swept.quads()) {
        area += quad_vector_area({local(q[0]), local(q[1]), local(q[2]), local(q[3])});
    }
    double length = 0;
    for (std::size_t k = 0; k < swept.layer_count(); ++k) {
        for (const Index node : loops.nodes) {
            length += (swept.level(k + 1)[node] - swept.level(k)[node]).stableNorm();
        }
    }
    const Vec3 step = area.normalized() * (length / static_cast<double>(swept.layer_count() * loops.nodes.size()));
    std::vector<Vec3> nodes;
    nodes.reserve(swept.nodes().size());
    for (std::size_t k = 0; k <= swept.layer_count(); ++k) {
        for (const Vec3& x : source) {
            nodes.emplace_back(x + static_cast<double>(k) * step);
        }
    }
    return nodes;
}

/// The smallest scaled Jacobian of the implicit hexahedra (as in SmoothReport); 1 without any.
[[nodiscard]] inline double least_scaled_jacobian(const SweepMesh& swept) {
    const std::span<const Vec3> nodes = swept.nodes();
    const double unit = unit_of<3>(nodes);
    double least = 1.0;
    for (std::size_t h = 0; h < swept.hex_count(); ++h) {
        const CellPoints<3> cell = cell_points<3>(nodes, swept.hex(h), unit);
        least = std::min(least, scaled_jacobian<3>(cell, sample_count<3>(UntangleOptions{}.positivity)));
    }
    return least;
}

}  // namespace detail

PAVIOR_INLINE SmoothReport untangle_sweep(SweepMesh& swept, const Loops& loops, const Execution& execution) {
    const double least = detail::least_scaled_jacobian(swept);
    if (least > detail::inverted_tolerance) {
        SmoothReport untouched;
        untouched.min_det_before = untouched.min_det_after = least;
        return untouched;
    }
    std::vector<std::uint8_t> fixed(swept.nodes().size(), 0);
    const std::size_t n = swept.level_size();
    for (std::size_t k = 0; k <= swept.layer_count(); ++k) {
        const bool cap = k == 0 || k == swept.layer_count();
        std::fill_n(fixed.begin() + static_cast<std::ptrdiff_t>(k * n), cap ? n : 0, std::uint8_t{1});
        for (const Index node : loops.nodes) {
            fixed[k * n + node] = 1;
        }
    }
    UntangleOptions options;
    options.execution = execution;
    return untangle_hexes(swept.nodes(), swept.hexes(), fixed, options, detail::straight_sweep(swept, loops));
}

}  // namespace pavior
