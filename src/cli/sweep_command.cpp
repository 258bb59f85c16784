#include "../common/file_extension.hpp"
#include "check.hpp"
#include "commands.hpp"
#include "output_files.hpp"
#include "progress_bar.hpp"

#include <pavior/cad/cap_mesh.hpp>
#include <pavior/cad/gmsh_brep.hpp>
#include <pavior/core/error.hpp>
#include <pavior/core/stopwatch.hpp>
#include <pavior/glpk/solve_program.hpp>
#include <pavior/io/mesh_file.hpp>
#include <pavior/io/sweep_problem_file.hpp>
#include <pavior/part/any_model.hpp>
#include <pavior/part/entity_groups.hpp>
#include <pavior/part/local_lengths.hpp>
#include <pavior/part/sweep_solids.hpp>
#include <pavior/sweep/untangle_sweep.hpp>

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace pavior::cli {

namespace {

using Json = nlohmann::json;

/// A mesh as made, before it is checked.
struct Swept {
    HexMeshData data;
    Json report = Json::object();
    std::vector<std::string> warnings;
    double size = 0;  ///< that was used; 0: none was
};

SweepOptions sweep_options(const SweepCommand& command, const Guard& guard) {
    SweepOptions options;
    options.method = command.method;
    options.strategy = command.strategy;
    options.correction = command.correction;
    options.execution = Execution{command.threads, guard.stop()};
    return options;
}

Swept sweep_problem_file(const SweepCommand& command, const Guard& guard, const Progress& progress) {
    const SweepProblem problem = read_sweep_problem(command.input);
    SweepOptions options = sweep_options(command, guard);
    options.progress = progress;
    SweepResult result = sweep(problem, options);
    if (problem.quads.empty()) {
        throw FileError(command.input, "\"quads\" is empty: there is nothing to sweep");
    }
    Swept swept;
    swept.report["sweep"] = detail::to_json(result.report);
    for (const SweepWarning& warning : result.report.warnings) {
        swept.warnings.push_back(text_of(warning));
    }
    if (command.smooth) {
        report(progress, "untangling", 0.9);
        swept.report["smooth"] = detail::to_json(untangle_sweep(result.mesh, problem.loops, options.execution));
    }
    HexMesh& mesh = swept.data.mesh;
    mesh.nodes.assign(result.mesh.nodes().begin(), result.mesh.nodes().end());
    mesh.hexes = result.mesh.hexes();
    return swept;
}

/// Hexahedra to be expected; layers given count where they are more than the size makes.
double expected(const GmshBrep& model, std::span<const SolidId> solids, const IntervalOptions& intervals) {
    double sum = expected_hexahedra(model, solids, intervals.size, intervals.solid_size);
    if (intervals.layers) {
        double quads = 0;
        for (const SolidId s : solids) {
            quads += std::pow(model.solid_volume(s), 2.0 / 3.0) / (intervals.size * intervals.size);
        }
        sum = std::max(sum, quads * *intervals.layers);
    }
    return sum;
}

Swept sweep_cad_file(const SweepCommand& command, const Guard& guard, const Progress& progress) {
    report(progress, "reading", 0);
    const GmshBrep model = GmshBrep::load(command.input, cad_options(command, guard));
    const std::vector<SolidId> solids = all_solids(model);
    const LocalLengths local = lengths_by_tag(model, command.local);
    SweepSolidsOptions options;
    options.intervals.size = command.size > 0 ? command.size : model.diagonal() / 12;
    options.intervals.edge_size = local.edge;
    options.intervals.face_size = local.face;
    options.intervals.solid_size = local.solid;
    options.intervals.layers = command.layers;
    require_expected_at_most(expected(model, solids, options.intervals), command.max_hexahedra, options.intervals.size);
    options.sweep.solid.sweep = sweep_options(command, guard);
    options.sweep.solid.smooth = command.smooth;
    options.sweep.progress = progress;
    options.source = command.source;
    options.target = command.target;
    SweptSolids made = sweep_solids(model, solids, options, GlpkSolver{}, GmshCapMesher{&model});
    Swept swept;
    swept.size = options.intervals.size;
    swept.report = detail::to_json(model, made);
    swept.warnings = std::move(made.warnings);
    swept.data = grouped(model, solids, std::move(made.mesh));
    return swept;
}

/// Options that mean nothing for the input at hand are mistakes.
void check_options(const SweepCommand& command, bool problem) {
    const auto refuse = [](bool wrong, const char* message) {
        if (wrong) {
            throw InputError(ErrorCode::bad_option, message);
        }
    };
    const bool sizes = command.size > 0 || !command.local.empty();
    refuse(problem && (sizes || command.layers || command.source || command.target),
           "sizes, --layers, --source and --target do not go with a sweep problem: its boundary is given");
}

Json options_json(const SweepCommand& command, double size) {
    return {{"size", size > 0 ? Json(size) : Json()},
            {"local_sizes", lengths_json(command.local)},
            {"layers", command.layers ? Json(*command.layers) : Json()},
            {"timeout", command.timeout ? Json(*command.timeout) : Json()},
            {"method", to_string(command.method)},
            {"strategy", to_string(command.strategy)},
            {"correction", to_string(command.correction)},
            {"smooth", command.smooth ? "auto" : "off"}};
}

/// Writes the mesh if it may be written.
ExitCode finish(const SweepCommand& command, Swept& swept, Guard& guard, double seconds, OutputFiles& files) {
    const MeshCheck check = check_mesh(swept.data.mesh, Execution{command.threads, guard.stop()});
    guard.lift_limit();
    const bool written = check.valid() || command.keep_invalid;
    if (written) {
        files.write(command.output,
                    [&](const std::string& temporary) { write_mesh(temporary, swept.data, {command.format}); });
    }
    Json& json = swept.report;
    json["input"] = command.input;
    json["output"] = written ? Json(command.output) : Json();
    json["options"] = options_json(command, swept.size);
    json["seconds"] = seconds;
    json["mesh"] = detail::to_json(swept.data, check, written_format(command.output, command.format, written));
    json["warnings"] = swept.warnings;
    json["exit_code"] = static_cast<int>(check.valid() ? exit_valid : exit_invalid);
    files.write_report(command.report, json);
    files.commit();
    print_warnings(swept.warnings);
    if (!check.valid()) {
        print_invalid("the mesh is", check.verify.text(), written);
        return exit_invalid;
    }
    if (!command.quiet) {
        print_summary(command.output, counts_of(check), check, seconds);
    }
    return exit_valid;
}

}  // namespace

ExitCode run_sweep(const SweepCommand& command, Guard& guard) {
    const bool problem = detail::file_extension(command.input) == ".json";
    if (!problem && !can_read_cad(command.input)) {
        throw FileError(command.input, "unknown input format; known are .step .stp .iges .igs .brep .json");
    }
    static_cast<void>(mesh_format(command.output, command.format));  // refuses what cannot be written
    check_options(command, problem);
    OutputFiles files(command.input, {command.output, command.report});
    guard.set_limit(command.timeout.value_or(0), late_report(command));
    const Stopwatch watch;
    Swept swept = [&] {
        ProgressBar bar(command.quiet);
        return problem ? sweep_problem_file(command, guard, bar.sink()) : sweep_cad_file(command, guard, bar.sink());
    }();
    return finish(command, swept, guard, watch.total(), files);
}

}  // namespace pavior::cli
