#pragma once

#include <pavior/cad/gmsh_brep.hpp>
#include <pavior/cad/length_unit.hpp>
#include <pavior/core/error.hpp>
#include <pavior/mesh/grouped_mesh.hpp>

#include <nlohmann/json.hpp>

#include <string>

namespace pavior::cli {

/// The unit that a mesh is written in, beside that of its input.
struct OutputUnit {
    std::string file = "unknown";   ///< what the input says
    std::string model = "unknown";  ///< of all sizes, and of lengths and volumes in reports
    std::string output = "unknown";
    double scale = 1;  ///< from model to output

    /// \param wanted  empty: that of the model
    OutputUnit(const std::string& input, const std::string& wanted) {
        if (can_read_cad(input)) {
            file = unit_of_file(input);
        }
        // OpenCASCADE takes millimetres where a STEP or IGES file says nothing it knows; others have no unit at all.
        model = output = file == "unknown" ? file : "mm";
        if (!wanted.empty()) {
            if (file == "unknown") {
                throw InputError(ErrorCode::bad_option, "--unit " + wanted + ": " + input + " says no unit of length");
            }
            output = wanted;
            scale = *millimetres(model) / *millimetres(wanted);
        }
    }

    void apply(HexMeshData& data) const {
        if (scale != 1) {
            for (Vec3& x : data.mesh.nodes) {
                x *= scale;
            }
        }
    }

    [[nodiscard]] nlohmann::json json() const {
        return {{"file", file}, {"model", model}, {"output", output}, {"scale", scale}};
    }

    /// " in mm (the file: inch)", or nothing.
    [[nodiscard]] std::string text() const {
        return output == "unknown" ? "" : " in " + output + (file == output ? "" : " (the file: " + file + ")");
    }
};

}  // namespace pavior::cli
