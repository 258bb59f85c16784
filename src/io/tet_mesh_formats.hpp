#pragma once
// The formats behind tet_mesh_file.hpp.

#include <pavior/mesh/tagged_mesh.hpp>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace pavior::io {

/// Cells of one dimension as a file has them, and what the file calls them.
template <class Corners>
struct TaggedCells {
    std::vector<Corners> cells;
    std::vector<std::int32_t> tags;
    std::vector<std::int64_t> names;  ///< number of the cell in the file

    void add(const Corners& corners, std::int32_t tag, std::int64_t name) {
        cells.push_back(corners);
        tags.push_back(tag);
        names.push_back(name);
    }
};

/// A mesh as a file has it, not looked at yet.
struct RawTetMesh {
    std::vector<Vec3> nodes;
    TaggedCells<TetCorners> tets;
    TaggedCells<TriCorners> triangles;
    TaggedCells<std::array<Index, 2>> lines;
    TaggedCells<std::array<Index, 1>> points;
};

RawTetMesh read_vtk_tets(const std::string& file, bool xml);
RawTetMesh read_gmsh_tets(const std::string& file);

}  // namespace pavior::io
