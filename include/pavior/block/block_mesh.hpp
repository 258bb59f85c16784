#pragma once
/// \file
/// Blocks: coarse hexahedra that know which part of the reference mesh each corner, edge and quad comes from.

#include <pavior/core/compiled.hpp>
#include <pavior/core/index.hpp>
#include <pavior/mesh/cells.hpp>
#include <pavior/mesh/mesh_access.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace pavior {

/// A part of the solid as the geometry knows it: vertex (0), curve (1), patch (2) or the inside (3), and its tag there
/// (0 inside).
struct GeometryEntity {
    std::uint8_t dimension = 3;
    std::int32_t tag = 0;

    friend bool operator==(const GeometryEntity&, const GeometryEntity&) = default;
};

/// Where a block node comes from: a vertex (0), chain (1), patch (2) or cell (3) of the cell complex.
struct BlockNode {
    std::uint8_t dimension = 0;
    Index id = 0;             ///< in the numbering of the cell complex for that dimension
    GeometryEntity geometry;  ///< the lowest-dimensional entity of the geometry that it lies on

    friend bool operator==(const BlockNode&, const BlockNode&) = default;
};

/// Local nodes of the twelve edges of a hexahedron, four for each direction; all four run the same way.
inline constexpr std::array<std::array<int, 2>, 12> hex_edges{
    {{0, 1}, {3, 2}, {4, 5}, {7, 6}, {0, 3}, {1, 2}, {4, 7}, {5, 6}, {0, 4}, {1, 5}, {3, 7}, {2, 6}}};

/// Local edges of the six faces of a hexahedron in the order of hex_faces: edge k of a face joins its nodes k and
/// k + 1.
inline constexpr std::array<std::array<int, 4>, 6> hex_face_edges{
    {{4, 1, 5, 0}, {2, 7, 3, 6}, {0, 9, 2, 8}, {5, 11, 7, 9}, {1, 10, 3, 11}, {4, 8, 6, 10}}};

/// The blocks of a solid: the midpoint subdivision of a cell complex, without coordinates.
///
///          7-------6          0        vertex
///         /|      /|          1 3 4    chains that meet in it
///        4-------5 |          2 5 7    patches between these
///        | 3-----|-2          6        cell
///        |/      |/
///        0-------1
///
/// Edges run from the node of lower dimension to that of higher dimension; an edge, quad or block lies inside the
/// vertex, chain, patch or cell of its node of highest dimension.
struct BlockMesh {
    std::vector<BlockNode> nodes;             ///< all vertices, then chains, patches, cells, each by id
    std::array<Index, 5> first{};             ///< nodes of dimension d: first[d] .. first[d + 1] - 1
    std::vector<HexCorners> hexes;            ///< oriented as HexCorners
    std::vector<std::array<Index, 2>> edges;  ///< two nodes, the dimension ascends; in ascending order
    std::vector<QuadCorners> quads;           ///< from the node of lowest dimension, as its first hexahedron sees
                                              ///< it from outside
    std::vector<std::array<Index, 2>>
        quad_hexes;  ///< hexahedra of a quad, ascending; the second no_index on the boundary
    std::vector<std::array<Index, 12>> hex_edges;  ///< edges of a hexahedron in the order of pavior::hex_edges
    std::vector<std::array<Index, 6>> hex_quads;   ///< quads of a hexahedron in the order of hex_faces
    std::vector<Index> sheets;                     ///< sheet of each edge
    Index sheet_count = 0;

    /// The node of a vertex (0), chain (1), patch (2) or cell (3).
    [[nodiscard]] Index node(int dimension, Index id) const { return first[static_cast<std::size_t>(dimension)] + id; }
    /// The node of an edge whose vertex, chain, patch or cell the edge lies in.
    [[nodiscard]] Index edge_origin(Index edge) const { return edges[edge][1]; }
    /// The same for a quad.
    [[nodiscard]] Index quad_origin(Index quad) const { return quads[quad][2]; }
    /// The same for a hexahedron.
    [[nodiscard]] Index hex_origin(Index hex) const { return hexes[hex][6]; }
    /// The three sheets that cross a hexahedron, in its directions 01, 03, 04.
    [[nodiscard]] std::array<Index, 3> hex_sheets(Index hex) const {
        const auto& e = hex_edges[hex];
        return {sheets[e[0]], sheets[e[4]], sheets[e[8]]};
    }
    [[nodiscard]] bool boundary_quad(Index quad) const { return quad_hexes[quad][1] == no_index; }
};

/// What blocks are read off. The outcome is the same to the byte.
enum class Dualization : std::uint8_t {
    complex,        ///< the cell complex that the layers cut out: its midpoint subdivision (dual/cell_complex.hpp)
    contributions,  ///< the local dual contributions and their regions, as published (contributions/contributions.hpp)
};

/// Completes blocks given by their nodes (ordered by dimension) and corners: edges, quads, sheets. A sheet is a class
/// of edges that are opposite to each other in some quad: what one number of intervals must serve.
/// O(n log n). \throws InputError bad_index (nodes that are not in order, corners of the wrong dimension), invalid_dual
/// (three blocks on one quad)
[[nodiscard]] PAVIOR_INLINE BlockMesh make_block_mesh(std::vector<BlockNode> nodes, std::vector<HexCorners> hexes);

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/block/block_mesh-inl.hpp>
#endif
