#include "check.hpp"
#include "commands.hpp"
#include "output_unit.hpp"
#include "progress_bar.hpp"
#include "report_file.hpp"

#include <pavior/block/block_mesh_data.hpp>
#include <pavior/block/block_solid.hpp>
#include <pavior/block/surface_distance.hpp>
#include <pavior/contributions/contributions.hpp>
#include <pavior/contributions/dual_surfaces.hpp>
#include <pavior/contributions/regions.hpp>
#include <pavior/core/error.hpp>
#include <pavior/core/stopwatch.hpp>
#include <pavior/io/dual_file.hpp>
#include <pavior/io/mesh_file.hpp>
#include <pavior/part/block_reference.hpp>
#include <pavior/part/cad_deviation.hpp>

#include <iostream>
#include <string>
#include <utility>
#include <vector>

namespace pavior::cli {

namespace {

using Json = nlohmann::json;

BlockOptions block_options(const BlockCommand& command, const Progress& progress) {
    BlockOptions options;
    options.marking.marking = command.marking;
    options.marking.propagation = command.propagation;
    options.dualization = command.dualization;
    options.execution = Execution{command.threads};
    options.progress = progress;
    if (command.size > 0.0) {
        options.refine.emplace();
        options.refine->size = command.size;
        options.refine->max_angle = command.max_angle;
    }
    return options;
}

FeatureOptions feature_options(const BlockCommand& command) {
    FeatureOptions features;
    if (!command.feature_angles.empty()) {
        features.end_below = command.feature_angles[0];
        features.corner_above = command.feature_angles[1];
        features.reversal_above = command.feature_angles[2];
    }
    return features;
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
              {"dualization", command.dualization == Dualization::complex ? "complex" : "contributions"},
              {"max_angle", command.max_angle},
              {"mu", command.mu}};
    json["size"] = command.size > 0.0 ? Json(command.size) : Json();
    json["feature_angles"] =
        command.feature_angles.empty() ? Json({135.0, 225.0, 315.0}) : Json(command.feature_angles);
    return json;
}

std::vector<std::string> warnings_of(const BlockCommand& command, const SolidBlocks& solid) {
    std::vector<std::string> warnings;
    if (command.propagation == Propagation::full && solid.report.marking.propagation == Propagation::stop) {
        warnings.emplace_back(
            "sheets that all run on to the boundary make no valid blocks: some stop at curves of others");
    }
    if (command.size > 0.0 && !solid.placement.inverted.empty()) {
        warnings.push_back(std::to_string(solid.placement.inverted.size()) +
                           " blocks are inverted as straight hexahedra; the mesh inside them follows the geometry");
    }
    return warnings;
}

/// From the CAD model, or from the surface that came instead of one.
CadDeviation deviation_of(const BlockCommand& command, const BlockReference& input, const HexMeshData& data,
                          const MeshCheck& check) {
    const TriMesh& surface = input.surface.mesh;
    CadDeviation result;
    result.volume = check.verify.volume;
    result.cad_volume = input.volume ? *input.volume : enclosed_volume(surface.nodes, surface.triangles);
    result.distance = input.chord + surface_distance(data.mesh.nodes, data.quads, surface.nodes, surface.triangles);
    result.size = command.size;
    return result;
}

void print(const BlockCommand& command, const SolidBlocks& solid, const OutputUnit& unit, const MeshCheck& check,
           const CadDeviation& deviation, double seconds) {
    const BlockReport& blocks = solid.report.blocks;
    std::string counts = std::to_string(blocks.blocks) + " blocks, " + std::to_string(blocks.nodes()) +
                         " block nodes, " + std::to_string(blocks.sheets) + " sheets";
    if (solid.fine) {
        counts += "; " + counts_of(check);
    }
    print_summary(command.output + unit.text(), counts, check, deviation, seconds);
}

/// Writes what may be written and says how it went.
ExitCode finish(const BlockCommand& command, const BlockReference& input, const SolidBlocks& solid,
                const OutputUnit& unit, Json json, double seconds) {
    HexMeshData data = block_mesh_data(solid, input.surface, input.cad ? "face " : "tag ");
    const MeshCheck check = check_mesh(data.mesh, Execution{command.threads});
    const CadDeviation deviation = deviation_of(command, input, data, check);
    std::vector<std::string> warnings = input.warnings;
    for (std::string& warning : warnings_of(command, solid)) {
        warnings.push_back(std::move(warning));
    }
    for (std::string& warning : warnings_of(deviation)) {
        warnings.push_back(std::move(warning));
    }
    const bool written = check.valid() || command.keep_invalid;
    json["mesh"] = detail::to_json(data, check);
    json["unit"] = unit.json();
    if (written) {
        unit.apply(data);
        write_mesh(command.output, data);
    }
    json["output"] = written ? Json(command.output) : Json();
    json["seconds"] = seconds;
    json["deviation"] = detail::to_json(deviation);
    json["warnings"] = warnings;
    json["exit_code"] = static_cast<int>(check.valid() ? exit_valid : exit_invalid);
    write_report(command.report, json);
    print_warnings(warnings);
    if (!check.valid()) {
        print_invalid(solid.fine ? "the mesh is" : "the blocks are", check.verify.text(), written);
        return exit_invalid;
    }
    if (!command.quiet) {
        print(command, solid, unit, check, deviation, seconds);
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

ExitCode run_block(const BlockCommand& command) {
    if (!can_write_mesh(command.output)) {
        throw FileError(command.output, "unknown mesh format; known are .vtu .vtk .msh .inp");
    }
    if (!(command.mu > 0.0 && command.mu < 0.25)) {
        throw InputError(ErrorCode::bad_option, "--mu must lie between 0 and 1/4");
    }
    const Stopwatch watch;
    const OutputUnit unit(command.input, command.unit);
    BlockReference input;
    SolidBlocks solid;
    Json json;
    {
        ProgressBar bar(command.quiet);
        input = read_block_reference(command.input, command.size, feature_options(command), bar.sink());
        solid = block_solid(input.mesh, block_options(command, bar.sink()));
        json = detail::to_json(input, solid);
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
    return finish(command, input, solid, unit, std::move(json), seconds);
}

}  // namespace pavior::cli
