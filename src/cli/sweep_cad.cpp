#include "grouped.hpp"
#include "refining.hpp"
#include "swept.hpp"

#include <pavior/cad/cap_mesh.hpp>
#include <pavior/cad/gmsh_brep.hpp>
#include <pavior/core/error.hpp>
#include <pavior/glpk/solve_program.hpp>
#include <pavior/one_to_one/intervals.hpp>
#include <pavior/one_to_one/recognition.hpp>
#include <pavior/one_to_one/sweep_model.hpp>

namespace pavior::cli {

namespace {

using Json = nlohmann::json;

FaceId face_with_tag(const GmshBrep& model, int tag, const std::string& option) {
    const auto index = model.find(2, tag);
    if (!index) {
        throw InputError(ErrorCode::bad_option, option + " " + std::to_string(tag) + ": the model has no such face",
                         {tag});
    }
    return FaceId{static_cast<std::int32_t>(*index)};
}

bool has_face(const GmshBrep& model, SolidId solid, FaceId face) {
    for (const OrientedFace& f : model.solid_faces(solid)) {
        if (f.face == face) {
            return true;
        }
    }
    return false;
}

/// The first candidate that honours --source and --target as far as they name faces of this solid.
SweepTopology choose(const GmshBrep& model, SolidId solid, std::optional<FaceId> source, std::optional<FaceId> target) {
    const bool with_source = source && has_face(model, solid, *source);
    const bool with_target = target && has_face(model, solid, *target);
    if (with_source && with_target) {
        return sweep_between(model, solid, *source, *target);
    }
    if (!with_source && !with_target) {
        return best_sweep(model, solid);
    }
    const FaceId wanted = with_source ? *source : *target;
    for (const SweepTopology& sweep : recognise_sweeps(model, solid).candidates) {
        if (sweep.source == wanted || sweep.target == wanted) {
            return (sweep.source == wanted) == with_source ? sweep : reversed(sweep);
        }
    }
    const int tag = model.tag(2, wanted.index());
    throw UnmeshableError(ErrorCode::not_sweepable,
                          "solid " + std::to_string(model.tag(3, solid.index())) + " has no sweep with face " +
                              std::to_string(tag) + " as a cap",
                          {tag});
}

std::vector<SweepTopology> recognise(const GmshBrep& model, std::span<const SolidId> solids,
                                     const SweepCommand& command) {
    std::optional<FaceId> source;
    std::optional<FaceId> target;
    if (command.source) {
        source = face_with_tag(model, *command.source, "--source");
    }
    if (command.target) {
        target = face_with_tag(model, *command.target, "--target");
    }
    std::vector<SweepTopology> sweeps;
    for (const SolidId solid : solids) {
        sweeps.push_back(choose(model, solid, source, target));
    }
    return sweeps;
}

IntervalOptions interval_options(const GmshBrep& model, const SweepCommand& command) {
    IntervalOptions options;
    options.size = command.size > 0 ? command.size : model.diagonal() / 12;
    options.edge_size = command.edge_size;
    options.face_size = command.face_size;
    options.solid_size = command.solid_size;
    options.layers = command.layers;
    return options;
}

Json to_json(const GmshBrep& model, const ModelMesh& result, const IntervalAssignment& intervals) {
    Json json;
    json["intervals"] = {{"mean_ratio", intervals.mean_ratio},
                         {"worst_ratio", intervals.worst_ratio},
                         {"optimal", intervals.optimal},
                         {"angles_kept", intervals.angles_kept}};
    json["solids"] = Json::array();
    for (const SolidReport& solid : result.solids) {
        Json entry{{"solid", model.tag(3, solid.solid.index())},
                   {"name", model.solid_name(solid.solid)},
                   {"source", model.tag(2, solid.source.index())},
                   {"target", model.tag(2, solid.target.index())},
                   {"layers", solid.layers},
                   {"first_hex", solid.first_hex},
                   {"hexahedra", solid.hex_count},
                   {"cad_volume", model.solid_volume(solid.solid)},
                   {"sweep", cli::to_json(solid.sweep)},
                   {"smooth", cli::to_json(solid.smooth)}};
        if (solid.target_projection) {
            const TargetReport& target = *solid.target_projection;
            entry["target_projection"] = {{"residual", target.residual},
                                          {"folded_by_map", target.folded_by_map},
                                          {"folded", target.folded},
                                          {"smooth", cli::to_json(target.smooth)}};
        }
        json["solids"].push_back(std::move(entry));
    }
    json["linking_sides"] = Json::array();
    for (const LinkingFaceReport& side : result.sides) {
        json["linking_sides"].push_back({{"face", model.tag(2, side.face.index())},
                                         {"way", to_string(side.way)},
                                         {"folded_by_interpolation", side.folded_parameter},
                                         {"folded", side.folded}});
    }
    return json;
}

void warn(const GmshBrep& model, const ModelMesh& result, const IntervalAssignment& intervals,
          std::vector<std::string>& warnings) {
    if (!intervals.angles_kept) {
        warnings.emplace_back("the numbers prescribed leave curved edges coarser than 45 degrees an interval");
    }
    for (const LinkingFaceReport& side : result.sides) {
        if (!side.folded.empty()) {
            warnings.push_back("face " + std::to_string(model.tag(2, side.face.index())) + ": " +
                               std::to_string(side.folded.size()) + " folded quads");
        }
    }
    for (const SolidReport& solid : result.solids) {
        if (solid.target_projection && !solid.target_projection->folded.empty()) {
            warnings.push_back("face " + std::to_string(model.tag(2, solid.target.index())) + ": " +
                               std::to_string(solid.target_projection->folded.size()) + " folded quads on the target");
        }
    }
}

}  // namespace

namespace {

/// Intervals and mesh for one wish of sizes.
struct Attempt {
    IntervalAssignment intervals;
    ModelMesh mesh;
};

Attempt attempt(const GmshBrep& model, const std::vector<SweepTopology>& sweeps, const SweepCommand& command,
                const IntervalOptions& wishes, const Progress& progress) {
    report(progress, "intervals", 0);
    Attempt result{assign_intervals(model, sweeps, wishes, GlpkSolver{}), {}};
    ModelSweepOptions options;
    options.solid.sweep = sweep_options(command);
    options.solid.smooth = command.smooth;
    options.progress = progress;
    result.mesh = sweep_model(model, sweeps, result.intervals.intervals, GmshCapMesher{&model}, options);
    return result;
}

}  // namespace

Swept sweep_cad_model(const GmshBrep& model, std::span<const SolidId> solids, const SweepCommand& command,
                      const Progress& progress) {
    report(progress, "recognition", 0);
    const std::vector<SweepTopology> sweeps = recognise(model, solids, command);
    Swept swept;
    IntervalOptions wishes = interval_options(model, command);
    Attempt result = with_finer_sizes(wishes.size, swept.warnings, [&](double size, int min_loop) {
        wishes.size = size;
        wishes.min_loop = min_loop;
        return attempt(model, sweeps, command, wishes, progress);
    });
    swept.report = to_json(model, result.mesh, result.intervals);
    warn(model, result.mesh, result.intervals, swept.warnings);
    swept.data = grouped(model, solids, result.mesh);
    return swept;
}

Swept sweep_cad_file(const SweepCommand& command, const Progress& progress) {
    report(progress, "reading", 0);
    const GmshBrep model = GmshBrep::load(command.input);
    return sweep_cad_model(model, all_solids(model), command, progress);
}

}  // namespace pavior::cli
