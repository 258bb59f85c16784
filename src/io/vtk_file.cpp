#include "formats.hpp"
#include "vtk_grid.hpp"

#include <pavior/core/error.hpp>

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkIdList.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkSmartPointer.h>
#include <vtkStringArray.h>
#include <vtkTypeInt64Array.h>
#include <vtkUnstructuredGrid.h>

#include <cstdlib>
#include <sstream>

namespace pavior::io {

namespace {

/// An array of whole numbers. In .vtk they have 64 bits: meshio takes those of 32 for 64 in binary files.
vtkSmartPointer<vtkDataArray> whole_numbers(const char* name, bool xml) {
    vtkSmartPointer<vtkDataArray> array;
    if (xml) {
        array = vtkSmartPointer<vtkIntArray>::New();
    } else {
        array = vtkSmartPointer<vtkTypeInt64Array>::New();
    }
    array->SetName(name);
    return array;
}

/// VTK puts names of arrays into XML as they are.
std::string escaped(const std::string& name) {
    std::string result;
    for (const char c : name) {
        switch (c) {
            case '&': result += "&amp;"; break;
            case '<': result += "&lt;"; break;
            case '>': result += "&gt;"; break;
            case '"': result += "&quot;"; break;
            default: result += c;
        }
    }
    return result;
}

/// One array a group, called as it is: number, dimension. That is how meshio hands on the names of Gmsh's groups; it
/// cannot read text.
void add_group_names(vtkFieldData& fields, const std::vector<MeshGroup>& groups, bool xml) {
    for (const MeshGroup& group : groups) {
        if (!group.name.empty()) {
            const vtkSmartPointer<vtkDataArray> array =
                whole_numbers((xml ? escaped(group.name) : group.name).c_str(), xml);
            array->InsertNextTuple1(group.number);
            array->InsertNextTuple1(group.dimension);
            fields.AddArray(array);
        }
    }
}

vtkSmartPointer<vtkUnstructuredGrid> make_grid(const HexMeshData& data, const std::vector<MeshGroup>& names, bool xml) {
    auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
    grid->SetPoints(make_points(data.mesh.nodes));
    grid->Allocate(static_cast<vtkIdType>(data.mesh.hexes.size() + data.quads.size()));
    const vtkSmartPointer<vtkDataArray> groups = whole_numbers("group", xml);
    const auto add = [&](const auto& cell, int type, int group) {
        std::array<vtkIdType, 8> ids{};
        std::copy(cell.begin(), cell.end(), ids.begin());
        grid->InsertNextCell(type, static_cast<vtkIdType>(cell.size()), ids.data());
        groups->InsertNextTuple1(group);
    };
    for (std::size_t i = 0; i < data.mesh.hexes.size(); ++i) {
        add(data.mesh.hexes[i], VTK_HEXAHEDRON, group_of(data.hex_groups, i));
    }
    for (std::size_t i = 0; i < data.quads.size(); ++i) {
        add(data.quads[i], VTK_QUAD, group_of(data.quad_groups, i));
    }
    grid->GetCellData()->AddArray(groups);
    add_group_names(*grid->GetFieldData(), names, xml);
    return grid;
}

void read_cells(const std::string& file, vtkUnstructuredGrid& grid, HexMeshData& data) {
    auto* groups = vtkDataArray::SafeDownCast(grid.GetCellData()->GetAbstractArray("group"));
    const auto group_at = [&](vtkIdType i) { return groups == nullptr ? 0 : static_cast<int>(groups->GetTuple1(i)); };
    const vtkIdType count = grid.GetNumberOfCells();
    const vtkNew<vtkIdList> ids;
    for (vtkIdType i = 0; i < count; ++i) {
        const int type = grid.GetCellType(i);
        grid.GetCellPoints(i, ids);
        const vtkIdType size = ids->GetNumberOfIds();
        const auto at = [&](vtkIdType k) { return static_cast<Index>(ids->GetId(k)); };
        if (type == VTK_HEXAHEDRON && size == 8) {
            data.mesh.hexes.push_back({at(0), at(1), at(2), at(3), at(4), at(5), at(6), at(7)});
            data.hex_groups.push_back(group_at(i));
        } else if (type == VTK_QUAD && size == 4) {
            data.quads.push_back({at(0), at(1), at(2), at(3)});
            data.quad_groups.push_back(group_at(i));
        } else if (type > VTK_QUAD) {
            throw FileError(
                file,
                "cell " + std::to_string(i) + " is of VTK type " + std::to_string(type) + ", not a linear hexahedron",
                {static_cast<std::int64_t>(i)});
        }
    }
}

/// The groups of add_group_names(), and of files of versions before: text, "3 1 bolt".
void read_group_names(vtkUnstructuredGrid& grid, HexMeshData& data) {
    vtkFieldData& fields = *grid.GetFieldData();
    for (int a = 0; a < fields.GetNumberOfArrays(); ++a) {
        auto* numbers = vtkDataArray::SafeDownCast(fields.GetAbstractArray(a));
        const char* name = fields.GetArrayName(a);
        if (name == nullptr || numbers == nullptr || numbers->GetNumberOfValues() != 2 ||
            numbers->GetDataType() == VTK_FLOAT || numbers->GetDataType() == VTK_DOUBLE) {
            continue;
        }
        const auto value = [&](int i) {
            const int width = numbers->GetNumberOfComponents();
            return static_cast<int>(numbers->GetComponent(i / width, i % width));
        };
        if (value(1) == 2 || value(1) == 3) {
            data.groups.push_back({value(1), value(0), name});
        }
    }
    auto* names = vtkStringArray::SafeDownCast(fields.GetAbstractArray("group_names"));
    for (vtkIdType i = 0; names != nullptr && i < names->GetNumberOfValues(); ++i) {
        std::istringstream text(names->GetValue(i));
        MeshGroup group;
        text >> group.dimension >> group.number;
        text.get();
        std::getline(text, group.name);
        data.groups.push_back(std::move(group));
    }
}

}  // namespace

void write_vtk(CheckedOutput& out, const HexMeshData& data, const std::vector<MeshGroup>& groups, bool xml) {
    const vtkSmartPointer<vtkUnstructuredGrid> grid = make_grid(data, groups, xml);
    write_grid(out, *grid, xml, "hexahedral mesh by pavior");
}

HexMeshData read_vtk(const std::string& file, bool xml) {
    const vtkSmartPointer<vtkUnstructuredGrid> grid = read_grid(file, xml);
    HexMeshData data;
    data.mesh.nodes.resize(static_cast<std::size_t>(grid->GetNumberOfPoints()));
    for (std::size_t i = 0; i < data.mesh.nodes.size(); ++i) {
        grid->GetPoint(static_cast<vtkIdType>(i), data.mesh.nodes[i].data());
    }
    read_cells(file, *grid, data);
    read_group_names(*grid, data);
    return data;
}

}  // namespace pavior::io
