#pragma once

#include <pavior/many_to_many/multi_sweep.hpp>
#include <pavior/smooth/hexes.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace pavior {

namespace detail {

PAVIOR_INLINE std::vector<double> edge_sizes(const ExtrudedBody& body, const PlaneArrangement& plane, double size) {
    std::vector<double> result(plane.edges.size(), 0);
    for (Index c = 0; c < plane.routes.size(); ++c) {
        for (const OrientedPlaneEdge& use : plane.routes[c]) {
            const double own = body.curves[c].size > 0 ? body.curves[c].size : size;
            result[use.edge] = result[use.edge] > 0 ? std::min(result[use.edge], own) : own;
        }
    }
    return result;
}

PAVIOR_INLINE double height_range(const ExtrudedBody& body) {
    double low = body.vertices.empty() ? 0 : body.vertices[0][2];
    double high = low;
    for (const Vec3& v : body.vertices) {
        low = std::min(low, v[2]);
        high = std::max(high, v[2]);
    }
    return high - low;
}

PAVIOR_INLINE SmoothReport smooth_columns(LayeredHexes& mesh, const Execution& execution) {
    std::vector<std::uint8_t> fixed(mesh.mesh.nodes.size(), 0);
    for (const QuadCorners& quad : mesh.quads) {
        for (const Index i : quad) {
            fixed[i] = 1;
        }
    }
    UntangleOptions options;
    options.execution = execution;
    options.max_iterations = 40;
    options.inner_iterations = 50;
    return untangle_hexes(mesh.mesh.nodes, mesh.mesh.hexes, fixed, options);
}

PAVIOR_INLINE void check_multi_sweep(const ExtrudedBody& body, const MultiSweepOptions& options) {
    const auto require = [](bool condition, const char* text) {
        if (!condition) {
            throw InputError(ErrorCode::bad_option, text);
        }
    };
    require(options.size > 0 && std::isfinite(options.size), "MultiSweepOptions::size must be positive");
    require(options.max_angle > 0, "MultiSweepOptions::max_angle must be positive");
    require(options.chord > 0 && options.chord <= 0.1, "MultiSweepOptions::chord must lie in (0, 0.1]");
    require(options.merge >= 0 && options.merge <= 0.5, "MultiSweepOptions::merge must lie in [0, 0.5]");
    if (body.caps.empty()) {
        throw InputError(ErrorCode::empty_input, "the body has no caps");
    }
    if (body.plane.size() != body.curves.size()) {
        throw InputError(ErrorCode::size_mismatch, "one polyline a curve expected");
    }
}

}  // namespace detail

}  // namespace pavior
