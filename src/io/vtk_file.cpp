#include "formats.hpp"

#include <pavior/core/error.hpp>

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCommand.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkIdList.h>
#include <vtkIntArray.h>
#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkObject.h>
#include <vtkPoints.h>
#include <vtkSmartPointer.h>
#include <vtkStringArray.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkUnstructuredGridReader.h>
#include <vtkUnstructuredGridWriter.h>
#include <vtkXMLUnstructuredGridReader.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <cstdlib>
#include <sstream>

namespace pavior::io {

namespace {

/// Keeps the first error message of a VTK object instead of printing it.
class ErrorCatcher : public vtkCommand {
public:
    static ErrorCatcher* New() { return new ErrorCatcher; }  // NOLINT(readability-identifier-naming): VTK's contract
    void Execute(vtkObject* /*caller*/, unsigned long /*event*/, void* data) override {
        if (message.empty()) {
            message = data != nullptr ? static_cast<const char*>(data) : "unknown error";
        }
    }
    std::string message;
};

vtkSmartPointer<vtkPoints> make_points(const std::vector<Vec3>& nodes) {
    vtkNew<vtkDoubleArray> coordinates;
    coordinates->SetNumberOfComponents(3);
    coordinates->SetNumberOfTuples(static_cast<vtkIdType>(nodes.size()));
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        coordinates->SetTypedTuple(static_cast<vtkIdType>(i), nodes[i].data());
    }
    auto points = vtkSmartPointer<vtkPoints>::New();
    points->SetDataTypeToDouble();
    points->SetData(coordinates);
    return points;
}

/// Name, dimension and number of a group, as one string: "3 1 bolt".
vtkSmartPointer<vtkStringArray> make_group_names(const HexMeshData& data) {
    auto names = vtkSmartPointer<vtkStringArray>::New();
    names->SetName("group_names");
    for (const MeshGroup& group : data.groups) {
        names->InsertNextValue(std::to_string(group.dimension) + " " + std::to_string(group.number) + " " + group.name);
    }
    return names;
}

vtkSmartPointer<vtkUnstructuredGrid> make_grid(const HexMeshData& data) {
    auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
    grid->SetPoints(make_points(data.mesh.nodes));
    grid->Allocate(static_cast<vtkIdType>(data.mesh.hexes.size() + data.quads.size()));
    vtkNew<vtkIntArray> groups;
    groups->SetName("group");
    const auto add = [&](const auto& cell, int type, int group) {
        std::array<vtkIdType, 8> ids{};
        std::copy(cell.begin(), cell.end(), ids.begin());
        grid->InsertNextCell(type, static_cast<vtkIdType>(cell.size()), ids.data());
        groups->InsertNextValue(group);
    };
    for (std::size_t i = 0; i < data.mesh.hexes.size(); ++i) {
        add(data.mesh.hexes[i], VTK_HEXAHEDRON, group_of(data.hex_groups, i));
    }
    for (std::size_t i = 0; i < data.quads.size(); ++i) {
        add(data.quads[i], VTK_QUAD, group_of(data.quad_groups, i));
    }
    grid->GetCellData()->AddArray(groups);
    if (!data.groups.empty()) {
        grid->GetFieldData()->AddArray(make_group_names(data));
    }
    return grid;
}

/// VTK's internals (the XML parser, the pipeline) log to stderr whatever observers are there; not while this lives.
class SilentLog {
public:
    SilentLog() { vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF); }
    SilentLog(const SilentLog&) = delete;
    SilentLog& operator=(const SilentLog&) = delete;
    ~SilentLog() { vtkLogger::SetStderrVerbosity(before_); }

private:
    vtkLogger::Verbosity before_ = vtkLogger::GetCurrentVerbosityCutoff();
};

template <class Process>
void run(const std::string& file, Process& process, const char* what) {
    const SilentLog silent;
    const vtkNew<ErrorCatcher> errors;
    process.AddObserver(vtkCommand::ErrorEvent, errors);
    process.SetFileName(file.c_str());
    process.Update();
    if (!errors->message.empty()) {
        throw FileError(file, what + errors->message);
    }
    if (process.GetErrorCode() != 0) {
        throw FileError(file, what + ("VTK error " + std::to_string(process.GetErrorCode())));
    }
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

void read_group_names(vtkUnstructuredGrid& grid, HexMeshData& data) {
    auto* names = vtkStringArray::SafeDownCast(grid.GetFieldData()->GetAbstractArray("group_names"));
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

void write_vtk(const std::string& file, const HexMeshData& data, bool xml) {
    const vtkSmartPointer<vtkUnstructuredGrid> grid = make_grid(data);
    if (xml) {
        vtkNew<vtkXMLUnstructuredGridWriter> writer;
        writer->SetInputData(grid);
        writer->SetDataModeToAppended();
        writer->EncodeAppendedDataOff();
        run(file, *writer, "VTK cannot write: ");
    } else {
        vtkNew<vtkUnstructuredGridWriter> writer;
        writer->SetInputData(grid);
        writer->SetFileTypeToBinary();
        writer->SetHeader("hexahedral mesh by pavior");
        run(file, *writer, "VTK cannot write: ");
    }
}

HexMeshData read_vtk(const std::string& file, bool xml) {
    vtkSmartPointer<vtkUnstructuredGrid> grid;
    const auto read = [&](auto& reader) {
        run(file, reader, "VTK cannot read it: ");
        grid = reader.GetOutput();
    };
    if (xml) {
        vtkNew<vtkXMLUnstructuredGridReader> reader;
        read(*reader);
    } else {
        vtkNew<vtkUnstructuredGridReader> reader;
        read(*reader);
    }
    if (grid == nullptr || grid->GetNumberOfPoints() == 0) {
        throw FileError(file, "holds no points");
    }
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
