#pragma once

#include <pavior/part/detail/finer_sizes.hpp>
#include <pavior/part/detail/part_text.hpp>
#include <pavior/part/detail/trial.hpp>
#include <pavior/part/entity_groups.hpp>
#include <pavior/part/mixed_solids.hpp>
#include <pavior/part/multi_sweep_solids.hpp>
#include <pavior/part/split_solids.hpp>
#include <pavior/part/sweep_solids.hpp>
#include <pavior/submap/submap_model.hpp>

#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace pavior::detail {

[[nodiscard]] inline IntervalOptions wishes_of(const Trial& trial) {
    IntervalOptions wishes;
    wishes.size = trial.size();
    wishes.max_angle = trial.options.max_angle;
    wishes.edge_size = trial.options.local.edge;
    wishes.face_size = trial.options.local.face;
    wishes.solid_size = trial.options.local.solid;
    return wishes;
}

[[nodiscard]] inline LocalSizes local_sizes(const Trial& trial) {
    return {trial.options.local.edge, trial.options.local.face, trial.options.local.solid};
}

/// The mesh as groups, with the entities that its cells belong to.
inline void take_mesh(Trial& trial, SolidsMesh mesh) {
    trial.result.hex_solid = mesh.hex_solid;
    trial.result.quad_face = mesh.quad_face;
    trial.result.data = grouped(trial.model, trial.solids, std::move(mesh));
}

PAVIOR_INLINE void try_submap(Trial& trial) {
    SubmappedMesh mesh = submap_model(trial.model, trial.solids, wishes_of(trial), trial.kernels.solver, trial.submap);
    trial.describe(&mesh);
    for (const SubmapSolidReport& solid : mesh.solids) {
        trial.result.notes.push_back(note_of(solid));
    }
    take_mesh(trial, std::move(mesh));
}

PAVIOR_INLINE void try_sweep(Trial& trial) {
    const AnyModel& model = trial.model;
    SweepSolidsOptions own;
    own.intervals = wishes_of(trial);
    own.sweep.solid.sweep.execution = trial.options.execution;
    SweptSolids swept = sweep_solids(model, trial.solids, own, trial.kernels.solver, trial.kernels.caps);
    trial.describe(&swept);
    trial.result.warnings = std::move(swept.warnings);
    for (const SolidReport& solid : swept.mesh.solids) {
        trial.result.notes.push_back("from face " + std::to_string(model.tag(2, solid.source.index())) + " to face " +
                                     std::to_string(model.tag(2, solid.target.index())) + " in " +
                                     std::to_string(solid.layers) + " layers");
    }
    take_mesh(trial, std::move(swept.mesh));
}

PAVIOR_INLINE void try_multi_sweep(Trial& trial) {
    const AnyModel& model = trial.model;
    MultiSweepOptions own;
    own.size = trial.size();
    own.max_angle = trial.options.max_angle;
    own.off_face = trial.options.imprint_tolerance;
    own.execution = trial.options.execution;
    BestMultiSweep best =
        multi_sweep_solids(model, trial.solids, own, trial.kernels, trial.out_of_time, local_sizes(trial));
    trial.describe(&best);
    for (const MultiSweepAttempt& attempt : best.attempts) {
        std::vector<int> edges;
        for (const OrientedEdge& use : attempt.path.ribs) {
            edges.push_back(model.tag(1, use.edge.index()));
        }
        trial.result.notes.push_back(note_of(attempt, edges));
    }
    if (!best.mesh) {
        throw no_mesh_error(best);
    }
    take_mesh(trial, std::move(*best.mesh));
}

PAVIOR_INLINE void try_mixed(Trial& trial) {
    const AnyModel& model = trial.model;
    MixedOptions own;
    own.execution = trial.options.execution;
    own.sizes = local_sizes(trial);
    own.max_angle = trial.options.max_angle;
    own.submap = trial.submap;
    MixedSolids mesh;
    with_finer_sizes(trial.size(), trial.result.warnings, [&](double size, int min_loop) {
        own.size = size;
        own.min_loop = min_loop;
        mesh = mixed_solids(model, trial.solids, own, trial.kernels, trial.out_of_time);
    });
    trial.describe(&mesh);
    for (const auto& [solid, method] : mesh.methods) {
        trial.result.notes.push_back("solid " + std::to_string(model.tag(3, solid.index())) + ": " +
                                     std::string(to_string(method)));
    }
    take_mesh(trial, std::move(mesh));
}

/// "tetrahedra of size 2: 0.25, 1200 hexahedra", or why not.
[[nodiscard]] inline std::string note_of(const SplitAttempt& attempt) {
    std::ostringstream text;
    text.precision(3);
    text << "tetrahedra of size " << attempt.sizes.size << ": ";
    if (!attempt.error.empty()) {
        text << attempt.error;
    } else {
        text << 4 * attempt.tets << " hexahedra, least scaled Jacobian " << attempt.split_jacobian << ", then "
             << attempt.min_jacobian;
    }
    return text.str();
}

PAVIOR_INLINE void try_split(Trial& trial) {
    SplitOptions own;
    own.size = trial.size();
    own.max_angle = trial.options.max_angle;
    own.local = trial.options.local;
    own.sufficient = trial.options.sufficient;
    own.max_hexahedra = trial.options.max_hexahedra;
    own.seconds = trial.seconds;
    own.execution = trial.options.execution;
    SplitSolids mesh = split_solids(trial.model, trial.solids, own, trial.kernels.tets);
    trial.describe(&mesh);
    MethodTry& result = trial.result;
    result.notes.emplace_back("last resort: tetrahedra, each split in four");
    for (const SplitAttempt& attempt : mesh.attempts) {
        result.notes.push_back(note_of(attempt));
    }
    if (!mesh.limit.empty()) {
        result.warnings.push_back("split: the least scaled Jacobian stays at " + mesh.limit +
                                  (mesh.out_of_time ? "; there was no time for other tetrahedra" : ""));
    }
    if (const std::size_t off = mesh.attempts[mesh.taken].off; off > 0) {
        result.warnings.push_back("split: " + std::to_string(off) +
                                  " boundary nodes lie off their faces and edges, so that no hexahedron is inverted");
    }
    take_mesh(trial, std::move(mesh));
}

}  // namespace pavior::detail
