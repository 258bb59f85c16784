#pragma once

#include <pavior/dual/verify_dual.hpp>
#include <pavior/marking/cell_snapshot.hpp>
#include <pavior/math/hexahedron.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

namespace pavior {

PAVIOR_INLINE CellSnapshot cell_snapshot(const ReferenceMesh& mesh, const Execution& execution) {
    CellSnapshot s;
    s.topology = tet_topology(mesh, execution);
    s.classes = classify(mesh, s.topology, execution);
    s.complex = cell_complex(mesh, s.topology, s.classes, execution);
    s.report = verify_dual(mesh, s.topology, s.classes, s.complex, execution);
    return s;
}

namespace detail {

/// The point at half the length of a polyline.
[[nodiscard]] inline Vec3 halfway(std::span<const Vec3> nodes, std::span<const Index> path) {
    double length = 0;
    for (std::size_t i = 0; i + 1 < path.size(); ++i) {
        length += (nodes[path[i + 1]] - nodes[path[i]]).norm();
    }
    double left = 0.5 * length;
    for (std::size_t i = 0; i + 1 < path.size(); ++i) {
        const double step = (nodes[path[i + 1]] - nodes[path[i]]).norm();
        if (step >= left && step > 0) {
            return nodes[path[i]] + left / step * (nodes[path[i + 1]] - nodes[path[i]]);
        }
        left -= step;
    }
    return nodes[path.back()];
}

/// Centroids of the patches (by area) and cells (by volume).
struct CellCentres {
    std::vector<Vec3> chains;
    std::vector<Vec3> patches;
    std::vector<Vec3> cells;
};

[[nodiscard]] inline CellCentres cell_centres(const ReferenceMesh& mesh, const CellSnapshot& s) {
    CellCentres out;
    for (const Index c : IndexRange(s.complex.chains.size())) {
        out.chains.push_back(halfway(mesh.nodes, s.complex.chain_path(c)));
    }
    const auto weigh = [](std::vector<Vec3>& sums, std::vector<double>& weights) {
        for (std::size_t i = 0; i < sums.size(); ++i) {
            sums[i] /= std::max(weights[i], std::numeric_limits<double>::min());
        }
    };
    std::vector<double> weights(s.complex.patches.size(), 0);
    out.patches.assign(s.complex.patches.size(), Vec3(0, 0, 0));
    for (const Index f : IndexRange(s.topology.faces.size())) {
        if (const Index p = s.complex.face_patch[f]; p != no_index) {
            const auto& [a, b, c] = s.topology.faces[f];
            const double w = (mesh.nodes[b] - mesh.nodes[a]).cross(mesh.nodes[c] - mesh.nodes[a]).norm();
            out.patches[p] += w / 3 * (mesh.nodes[a] + mesh.nodes[b] + mesh.nodes[c]);
            weights[p] += w;
        }
    }
    weigh(out.patches, weights);
    weights.assign(s.complex.cells.size(), 0);
    out.cells.assign(s.complex.cells.size(), Vec3(0, 0, 0));
    for (const Index t : IndexRange(mesh.tets.size())) {
        const auto& [a, b, c, d] = mesh.tets[t];
        const Vec3& x = mesh.nodes[a];
        const double w = std::abs((mesh.nodes[b] - x).cross(mesh.nodes[c] - x).dot(mesh.nodes[d] - x));
        out.cells[s.complex.tet_cell[t]] += w / 4 * (x + mesh.nodes[b] + mesh.nodes[c] + mesh.nodes[d]);
        weights[s.complex.tet_cell[t]] += w;
    }
    weigh(out.cells, weights);
    return out;
}

}  // namespace detail

PAVIOR_INLINE CellQuality simple_quality(const ReferenceMesh& mesh, const CellSnapshot& s) {
    const detail::CellCentres at = detail::cell_centres(mesh, s);
    CellQuality least{1, 1};
    for (const CellCorner& k : s.complex.corners) {
        if (!k.regular()) {
            return {};
        }
        const HexPoints x{mesh.nodes[s.complex.vertices[k.vertex]],
                          at.chains[k.chains[0]],
                          at.patches[k.patches[0]],
                          at.chains[k.chains[1]],
                          at.chains[k.chains[2]],
                          at.patches[k.patches[2]],
                          at.cells[k.cell],
                          at.patches[k.patches[1]]};
        least.jacobian = std::min(least.jacobian, hex_scaled_jacobian(x));
        double shortest = std::numeric_limits<double>::infinity();
        double longest = 0;
        for (std::size_t corner = 0; corner < 8; ++corner) {
            for (const int n : hex_corner_neighbours[corner]) {
                const double edge = (x[static_cast<std::size_t>(n)] - x[corner]).norm();
                shortest = std::min(shortest, edge);
                longest = std::max(longest, edge);
            }
        }
        least.aspect = std::min(least.aspect, longest > 0 ? shortest / longest : 0.0);
    }
    return least;
}

}  // namespace pavior
