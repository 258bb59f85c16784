#include <pavior/io/dual_file.hpp>

#include "../common/file_extension.hpp"
#include "vtk_grid.hpp"

#include <pavior/io/atomic_file.hpp>

#include <vtkCellData.h>
#include <vtkIntArray.h>
#include <vtkUnsignedCharArray.h>

#include <cmath>
#include <cstddef>

namespace pavior {

namespace {

/// The grid and its cell arrays while cells are added.
class DualGrid {
public:
    DualGrid() {
        const std::array<const char*, 4> names{"part", "colour", "region", "dimension"};
        for (std::size_t i = 0; i < names.size(); ++i) {
            values_[i]->SetName(names[i]);
        }
        rgb_->SetName("rgb");
        rgb_->SetNumberOfComponents(3);
    }

    void reserve(std::size_t cells) { grid->Allocate(static_cast<vtkIdType>(cells)); }

    void add(const PointCells& cells, std::size_t cell, std::size_t first_point, int type, std::array<int, 4> values,
             const std::array<double, 3>& colour) {
        std::array<vtkIdType, 8> ids{};
        const std::size_t begin = cells.begin[cell];
        const std::size_t size = cells.begin[cell + 1] - begin;
        for (std::size_t k = 0; k < size; ++k) {
            ids[k] = static_cast<vtkIdType>(first_point + cells.ids[begin + k]);
        }
        grid->InsertNextCell(type, static_cast<vtkIdType>(size), ids.data());
        for (std::size_t i = 0; i < values.size(); ++i) {
            values_[i]->InsertNextValue(values[i]);
        }
        for (const double part : colour) {
            rgb_->InsertNextValue(static_cast<unsigned char>(std::lround(255.0 * part)));
        }
    }

    void finish() {
        for (const auto& array : values_) {
            grid->GetCellData()->AddArray(array);
        }
        grid->GetCellData()->AddArray(rgb_);
    }

    vtkNew<vtkUnstructuredGrid> grid;

private:
    std::array<vtkNew<vtkIntArray>, 4> values_;
    vtkNew<vtkUnsignedCharArray> rgb_;
};

int piece_type(std::size_t size) { return size == 4 ? VTK_TETRA : size == 6 ? VTK_WEDGE : VTK_HEXAHEDRON; }

}  // namespace

void write_dual(const std::string& file, const DualSurfaces& surfaces, const RegionPolyhedra& regions) {
    const std::string extension = detail::file_extension(file);
    if (extension != ".vtu" && extension != ".vtk") {
        throw FileError(file, "the dual is written as .vtu or .vtk, not as \"" + extension + "\"");
    }
    DualGrid dual;
    std::vector<Vec3> points = surfaces.points;
    points.insert(points.end(), regions.points.begin(), regions.points.end());
    dual.grid->SetPoints(io::make_points(points));
    dual.reserve(surfaces.size() + regions.size());
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
        const int type = surfaces.begin[i + 1] - surfaces.begin[i] == 3 ? VTK_TRIANGLE : VTK_QUAD;
        dual.add(surfaces, i, 0, type, {0, static_cast<int>(surfaces.colour[i]), -1, -1}, rgb(surfaces.colour[i]));
    }
    for (std::size_t i = 0; i < regions.size(); ++i) {
        dual.add(regions, i, surfaces.points.size(), piece_type(regions.begin[i + 1] - regions.begin[i]),
                 {1, -1, static_cast<int>(regions.region[i]), static_cast<int>(regions.dimension[i])},
                 region_rgb(regions.region[i]));
    }
    dual.finish();
    write_atomically(file, [&](const std::string& temporary) {
        io::CheckedOutput out(temporary, file);
        io::write_grid(out, *dual.grid, extension == ".vtu", "local dual contributions by pavior");
    });
}

}  // namespace pavior
