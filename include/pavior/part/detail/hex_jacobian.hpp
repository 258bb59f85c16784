#pragma once
/// \file
/// Scaled Jacobians of single hexahedra of a mesh.

#include <pavior/math/hexahedron.hpp>
#include <pavior/mesh/span_mesh.hpp>

#include <algorithm>
#include <cstddef>

namespace pavior::detail {

/// hex_scaled_jacobian() of hexahedron \p h.
[[nodiscard]] inline double scaled_jacobian(const HexMesh& mesh, std::size_t h) {
    HexPoints x;
    for (std::size_t k = 0; k < x.size(); ++k) {
        x[k] = mesh.nodes[mesh.hexes[h][k]];
    }
    return hex_scaled_jacobian(x);
}

/// The least of all, 1 without hexahedra.
[[nodiscard]] inline double least_scaled_jacobian(const HexMesh& mesh) {
    double least = 1;
    for (std::size_t h = 0; h < mesh.hexes.size(); ++h) {
        least = std::min(least, scaled_jacobian(mesh, h));
    }
    return least;
}

}  // namespace pavior::detail
