#include "../common/file_extension.hpp"
#include "made_mesh.hpp"
#include "progress_bar.hpp"

#include <pavior/cad/cap_mesh.hpp>
#include <pavior/cad/gmsh_brep.hpp>
#include <pavior/core/error.hpp>
#include <pavior/core/stopwatch.hpp>
#include <pavior/glpk/solve_program.hpp>
#include <pavior/io/mesh_file.hpp>
#include <pavior/io/sweep_problem_file.hpp>
#include <pavior/math/box.hpp>
#include <pavior/part/any_model.hpp>
#include <pavior/part/entity_groups.hpp>
#include <pavior/part/local_lengths.hpp>
#include <pavior/part/sweep_solids.hpp>
#include <pavior/sweep/untangle_sweep.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
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
    double size = 0;                        ///< that was used; 0: none was
    std::optional<CadDeviation> deviation;  ///< from a CAD model
};

SweepOptions sweep_options(const SweepCommand& command, const Guard& guard) {
    SweepOptions options;
    options.method = command.method;
    options.strategy = command.strategy;
    options.correction = command.correction;
    options.execution = Execution{command.threads, guard.stop()};
    return options;
}

/// A sweep of a full turn ends on its own source: the last level becomes the first. Whether it was one.
bool close_ring(const SweepProblem& problem, HexMesh& mesh) {
    const std::size_t level = problem.source_nodes.size();
    constexpr std::size_t fewest_layers = 3;
    if (problem.layers < fewest_layers || problem.target_nodes.size() != level) {
        return false;
    }
    const double near = 1e-9 * box_round(std::span<const Vec3>(mesh.nodes)).diagonal();
    for (std::size_t i = 0; i < level; ++i) {
        if ((problem.target_nodes[i] - problem.source_nodes[i]).norm() > near) {
            return false;
        }
    }
    const std::size_t last = problem.layers * level;
    for (HexCorners& hex : mesh.hexes) {
        for (Index& corner : hex) {
            corner = static_cast<Index>(corner < last ? corner : corner - last);
        }
    }
    mesh.nodes.resize(last);
    return true;
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
    swept.report["closed_to_a_ring"] = close_ring(problem, mesh);
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
    CadOptions reading = cad_options(command, guard);
    reading.imprint_tolerance = command.imprint_tolerance;
    const GmshBrep model = GmshBrep::load(command.input, reading);
    const std::vector<SolidId> solids = all_solids(model);
    const LocalLengths local = lengths_by_tag(model, command.local);
    SweepSolidsOptions options;
    options.intervals.size = command.size > 0 ? command.size : model.diagonal() / 12;
    if (!command.allow_slices) {
        refuse_slices(model.imprint_report(), options.intervals.size);
    }
    options.intervals.max_angle = command.max_angle;
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
    swept.warnings = warnings_of(model.imprint_report());
    append(swept.warnings, std::move(made.warnings));
    report(progress, "comparing", 0.95);
    swept.deviation = cad_deviation(model, solids, made.mesh.mesh.nodes, made.mesh.quads, made.mesh.quad_face, 0.0,
                                    options.intervals.size);
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
            {"max_angle", command.max_angle},
            {"imprint_tolerance", command.imprint_tolerance},
            {"method", to_string(command.method)},
            {"strategy", to_string(command.strategy)},
            {"correction", to_string(command.correction)},
            {"smooth", command.smooth ? "auto" : "off"}};
}

/// Checks what was made.
MadeMesh checked(const SweepCommand& command, Swept swept, Guard& guard) {
    MadeMesh made;
    made.check = check_mesh(swept.data.mesh, Execution{command.threads, guard.stop()});
    made.valid = made.check.valid();
    made.faults = made.check.verify.text();
    made.counts = counts_of(made.check);
    made.data = std::move(swept.data);
    made.json = std::move(swept.report);
    made.json["options"] = options_json(command, swept.size);
    made.warnings = std::move(swept.warnings);
    made.deviation = swept.deviation;
    if (made.deviation) {
        made.deviation->volume = made.check.verify.volume;
        append(made.warnings, warnings_of(*made.deviation));
    }
    return made;
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
    const OutputUnit unit(command.input, command.unit);
    Swept swept = [&] {
        ProgressBar bar(command.quiet);
        return problem ? sweep_problem_file(command, guard, bar.sink()) : sweep_cad_file(command, guard, bar.sink());
    }();
    MadeMesh made = checked(command, std::move(swept), guard);
    guard.lift_limit();
    return deliver(command, unit, std::move(made), watch.total(), files);
}

}  // namespace pavior::cli
