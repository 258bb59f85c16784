#include "swept.hpp"

#include <pavior/io/sweep_problem_file.hpp>
#include <pavior/sweep/untangle_sweep.hpp>

#include <algorithm>

namespace pavior::cli {

namespace {

using Json = nlohmann::json;

void warn(const SweepReport& report, std::vector<std::string>& warnings) {
    for (const SweepWarning& warning : report.warnings) {
        warnings.emplace_back(to_string(warning.notice));
    }
}

}  // namespace

Json to_json(const SweepReport& report) {
    Json json{{"layers", report.layers},
              {"loops", report.loops},
              {"loop_nodes", report.loop_nodes},
              {"seconds", report.verify_seconds + report.fit_seconds + report.prepare_seconds + report.nodes_seconds}};
    double worst = 0;
    for (const LevelResidual& residual : report.residuals) {
        worst = std::max(worst, residual.max);
    }
    json["max_residual"] = worst;
    json["warnings"] = Json::array();
    for (const SweepWarning& warning : report.warnings) {
        json["warnings"].push_back({{"notice", to_string(warning.notice)}, {"ids", warning.ids}});
    }
    return json;
}

Json to_json(const SmoothReport& report) {
    return {{"status", to_string(report.status)},
            {"inverted_before", report.inverted_before},
            {"inverted_after", report.inverted_after},
            {"inverted_ids", report.inverted_ids},
            {"moved_nodes", report.moved_nodes}};
}

Swept sweep_problem_file(const SweepCommand& command, const Progress& progress) {
    const SweepProblem problem = read_sweep_problem(command.input);
    SweepOptions options = sweep_options(command);
    options.progress = progress;
    SweepResult result = sweep(problem, options);
    Swept swept;
    swept.report["sweep"] = to_json(result.report);
    warn(result.report, swept.warnings);
    if (command.smooth) {
        report(progress, "untangling", 0.9);
        swept.report["smooth"] = to_json(untangle_sweep(result.mesh, problem.loops, options.execution));
    }
    HexMesh& mesh = swept.data.mesh;
    mesh.nodes.assign(result.mesh.nodes().begin(), result.mesh.nodes().end());
    mesh.hexes = result.mesh.hexes();
    return swept;
}

}  // namespace pavior::cli
