#include "blocked.hpp"
#include "check.hpp"
#include "commands.hpp"
#include "progress_bar.hpp"
#include "report_file.hpp"

#include <pavior/contributions/contributions.hpp>
#include <pavior/contributions/dual_surfaces.hpp>
#include <pavior/contributions/regions.hpp>
#include <pavior/core/error.hpp>
#include <pavior/core/stopwatch.hpp>
#include <pavior/io/dual_file.hpp>

#include <iostream>
#include <string>
#include <vector>

namespace pavior::cli {

namespace {

using Json = nlohmann::json;

BlockOptions block_options(const BlockCommand& command, const Progress& progress) {
    BlockOptions options;
    options.marking.marking = command.marking;
    options.marking.propagation = command.propagation;
    options.execution = Execution{command.threads};
    options.progress = progress;
    if (command.size > 0.0) {
        options.refine.emplace();
        options.refine->size = command.size;
    }
    return options;
}

/// Dual surfaces and regions, to look at: also of a dual that makes no blocks.
Json write_dual_file(const BlockCommand& command, const SolidBlocks& solid) {
    const Execution execution{command.threads};
    const auto contributions =
        add_contributions(solid.reference, solid.topology, solid.classes, VertexRule::repaired, execution);
    const Regions all = regions(solid.reference, solid.topology, contributions);
    const DualSurfaces surfaces = dual_surfaces(solid.reference, solid.topology, contributions, command.mu);
    const RegionPolyhedra polyhedra = region_polyhedra(solid.reference, solid.topology, all, command.mu);
    write_dual(command.dual, surfaces, polyhedra);
    return {{"file", command.dual},
            {"surface_points", surfaces.points.size()},
            {"surface_polygons", surfaces.size()},
            {"region_points", polyhedra.points.size()},
            {"region_polyhedra", polyhedra.size()},
            {"regions", all.count()}};
}

Json options_json(const BlockCommand& command) {
    Json json{{"marking", command.marking == Marking::sheets ? "sheets" : "published"},
              {"propagation", command.propagation == Propagation::full ? "full" : "stop"},
              {"mu", command.mu}};
    json["size"] = command.size > 0.0 ? Json(command.size) : Json();
    json["feature_angles"] =
        command.feature_angles.empty() ? Json({135.0, 225.0, 315.0}) : Json(command.feature_angles);
    return json;
}

std::vector<std::string> warnings_of(const BlockCommand& command, const SolidBlocks& solid) {
    std::vector<std::string> warnings;
    if (command.size > 0.0 && !solid.placement.inverted.empty()) {
        warnings.push_back(std::to_string(solid.placement.inverted.size()) +
                           " blocks are inverted as straight hexahedra; the mesh inside them follows the geometry");
    }
    return warnings;
}

void print(const BlockCommand& command, const SolidBlocks& solid, const MeshCheck& check, double seconds) {
    const BlockReport& blocks = solid.report.blocks;
    std::cout << command.output << ": " << blocks.blocks << " blocks, " << blocks.nodes() << " block nodes, "
              << blocks.sheets << " sheets";
    if (solid.fine) {
        std::cout << "; " << check.hexahedra << " hexahedra, " << check.nodes << " nodes";
    }
    std::cout << "; scaled Jacobian min " << check.quality.scaled_jacobian.min << ", mean "
              << check.quality.scaled_jacobian.mean << "; " << seconds << " s\n";
}

/// Writes what may be written and says how it went.
ExitCode finish(const BlockCommand& command, const BlockInput& input, const SolidBlocks& solid, Json json,
                double seconds) {
    const HexMeshData data = block_data(input, solid);
    const MeshCheck check = check_mesh(data, Execution{command.threads});
    const std::vector<std::string> warnings = warnings_of(command, solid);
    const bool written = check.valid() || command.keep_invalid;
    if (written) {
        write_mesh(command.output, data);
    }
    json["output"] = written ? Json(command.output) : Json();
    json["seconds"] = seconds;
    json["mesh"] = to_json(data, check);
    json["warnings"] = warnings;
    json["exit_code"] = static_cast<int>(check.valid() ? exit_valid : exit_invalid);
    write_report(command.report, json);
    for (const std::string& warning : warnings) {
        std::cerr << "pavior: warning: " << warning << "\n";
    }
    if (!check.valid()) {
        std::cerr << "pavior: the " << (solid.fine ? "mesh is" : "blocks are") << " not valid:\n"
                  << check.verify.text() << "\n"
                  << (written ? "written because of --keep-invalid\n" : "nothing was written\n");
        return exit_invalid;
    }
    if (!command.quiet) {
        print(command, solid, check, seconds);
    }
    return exit_valid;
}

/// No blocks: the report says why, and the error too.
[[noreturn]] void refuse(const BlockCommand& command, const SolidBlocks& solid, Json json, double seconds) {
    json["output"] = Json();
    json["seconds"] = seconds;
    json["exit_code"] = static_cast<int>(exit_not_meshable);
    write_report(command.report, json);
    solid.report.dual.throw_if_invalid();
    throw UnmeshableError(ErrorCode::invalid_dual, "the layers make no blocks");
}

}  // namespace

SolidBlocks make_blocks(const BlockCommand& command, const ReferenceMesh& reference, const Progress& progress) {
    return block_solid(reference, block_options(command, progress));
}

ExitCode run_block(const BlockCommand& command) {
    if (!can_write_mesh(command.output)) {
        throw FileError(command.output, "unknown mesh format; known are .vtu .vtk .msh .inp");
    }
    if (!(command.mu > 0.0 && command.mu < 0.25)) {
        throw InputError(ErrorCode::bad_option, "--mu must lie between 0 and 1/4");
    }
    const Stopwatch watch;
    BlockInput input;
    SolidBlocks solid;
    Json json;
    {
        ProgressBar bar(command.quiet);
        input = read_block_input(command, bar.sink());
        solid = make_blocks(command, input.reference, bar.sink());
        json = to_json(input, solid);
        if (!command.dual.empty()) {
            json["dual"] = write_dual_file(command, solid);
        }
    }
    json["input"] = command.input;
    json["options"] = options_json(command);
    const double seconds = watch.total();
    if (!solid.report.dual.valid()) {
        refuse(command, solid, std::move(json), seconds);
    }
    return finish(command, input, solid, std::move(json), seconds);
}

}  // namespace pavior::cli
