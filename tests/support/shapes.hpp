#pragma once
// Small meshes made in code, shared by the tests of all rooms.

#include <pavior/mesh/span_mesh.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <random>
#include <vector>

namespace shapes {

using pavior::HexMesh;
using pavior::Index;
using pavior::QuadMesh;
using pavior::Vec3;

/// Height cos^2(pi x/2) cos^2(pi y/2): 1 in the middle of [-1, 1]^2, 0 with its gradient on the border.
inline double bump(double x, double y) {
    const double c = std::cos(std::numbers::pi * x / 2.0) * std::cos(std::numbers::pi * y / 2.0);
    return c * c;
}

/// m x n quads over [-1, 1]^2, raised by height * bump; node j * (m + 1) + i is column i of row j; normals +z.
inline QuadMesh grid_cap(std::size_t m, std::size_t n, double height = 0.0) {
    QuadMesh mesh;
    for (std::size_t j = 0; j <= n; ++j) {
        for (std::size_t i = 0; i <= m; ++i) {
            const double x = 2.0 * static_cast<double>(i) / static_cast<double>(m) - 1.0;
            const double y = 2.0 * static_cast<double>(j) / static_cast<double>(n) - 1.0;
            mesh.nodes.emplace_back(x, y, height * bump(x, y));
        }
    }
    const auto at = [m](std::size_t i, std::size_t j) { return static_cast<Index>(j * (m + 1) + i); };
    for (std::size_t j = 0; j < n; ++j) {
        for (std::size_t i = 0; i < m; ++i) {
            mesh.quads.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
        }
    }
    return mesh;
}

/// Keeps the quads that keep(centre) accepts and renumbers the nodes they use, in their old order.
template <class Keep>
QuadMesh subset(const QuadMesh& mesh, Keep&& keep) {
    QuadMesh part;
    std::vector<char> used(mesh.nodes.size(), 0);
    for (const auto& quad : mesh.quads) {
        const Vec3 sum = mesh.nodes[quad[0]] + mesh.nodes[quad[1]] + mesh.nodes[quad[2]] + mesh.nodes[quad[3]];
        const Vec3 centre = sum / 4.0;
        if (keep(centre)) {
            part.quads.push_back(quad);
            for (const Index i : quad) {
                used[i] = 1;
            }
        }
    }
    std::vector<Index> fresh(mesh.nodes.size(), 0);
    for (std::size_t i = 0; i < used.size(); ++i) {
        if (used[i] != 0) {
            fresh[i] = static_cast<Index>(part.nodes.size());
            part.nodes.push_back(mesh.nodes[i]);
        }
    }
    for (auto& quad : part.quads) {
        quad = {fresh[quad[0]], fresh[quad[1]], fresh[quad[2]], fresh[quad[3]]};
    }
    return part;
}

/// [-1, 1]^2 in 4k x 4k quads without its middle quarter [-1/2, 1/2]^2: one outer loop, one hole.
inline QuadMesh square_ring(std::size_t k = 1) {
    return subset(grid_cap(4 * k, 4 * k), [](const Vec3& c) { return std::abs(c.x()) > 0.5 || std::abs(c.y()) > 0.5; });
}

/// Annulus 1 <= r <= 2 in `around` x `across` quads; node a * (across + 1) + r is ring r (from inside) at angle a.
inline QuadMesh annulus(std::size_t around, std::size_t across) {
    QuadMesh mesh;
    for (std::size_t a = 0; a < around; ++a) {
        for (std::size_t r = 0; r <= across; ++r) {
            const double angle = 2.0 * std::numbers::pi * static_cast<double>(a) / static_cast<double>(around);
            const double radius = 1.0 + static_cast<double>(r) / static_cast<double>(across);
            mesh.nodes.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0.0);
        }
    }
    const auto at = [=](std::size_t a, std::size_t r) { return static_cast<Index>((a % around) * (across + 1) + r); };
    for (std::size_t a = 0; a < around; ++a) {
        for (std::size_t r = 0; r < across; ++r) {
            mesh.quads.push_back({at(a, r), at(a, r + 1), at(a + 1, r + 1), at(a + 1, r)});
        }
    }
    return mesh;
}

/// [-1, 1]^2 without its quadrant x > 0, y > 0, in 3k^2 quads.
inline QuadMesh l_shape(std::size_t k = 1) {
    return subset(grid_cap(2 * k, 2 * k), [](const Vec3& c) { return c.x() < 0.0 || c.y() < 0.0; });
}

/// grid_cap whose nodes have moved by at most amplitude times the quad's side, the same for a given seed.
/// The border moves too; up to amplitude 0.2 no quad folds (m = n).
inline QuadMesh random_cap(std::size_t m, std::size_t n, double amplitude, unsigned seed) {
    QuadMesh mesh = grid_cap(m, n);
    std::mt19937 generator(seed);
    const auto uniform = [&] { return 2.0 * static_cast<double>(generator()) / 4294967295.0 - 1.0; };
    const Vec3 side(2.0 / static_cast<double>(m), 2.0 / static_cast<double>(n), 2.0 / static_cast<double>(m));
    for (Vec3& node : mesh.nodes) {
        for (int axis = 0; axis < 3; ++axis) {
            node[axis] += amplitude * side[axis] * uniform();
        }
    }
    return mesh;
}

/// nx x ny x nz hexahedra over [0, a] x [0, b] x [0, c]; node ids run along x, then y, then z.
inline HexMesh hex_box(std::size_t nx, std::size_t ny, std::size_t nz, const Vec3& size = Vec3::Ones()) {
    HexMesh mesh;
    for (std::size_t k = 0; k <= nz; ++k) {
        for (std::size_t j = 0; j <= ny; ++j) {
            for (std::size_t i = 0; i <= nx; ++i) {
                mesh.nodes.emplace_back(size.x() * static_cast<double>(i) / static_cast<double>(nx),
                                        size.y() * static_cast<double>(j) / static_cast<double>(ny),
                                        size.z() * static_cast<double>(k) / static_cast<double>(nz));
            }
        }
    }
    const auto at = [=](std::size_t i, std::size_t j, std::size_t k) {
        return static_cast<Index>((k * (ny + 1) + j) * (nx + 1) + i);
    };
    for (std::size_t k = 0; k < nz; ++k) {
        for (std::size_t j = 0; j < ny; ++j) {
            for (std::size_t i = 0; i < nx; ++i) {
                mesh.hexes.push_back({at(i, j, k), at(i + 1, j, k), at(i + 1, j + 1, k), at(i, j + 1, k),
                                      at(i, j, k + 1), at(i + 1, j, k + 1), at(i + 1, j + 1, k + 1),
                                      at(i, j + 1, k + 1)});
            }
        }
    }
    return mesh;
}

/// The mesh extruded by \p height along z in \p layers; node level * (nodes of the cap) + i lies above node i.
inline HexMesh extrusion(const QuadMesh& cap, std::size_t layers, double height = 1.0) {
    HexMesh mesh;
    const std::size_t n = cap.nodes.size();
    for (std::size_t level = 0; level <= layers; ++level) {
        for (const Vec3& node : cap.nodes) {
            const double z = height * static_cast<double>(level) / static_cast<double>(layers);
            mesh.nodes.emplace_back(node.x(), node.y(), node.z() + z);
        }
    }
    for (std::size_t level = 0; level < layers; ++level) {
        for (const auto& q : cap.quads) {
            const auto low = [&](Index i) { return static_cast<Index>(level * n + i); };
            const auto high = [&](Index i) { return static_cast<Index>((level + 1) * n + i); };
            mesh.hexes.push_back(
                {low(q[0]), low(q[1]), low(q[2]), low(q[3]), high(q[0]), high(q[1]), high(q[2]), high(q[3])});
        }
    }
    return mesh;
}

}  // namespace shapes
