#pragma once
/// \file
/// Tetrahedral mesh files with features: what other mesh generators write.

#include <pavior/mesh/tagged_mesh.hpp>

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace pavior {

/// What a tetrahedral mesh file holds.
struct TetMeshData {
    /// Its `triangles` are the boundary faces, each once, outward; `edges` and `vertices` are the lines and points of
    /// the file.
    TaggedTetMesh tets;
    std::vector<std::int32_t> tet_tags;  ///< a tag a tetrahedron
    std::vector<TaggedTriangle> walls;   ///< triangles of the file with tetrahedra on both sides, in its order
};

/// True if read_tet_mesh() knows the extension of \p file: .vtk .vtu .msh (any case).
[[nodiscard]] bool can_read_tet_mesh(std::string_view file);

/// Reads a tetrahedral mesh:
///   .vtk .vtu  cells of the types tetra, triangle, line, poly_line, vertex, poly_vertex; tags are the first cell array
///              of tag, group, color, CellEntityIds, medit:ref, gmsh:physical that there is, rounded; else 0
///   .msh       linear elements of those types; tags are the first physical group of their entity, else its number
/// Triangles of the file give their tags to the boundary faces (0 where the file has none); those inside are walls.
/// Tetrahedra of negative volume are turned, nodes of no tetrahedron dropped; otherwise the order of the file is kept.
/// Nothing is welded. Gmsh and VTK read in a process of their own, as for read_mesh(). O(n log n).
/// \throws FileError naming cell or node: no tetrahedra, other cells of volume, corners that do not exist or repeat, a
///         coordinate that is not finite, a tetrahedron without volume, a face of more than two tetrahedra, a triangle
///         or line that is no face or edge of a tetrahedron
[[nodiscard]] TetMeshData read_tet_mesh_data(const std::string& file);

/// The same without the walls inside and the tags of tetrahedra.
[[nodiscard]] inline TaggedTetMesh read_tet_mesh(const std::string& file) { return read_tet_mesh_data(file).tets; }

}  // namespace pavior
