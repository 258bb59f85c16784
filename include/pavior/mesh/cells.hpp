#pragma once
/// \file
/// Corner arrays of cells, their local numbering, and the flat list of loops.

#include <pavior/core/index.hpp>

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace pavior {

/// Nodes of a quadrilateral, counter-clockwise seen from its front (the tip of its normal).
using QuadCorners = std::array<Index, 4>;

/// Nodes of a triangle, counter-clockwise seen from its front.
using TriCorners = std::array<Index, 3>;

/// Nodes of a tetrahedron, positive if det(x1 - x0, x2 - x0, x3 - x0) > 0:
///
///            3
///           /|\          seen with 0 1 2 counter-clockwise from inside
///          / | \         (VTK_TETRA and Gmsh type 4; node k here is v_(k+1) in section 5.4.2 \cite roca2009)
///         0--|--2
///          \ | /
///            1
using TetCorners = std::array<Index, 4>;

/// Nodes of a hexahedron:
///
///          7-------6          0 1 2 3: bottom, counter-clockwise seen from inside the hexahedron
///         /|      /|          4 5 6 7: top, node k + 4 above node k
///        4-------5 |          (VTK_HEXAHEDRON and Gmsh type 5)
///        | 3-----|-2
///        |/      |/
///        0-------1
using HexCorners = std::array<Index, 8>;

/// Local nodes of the six quads of a hexahedron, each counter-clockwise seen from outside:
/// bottom, top, then the sides on the bottom edges 01, 12, 23, 30.
inline constexpr std::array<std::array<int, 4>, 6> hex_faces{
    {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}};

/// Local neighbours of each corner of a hexahedron, in the order that makes the corner tetrahedron of a
/// well-shaped hexahedron positive: det(x[n0] - x[c], x[n1] - x[c], x[n2] - x[c]) > 0.
inline constexpr std::array<std::array<int, 3>, 8> hex_corner_neighbours{
    {{1, 3, 4}, {2, 0, 5}, {3, 1, 6}, {0, 2, 7}, {7, 5, 0}, {4, 6, 1}, {5, 7, 2}, {6, 4, 3}}};

/// Local nodes of the six edges of a tetrahedron, in the order e_12 e_13 e_14 e_23 e_24 e_34 of section 5.4.2
/// \cite roca2009.
inline constexpr std::array<std::array<int, 2>, 6> tet_edges{{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};

/// Local nodes of the four triangles of a tetrahedron: face k is opposite to node k, counter-clockwise seen from
/// outside.
inline constexpr std::array<std::array<int, 3>, 4> tet_faces{{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};

/// tet_edge_between[a][b]: the local edge of local nodes a != b (-1 for a == b).
inline constexpr std::array<std::array<int, 4>, 4> tet_edge_between{
    {{-1, 0, 1, 2}, {0, -1, 3, 4}, {1, 3, -1, 5}, {2, 4, 5, -1}}};

/// Closed loops of node ids, one after the other: loop l is nodes[offsets[l]] .. nodes[offsets[l + 1] - 1].
/// Outer loops run counter-clockwise and holes clockwise, seen from the front of the mesh.
struct Loops {
    std::vector<Index> nodes;
    std::vector<std::size_t> offsets{0};

    [[nodiscard]] std::size_t size() const { return offsets.size() - 1; }
    [[nodiscard]] std::span<const Index> operator[](std::size_t loop) const {
        return std::span(nodes).subspan(offsets[loop], offsets[loop + 1] - offsets[loop]);
    }
    /// Appends one loop.
    void add(std::span<const Index> loop) {
        nodes.insert(nodes.end(), loop.begin(), loop.end());
        offsets.push_back(nodes.size());
    }
    friend bool operator==(const Loops&, const Loops&) = default;
};

}  // namespace pavior
