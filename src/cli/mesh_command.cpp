#include "check.hpp"
#include "commands.hpp"
#include "grouped.hpp"
#include "meshed.hpp"
#include "progress_bar.hpp"
#include "report_file.hpp"

#include <pavior/brep/touching_solids.hpp>
#include <pavior/core/error.hpp>
#include <pavior/core/stopwatch.hpp>
#include <pavior/mesh/append_mesh.hpp>

#include <algorithm>
#include <iostream>
#include <utility>

namespace pavior::cli {

namespace {

using Json = nlohmann::json;

/// The meshes taken, one after the other.
HexMeshData joined(const GmshBrep& model, std::vector<MeshDecision>& decisions) {
    HexMeshData all;
    for (MeshDecision& decision : decisions) {
        HexMeshData& part = decision.tries[*decision.taken].data;
        append_mesh(part.mesh, part.quads, all.mesh, all.quads);
        all.hex_groups.insert(all.hex_groups.end(), part.hex_groups.begin(), part.hex_groups.end());
        all.quad_groups.insert(all.quad_groups.end(), part.quad_groups.begin(), part.quad_groups.end());
        part = {};
    }
    all.groups = entity_groups(model, all_solids(model));
    return all;
}

Json report_of(const MeshCommand& command, const GmshBrep& model, std::span<const MeshDecision> decisions) {
    Json json{{"input", command.input}, {"output", Json()}, {"decisions", Json::array()}};
    json["options"] = {{"size", command.size > 0 ? command.size : model.diagonal() / 12},
                       {"method", command.method ? Json(to_string(*command.method)) : Json("auto")},
                       {"timeout", command.timeout}};
    json["warnings"] = Json::array();
    for (const MeshDecision& decision : decisions) {
        json["decisions"].push_back(to_json(model, decision));
        if (decision.taken) {
            for (const std::string& warning : decision.tries[*decision.taken].warnings) {
                json["warnings"].push_back(warning);
            }
        }
    }
    return json;
}

/// All lines but the first moved to the right.
std::string indented(std::string text) {
    for (std::size_t at = text.find('\n'); at != std::string::npos; at = text.find('\n', at + 1)) {
        text.insert(at + 1, "    ");
    }
    return text;
}

/// Why there is no mesh, solid by solid, method by method.
ExitCode refuse(const MeshCommand& command, const GmshBrep& model, std::span<const MeshDecision> decisions, Json json,
                double seconds) {
    json["seconds"] = seconds;
    json["exit_code"] = static_cast<int>(exit_not_meshable);
    write_report(command.report, json);
    for (const MeshDecision& decision : decisions) {
        if (decision.taken) {
            continue;
        }
        std::cerr << "pavior: not meshable: " << solids_text(model, decision.solids);
        if (decision.out_of_time) {
            std::cerr << " within the time limit of " << command.timeout << " s a solid";
        }
        std::cerr << "\n";
        for (const MethodTry& attempt : decision.tries) {
            std::cerr << "  " << to_string(attempt.method) << ": " << indented(attempt.reason) << "\n";
        }
    }
    return exit_not_meshable;
}

ExitCode finish(const MeshCommand& command, const GmshBrep& model, std::vector<MeshDecision>& decisions, Json json,
                const Stopwatch& watch) {
    const bool all_valid = std::all_of(decisions.begin(), decisions.end(), [](const auto& d) { return d.valid(); });
    const HexMeshData data = joined(model, decisions);
    const MeshCheck check = check_mesh(data, Execution{command.threads});
    const bool valid = all_valid && check.valid();
    const bool written = valid || command.keep_invalid;
    if (written) {
        write_mesh(command.output, data);
    }
    json["output"] = written ? Json(command.output) : Json();
    json["seconds"] = watch.total();
    json["mesh"] = to_json(data, check);
    json["exit_code"] = static_cast<int>(valid ? exit_valid : exit_invalid);
    write_report(command.report, json);
    for (const Json& warning : json["warnings"]) {
        std::cerr << "pavior: warning: " << warning.get<std::string>() << "\n";
    }
    if (!valid) {
        std::cerr << "pavior: the mesh is not valid:\n";
        for (const MeshDecision& decision : decisions) {
            if (!decision.valid()) {
                std::cerr << solids_text(model, decision.solids) << ": " << decision.tries[*decision.taken].reason
                          << "\n";
            }
        }
        std::cerr << (written ? "it was written because of --keep-invalid\n" : "nothing was written\n");
        return exit_invalid;
    }
    if (!command.quiet) {
        std::cout << command.output << ": " << check.hexahedra << " hexahedra, " << check.nodes
                  << " nodes; scaled Jacobian min " << check.quality.scaled_jacobian.min << ", mean "
                  << check.quality.scaled_jacobian.mean << "; " << watch.total() << " s\n";
    }
    return exit_valid;
}

}  // namespace

ExitCode run_mesh(const MeshCommand& command) {
    if (!can_read_cad(command.input)) {
        throw FileError(command.input, "unknown input format; known are .step .stp .iges .igs .brep");
    }
    if (!can_write_mesh(command.output)) {
        throw FileError(command.output, "unknown mesh format; known are .vtu .vtk .msh .inp");
    }
    const Stopwatch watch;
    ProgressBar bar(command.quiet);
    const Progress progress = bar.sink();
    report(progress, "reading", 0);
    const GmshBrep model = GmshBrep::load(command.input);
    std::vector<MeshDecision> decisions;
    const std::vector<std::vector<SolidId>> groups = touching_solids(model, all_solids(model));
    for (const std::vector<SolidId>& solids : groups) {
        report(progress, solids_text(model, solids),
               static_cast<double>(decisions.size()) / static_cast<double>(groups.size()));
        decisions.push_back(decide(model, solids, command));
    }
    report(progress, "writing", 1);
    if (command.explain) {
        print_tree(std::cout, model, command, decisions);
    }
    Json json = report_of(command, model, decisions);
    if (!std::all_of(decisions.begin(), decisions.end(), [](const auto& d) { return d.taken.has_value(); })) {
        return refuse(command, model, decisions, std::move(json), watch.total());
    }
    return finish(command, model, decisions, std::move(json), watch);
}

}  // namespace pavior::cli
