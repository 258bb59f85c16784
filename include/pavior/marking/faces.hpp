#pragma once
/// \file
/// The faces on the zero set of a field in a mesh that it has cut, and those of them that hang together with a start.

#include <pavior/core/compiled.hpp>
#include <pavior/marking/cut_tets.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <vector>

namespace pavior {

/// A field whose zero set becomes a sheet, and the sides of the nodes.
struct SheetCut {
    /// Signed distance to the sheet, roughly a length.
    std::function<double(const Vec3&)> field;
    /// Per node of the mesh: its value; zero exactly on the sheet. bisect_edges() appends.
    std::vector<double> values;
    /// Per node: nonzero if the value was decided by something other than the field (nodes of chains and of patches on
    /// the sheet).
    std::vector<char> fixed;
    /// The zero set is curved: edges are bisected until their ends tell how they cross it.
    bool curved = false;
    /// Absolute values up to this count as zero (a length).
    double tolerance = 0.0;
    /// Edges (ascending pairs, sorted) at which the sheet starts: a face that has one of them is a start.
    std::vector<std::array<Index, 2>> start_edges;
    /// Besides, faces of marked tetrahedra that touch this node are starts; no_index: any node.
    Index start_node = no_index;
    bool start_marks = false;
    /// Edges (ascending pairs, sorted) that the sheet does not cross; those on the boundary need not be listed.
    std::vector<std::array<Index, 2>> barriers;
};

/// A face of the zero set between negative and positive tetrahedra.
struct SheetFace {
    TriCorners nodes{};           ///< ascending
    std::array<Index, 2> tets{};  ///< negative, positive
};

namespace detail {

[[nodiscard]] inline std::array<Index, 2> ascending(Index a, Index b) { return {std::min(a, b), std::max(a, b)}; }

}  // namespace detail

/// The faces between the negative and the positive tetrahedra of a mesh in which no edge changes sign. O(n).
[[nodiscard]] PAVIOR_INLINE std::vector<SheetFace> sheet_faces(const ReferenceMesh& mesh, const SheetCut& sheet);

namespace detail {

/// The faces that hang together with a start across edges inside the solid that are no barriers.
[[nodiscard]] PAVIOR_INLINE std::vector<SheetFace> keep_started(const CutMesh& cut, const SheetCut& sheet,
                                                                const std::vector<SheetFace>& faces);

/// Appends the faces that are not layers yet. \return how many
PAVIOR_INLINE std::size_t add_layers(CutMesh& cut, const std::vector<SheetFace>& faces, Index id);

}  // namespace detail

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/marking/faces-inl.hpp>
#endif
