#include "tet_mesh_formats.hpp"
#include "vtk_grid.hpp"

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkIdList.h>

#include <array>
#include <cmath>

namespace pavior::io {

namespace {

vtkDataArray* tags_of(vtkUnstructuredGrid& grid) {
    for (const char* name : {"tag", "group", "color", "CellEntityIds", "medit:ref", "gmsh:physical"}) {
        auto* array = vtkDataArray::SafeDownCast(grid.GetCellData()->GetAbstractArray(name));
        if (array != nullptr && array->GetNumberOfComponents() == 1) {
            return array;
        }
    }
    return nullptr;
}

/// Sorts the cells of a grid by their kind.
class CellReader {
public:
    CellReader(const std::string& file, vtkUnstructuredGrid& grid, RawTetMesh& mesh)
        : file_(file), grid_(grid), tags_(tags_of(grid)), mesh_(mesh) {}

    void read(vtkIdType cell) {
        grid_.GetCellPoints(cell, ids_);
        const int type = grid_.GetCellType(cell);
        const auto tag = static_cast<std::int32_t>(tags_ == nullptr ? 0.0 : std::round(tags_->GetTuple1(cell)));
        const auto count = static_cast<std::size_t>(ids_->GetNumberOfIds());
        if (type == VTK_TETRA && count == 4) {
            mesh_.tets.add({at(0), at(1), at(2), at(3)}, tag, cell);
        } else if (type == VTK_TRIANGLE && count == 3) {
            mesh_.triangles.add({at(0), at(1), at(2)}, tag, cell);
        } else if (type == VTK_LINE || type == VTK_POLY_LINE) {
            for (std::size_t k = 0; k + 1 < count; ++k) {
                mesh_.lines.add({at(k), at(k + 1)}, tag, cell);
            }
        } else if (type == VTK_VERTEX || type == VTK_POLY_VERTEX) {
            for (std::size_t k = 0; k < count; ++k) {
                mesh_.points.add({at(k)}, tag, cell);
            }
        } else if (type != VTK_EMPTY_CELL) {
            throw FileError(file_,
                            "cell " + std::to_string(cell) + " is of VTK type " + std::to_string(type) +
                                ", neither tetrahedron nor triangle, line or vertex",
                            {static_cast<std::int64_t>(cell)});
        }
    }

private:
    [[nodiscard]] Index at(std::size_t k) const { return static_cast<Index>(ids_->GetId(static_cast<vtkIdType>(k))); }

    const std::string& file_;
    vtkUnstructuredGrid& grid_;
    vtkDataArray* tags_;
    RawTetMesh& mesh_;
    vtkNew<vtkIdList> ids_;
};

}  // namespace

RawTetMesh read_vtk_tets(const std::string& file, bool xml) {
    const vtkSmartPointer<vtkUnstructuredGrid> grid = read_grid(file, xml);
    RawTetMesh mesh;
    mesh.nodes.resize(static_cast<std::size_t>(grid->GetNumberOfPoints()));
    for (std::size_t i = 0; i < mesh.nodes.size(); ++i) {
        grid->GetPoint(static_cast<vtkIdType>(i), mesh.nodes[i].data());
    }
    CellReader reader(file, *grid, mesh);
    for (vtkIdType cell = 0; cell < grid->GetNumberOfCells(); ++cell) {
        reader.read(cell);
    }
    return mesh;
}

}  // namespace pavior::io
