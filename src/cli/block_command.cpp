#include "made_mesh.hpp"
#include "progress_bar.hpp"

#include <pavior/block/block_mesh_data.hpp>
#include <pavior/block/block_solid.hpp>
#include <pavior/block/surface_distance.hpp>
#include <pavior/cad/gmsh_brep.hpp>
#include <pavior/contributions/contributions.hpp>
#include <pavior/contributions/dual_surfaces.hpp>
#include <pavior/contributions/regions.hpp>
#include <pavior/core/error.hpp>
#include <pavior/core/stopwatch.hpp>
#include <pavior/io/dual_file.hpp>
#include <pavior/io/mesh_file.hpp>
#include <pavior/part/any_model.hpp>
#include <pavior/part/block_reference.hpp>
#include <pavior/part/cad_deviation.hpp>
#include <pavior/part/local_lengths.hpp>

#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace pavior::cli {

namespace {

using Json = nlohmann::json;

BlockOptions block_options(const BlockCommand& command, const Guard& guard, const Progress& progress) {
    BlockOptions options;
    options.marking.marking = command.marking;
    options.marking.propagation = command.propagation;
    options.dualization = command.dualization;
    options.execution = Execution{command.threads, guard.stop()};
    options.progress = progress;
    if (command.size > 0.0) {
        options.refine.emplace();
        options.refine->size = command.size;
        options.refine->curve_size = command.local.edge;
        options.refine->patch_size = command.local.face;
        options.refine->max_angle = command.max_angle;
    }
    return options;
}

/// Local sizes by tag. Of the solids of a CAD model only a single one may have a size, which is then that of all.
BlockCommand with_local_sizes(BlockCommand command, const Guard& guard) {
    const auto refuse = [](const char* message) { throw InputError(ErrorCode::bad_option, message); };
    if (command.local.empty()) {
        return command;
    }
    if (command.size <= 0) {
        refuse("--local-size needs --size: without it the blocks themselves are written");
    }
    if (can_read_cad(command.input)) {
        const GmshBrep model = GmshBrep::load(command.input, cad_options(command, guard));
        command.local = lengths_by_tag(model, command.local);
        if (!command.local.solid.empty() && model.solid_count() > 1) {
            refuse("several solids become blocks of one size: use --size, or sizes of faces and edges");
        }
        for (const auto& [tag, size] : std::exchange(command.local.solid, {})) {
            command.size = size;
        }
    } else if (!command.local.named.empty() || !command.local.solid.empty()) {
        refuse("--local-size by name or for a solid needs a CAD model: this input has edges and faces by tag");
    }
    return command;
}

/// \throws InputError for a local size of an edge or face that bounds no blocks
void check_tags(const BlockCommand& command, const BlockReference& input) {
    std::vector<int> curves;
    for (const FeatureEdge& edge : input.mesh.curves) {
        curves.push_back(edge.curve);
    }
    require_tags(command.local.edge, std::move(curves), "edge");
    require_tags(command.local.face, input.surface.face_tags, "face");
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
Json write_dual_file(const BlockCommand& command, const SolidBlocks& solid, const Guard& guard, OutputFiles& files) {
    const Execution execution{command.threads, guard.stop()};
    const auto contributions =
        add_contributions(solid.reference, solid.topology, solid.classes, VertexRule::repaired, execution);
    const Regions all = regions(solid.reference, solid.topology, contributions);
    const DualSurfaces surfaces = dual_surfaces(solid.reference, solid.topology, contributions, command.mu);
    const RegionPolyhedra polyhedra = region_polyhedra(solid.reference, solid.topology, all, command.mu);
    files.write(command.dual, [&](const std::string& temporary) { write_dual(temporary, surfaces, polyhedra); });
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
    json["local_sizes"] = lengths_json(command.local);
    json["timeout"] = command.timeout ? Json(*command.timeout) : Json();
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

std::string digits(double number) {
    std::ostringstream text;
    text << number;
    return text.str();
}

std::string counts_with_blocks(const SolidBlocks& solid, const MeshCheck& check) {
    const BlockReport& blocks = solid.report.blocks;
    const std::string counts = std::to_string(blocks.blocks) + " blocks, " + std::to_string(blocks.nodes()) +
                               " block nodes, " + std::to_string(blocks.sheets) + " sheets";
    return solid.fine ? counts + "; " + counts_of(check) : counts;
}

MadeMesh checked(const BlockCommand& command, BlockReference& input, const SolidBlocks& solid, Json json) {
    MadeMesh made;
    made.data = block_mesh_data(solid, input.surface, input.cad ? "face " : "tag ");
    made.check = check_mesh(made.data.mesh, Execution{command.threads});
    made.valid = made.check.valid();
    made.what = solid.fine ? "the mesh is" : "the blocks are";
    made.faults = made.check.verify.text();
    made.counts = counts_with_blocks(solid, made.check);
    made.deviation = deviation_of(command, input, made.data, made.check);
    made.json = std::move(json);
    made.warnings = std::move(input.warnings);
    append(made.warnings, warnings_of(command, solid));
    if (made.valid && command.size > 0.0 && lacks_a_part(*made.deviation, command.max_angle)) {
        made.valid = false;
        made.faults = "its volume is " + digits(made.check.verify.volume) + ", that of the geometry " +
                      digits(*made.deviation->cad_volume) + ": the blocks pass over a part of it";
    } else {
        append(made.warnings, warnings_of(*made.deviation));
    }
    return made;
}

/// No blocks: the report says why, and the error too.
[[noreturn]] void refuse(const BlockCommand& command, const SolidBlocks& solid, Json json, double seconds,
                         OutputFiles& files) {
    json["output"] = Json();
    json["seconds"] = seconds;
    json["exit_code"] = static_cast<int>(exit_not_meshable);
    files.write_report(command.report, json);
    files.commit();
    solid.report.dual.throw_if_invalid();
    throw UnmeshableError(ErrorCode::invalid_dual, "the layers make no blocks");
}

}  // namespace

ExitCode run_block(const BlockCommand& given, Guard& guard) {
    static_cast<void>(mesh_format(given.output, given.format));  // refuses what cannot be written
    if (!(given.mu > 0.0 && given.mu < 0.25)) {
        throw InputError(ErrorCode::bad_option, "--mu must lie between 0 and 1/4");
    }
    OutputFiles files(given.input, {given.output, given.report, given.dual});
    guard.set_limit(given.timeout.value_or(0), late_report(given));
    const Stopwatch watch;
    const BlockCommand command = with_local_sizes(given, guard);
    const OutputUnit unit(command.input, command.unit);
    BlockReference input;
    SolidBlocks solid;
    Json json;
    {
        ProgressBar bar(command.quiet);
        input = read_block_reference(command.input, {.size = command.size,
                                                     .features = feature_options(command),
                                                     .max_hexahedra = command.max_hexahedra,
                                                     .seconds = guard.seconds_left(),
                                                     .stop = guard.stop(),
                                                     .progress = bar.sink()});
        check_tags(command, input);
        solid = block_solid(input.mesh, block_options(command, guard, bar.sink()));
        json = detail::to_json(input, solid);
        if (!command.dual.empty()) {
            json["dual"] = write_dual_file(command, solid, guard, files);
        }
        guard.lift_limit();
    }
    json["input"] = command.input;
    json["options"] = options_json(command);
    const double seconds = watch.total();
    if (!solid.report.dual.valid()) {
        refuse(command, solid, std::move(json), seconds, files);
    }
    return deliver(command, unit, checked(command, input, solid, std::move(json)), seconds, files);
}

}  // namespace pavior::cli
