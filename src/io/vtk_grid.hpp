#pragma once
// What reading and writing VTK's grids have in common.

#include "checked_output.hpp"

#include <pavior/core/error.hpp>
#include <pavior/math/point.hpp>

#include <vtkCommand.h>
#include <vtkDoubleArray.h>
#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>
#include <vtkUnstructuredGridReader.h>
#include <vtkUnstructuredGridWriter.h>
#include <vtkXMLUnstructuredGridReader.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <cstddef>
#include <cstdint>
#include <ostream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace pavior::io {

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

inline vtkSmartPointer<vtkPoints> make_points(const std::vector<Vec3>& nodes) {
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

/// What VTK complains about, without the place in its sources and the address of its object.
inline std::string plain_vtk_message(std::string text) {
    if (const std::size_t place = text.find("ERROR: In "); place != std::string::npos) {
        const std::size_t line = text.find('\n', place);
        text.erase(0, line == std::string::npos ? text.size() : line + 1);
    }
    if (const std::size_t object = text.find("): "); text.rfind("vtk", 0) == 0 && object != std::string::npos) {
        text.erase(0, object + 3);
    }
    while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) {
        text.pop_back();
    }
    constexpr std::string_view unread = "Unrecognized keyword: ";
    if (text.rfind(unread, 0) == 0) {
        const std::string word = text.substr(unread.size());
        const std::size_t sign = word.find_first_not_of("+-");
        const std::string bare = sign == std::string::npos ? word : word.substr(sign);
        if (bare == "nan" || bare == "inf" || bare == "infinity") {
            return "a coordinate or value is '" + word + "', which is not finite";
        }
        return "'" + word + "' stands where a number or a keyword should";
    }
    return text.empty() ? "unknown error" : text;
}

template <class Process>
void run_vtk(const std::string& file, Process& process, const char* what) {
    const SilentLog silent;
    const vtkNew<ErrorCatcher> errors;
    process.AddObserver(vtkCommand::ErrorEvent, errors);
    process.SetFileName(file.c_str());
    process.Update();
    if (!errors->message.empty()) {
        throw FileError(file, what + plain_vtk_message(errors->message));
    }
    if (process.GetErrorCode() != 0) {
        throw FileError(file, what + ("VTK error " + std::to_string(process.GetErrorCode())));
    }
}

/// The grid in a legacy or XML file; it has points.
inline vtkSmartPointer<vtkUnstructuredGrid> read_grid(const std::string& file, bool xml) {
    vtkSmartPointer<vtkUnstructuredGrid> grid;
    const auto read = [&](auto& reader) {
        run_vtk(file, reader, "VTK cannot read it: ");
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
    return grid;
}

/// VTK's XML writer into a stream of ours: its own one does not say when the last bytes are lost.
class StreamXmlWriter : public vtkXMLUnstructuredGridWriter {
public:
    static StreamXmlWriter* New() { return new StreamXmlWriter; }  // NOLINT(readability-identifier-naming)
    void set_stream(std::ostream& stream) {
        ours_ = &stream;
        WriteToOutputStringOn();  // opens no file
    }

protected:
    int StartFile() override {  // NOLINT(readability-identifier-naming)
        theirs_ = std::exchange(Stream, ours_);
        return vtkXMLUnstructuredGridWriter::StartFile();
    }
    int EndFile() override {  // NOLINT(readability-identifier-naming)
        const int result = vtkXMLUnstructuredGridWriter::EndFile();
        Stream = theirs_;
        return result;
    }

private:
    std::ostream* ours_ = nullptr;
    std::ostream* theirs_ = nullptr;
};

inline bool write_cell_types(std::ostream& stream, vtkUnstructuredGrid& grid) {
    stream << "CELL_TYPES " << grid.GetNumberOfCells() << "\n";
    for (vtkIdType i = 0; i < grid.GetNumberOfCells(); ++i) {
        const auto type = static_cast<std::uint32_t>(grid.GetCellType(i));
        for (const unsigned shift : {24U, 16U, 8U, 0U}) {  // big-endian
            stream.put(static_cast<char>(type >> shift & 0xFFU));
        }
    }
    stream << "\n";
    return bool(stream);
}

inline bool write_xml(std::ostream& stream, vtkUnstructuredGrid& grid) {
    const vtkNew<StreamXmlWriter> writer;
    writer->SetInputData(&grid);
    writer->SetDataModeToAppended();
    writer->EncodeAppendedDataOff();
    writer->set_stream(stream);
    return writer->Write() == 1;
}

/// The sections one by one, as VTK's own Write() does.
inline bool write_legacy(std::ostream& stream, vtkUnstructuredGrid& grid, const char* title) {
    const vtkNew<vtkUnstructuredGridWriter> writer;
    writer->SetInputData(&grid);
    writer->SetFileTypeToBinary();
    writer->SetHeader(title);
    if (writer->WriteHeader(&stream) == 0) {
        return false;
    }
    stream << "DATASET UNSTRUCTURED_GRID\n";
    return writer->WriteDataSetData(&stream, &grid) != 0 && writer->WritePoints(&stream, grid.GetPoints()) != 0 &&
           writer->WriteCells(&stream, grid.GetCells(), "CELLS") != 0 && write_cell_types(stream, grid) &&
           writer->WriteCellData(&stream, &grid) != 0;
}

/// Writes \p grid: appended binary XML, or binary legacy. \p out is finished.
inline void write_grid(CheckedOutput& out, vtkUnstructuredGrid& grid, bool xml, const char* title) {
    const SilentLog silent;
    std::ostream stream(&out);
    const bool done = xml ? write_xml(stream, grid) : write_legacy(stream, grid, title);
    out.finish();  // first of all says what was lost
    if (!done) {
        throw FileError(out.name(), "VTK cannot write it");
    }
}

}  // namespace pavior::io
