#include "../common/file_extension.hpp"
#include "check.hpp"
#include "commands.hpp"
#include "progress_bar.hpp"
#include "report_file.hpp"
#include "swept.hpp"

#include <pavior/cad/gmsh_brep.hpp>
#include <pavior/core/error.hpp>
#include <pavior/core/stopwatch.hpp>

#include <iostream>

namespace pavior::cli {

namespace {

using Json = nlohmann::json;

/// Options that mean nothing for the input at hand are mistakes.
void check_options(const SweepCommand& command, bool problem) {
    const auto refuse = [](bool wrong, const char* message) {
        if (wrong) {
            throw InputError(ErrorCode::bad_option, message);
        }
    };
    const bool sizes =
        command.size > 0 || !command.edge_size.empty() || !command.face_size.empty() || !command.solid_size.empty();
    refuse(problem && (sizes || command.layers || command.source || command.target),
           "sizes, --layers, --source and --target do not go with a sweep problem: its boundary is given");
}

Json options_json(const SweepCommand& command) {
    return {{"size", command.size},
            {"method", to_string(command.method)},
            {"strategy", to_string(command.strategy)},
            {"correction", to_string(command.correction)},
            {"smooth", command.smooth ? "auto" : "off"}};
}

/// Writes the mesh if it may be written.
ExitCode finish(const SweepCommand& command, Swept& swept, double seconds) {
    const MeshCheck check = check_mesh(swept.data, Execution{command.threads});
    const bool written = check.valid() || command.keep_invalid;
    if (written) {
        write_mesh(command.output, swept.data);
    }
    Json& json = swept.report;
    json["input"] = command.input;
    json["output"] = written ? Json(command.output) : Json();
    json["options"] = options_json(command);
    json["seconds"] = seconds;
    json["mesh"] = to_json(swept.data, check);
    json["warnings"] = swept.warnings;
    json["exit_code"] = static_cast<int>(check.valid() ? exit_valid : exit_invalid);
    write_report(command.report, json);
    for (const std::string& warning : swept.warnings) {
        std::cerr << "pavior: warning: " << warning << "\n";
    }
    if (!check.valid()) {
        std::cerr << "pavior: the mesh is not valid:\n"
                  << check.verify.text() << "\n"
                  << (written ? "it was written because of --keep-invalid\n" : "nothing was written\n");
        return exit_invalid;
    }
    if (!command.quiet) {
        std::cout << command.output << ": " << check.hexahedra << " hexahedra, " << check.nodes
                  << " nodes; scaled Jacobian min " << check.quality.scaled_jacobian.min << ", mean "
                  << check.quality.scaled_jacobian.mean << "; " << seconds << " s\n";
    }
    return exit_valid;
}

}  // namespace

ExitCode run_sweep(const SweepCommand& command) {
    const bool problem = detail::file_extension(command.input) == ".json";
    if (!problem && !can_read_cad(command.input)) {
        throw FileError(command.input, "unknown input format; known are .step .stp .iges .igs .brep .json");
    }
    if (!can_write_mesh(command.output)) {
        throw FileError(command.output, "unknown mesh format; known are .vtu .vtk .msh .inp");
    }
    check_options(command, problem);
    const Stopwatch watch;
    Swept swept = [&] {
        ProgressBar bar(command.quiet);
        return problem ? sweep_problem_file(command, bar.sink()) : sweep_cad_file(command, bar.sink());
    }();
    return finish(command, swept, watch.total());
}

}  // namespace pavior::cli
