#pragma once
/// \file
/// The sweep of one solid of a CAD model whose source cap and linking sides are meshed.

#include <pavior/brep/face_surface.hpp>
#include <pavior/brep/match_quads.hpp>
#include <pavior/core/compiled.hpp>
#include <pavior/core/error.hpp>
#include <pavior/core/progress.hpp>
#include <pavior/one_to_one/cap_boundary.hpp>
#include <pavior/one_to_one/side_grid.hpp>
#include <pavior/one_to_one/sweep_topology.hpp>
#include <pavior/sweep/space_target.hpp>
#include <pavior/sweep/sweep.hpp>
#include <pavior/sweep/target_projection.hpp>
#include <pavior/sweep/untangle_sweep.hpp>

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace pavior {

/// How solids are swept.
struct SolidSweepOptions {
    SweepOptions sweep;  ///< method, strategy, correction, threads
    /// Repair quads and hexahedra that would be inverted, moving nodes only there. False: touch nothing.
    bool smooth = true;
};

/// What the projection of a source cap onto its target came to (target_projection.hpp).
struct TargetReport {
    double residual = 0;            ///< of the affine map at the loops, unit of the target's parameters or of space
    bool corrected = false;         ///< SweepOptions::correction is in
    std::size_t folded_by_map = 0;  ///< quads that the affine map alone folds
    std::vector<Index> folded;      ///< quads still folded
    SmoothReport smooth;
};

/// The mesh of one solid: nodes by id, level by level in the order of the source cap.
struct SolidMesh {
    std::size_t level_size = 0;  ///< nodes of a level
    std::size_t layers = 0;
    std::vector<Index> nodes;        ///< (layers + 1) x level_size ids in BoundaryMesh::nodes
    std::vector<QuadCorners> quads;  ///< of one level, positions in it, counter-clockwise about the sweep direction
    SweepReport sweep;
    std::optional<TargetReport> target;  ///< none if the target was meshed already
    SmoothReport smooth;                 ///< of the hexahedra
};

namespace detail {

[[nodiscard]] PAVIOR_INLINE std::vector<Vec3> positions(const BoundaryMesh& mesh, std::span<const Index> ids);

/// The loops of a sweep as positions in the source cap.
[[nodiscard]] PAVIOR_INLINE Loops local_loops(const LevelIds& levels, const PositionOf& position);

/// Projects the source cap onto a target face with a seam: in space, along the normal of its plane.
template <brep B>
[[nodiscard]] TargetMesh project_along(const B& b, FaceId face, const CapPlane& plane, const SourceCap& source,
                                       std::span<const Vec3> loop_nodes, const TargetOptions& options) {
    const auto place = [&](const Vec3& x) { return lift_to_face(b, face, x, plane.normal()); };
    SpaceTargetMesh projected = project_target_in_space(place, source, loop_nodes, options);
    TargetMesh result;
    for (const Vec3& x : projected.nodes) {
        result.uv.push_back(b.closest_on_face(face, x));
    }
    result.nodes = std::move(projected.nodes);
    result.residual = projected.residual;
    result.corrected = projected.corrected;
    result.folded_by_map = std::move(projected.folded_by_map);
    result.smooth = std::move(projected.smooth);
    result.folded = std::move(projected.folded);
    return result;
}

/// Projects the source cap onto the target face and stores its mesh there.
template <brep B>
TargetMesh mesh_target(const B& b, BoundaryMesh& mesh, const SweepTopology& sweep, const SweepProblem& problem,
                       const LevelIds& levels, const TargetOptions& options) {
    const CapBoundary boundary = cap_boundary(b, mesh, sweep.target);
    const PositionOf on_boundary(boundary.ids);
    const std::span<const Index> loop = levels.level(levels.layers);
    std::vector<Vec2> loop_uv;
    for (const Index id : loop) {
        PAVIOR_ASSERT(on_boundary(id) != no_index);
        loop_uv.push_back(boundary.uv[on_boundary(id)]);
    }
    const std::vector<Vec2> source_uv = has_seam(b, sweep.source)
                                            ? plane_coordinates(problem.source_nodes, problem.quads)
                                            : mesh.faces[sweep.source.index()].uv;
    const SourceCap source{problem.source_nodes, source_uv, problem.quads, problem.loops};
    TargetMesh projected =
        boundary.plane
            ? project_along(b, sweep.target, *boundary.plane, source, positions(mesh, loop), options)
            : project_target(FaceSurface<B>{&b, sweep.target}, source, loop_uv, positions(mesh, loop), options);

    FaceMesh& target = mesh.faces[sweep.target.index()];
    target.nodes.assign(problem.source_nodes.size(), no_index);
    for (std::size_t i = 0; i < loop.size(); ++i) {
        target.nodes[problem.loops.nodes[i]] = loop[i];
    }
    for (std::size_t i = 0; i < target.nodes.size(); ++i) {
        if (target.nodes[i] == no_index) {
            target.nodes[i] = mesh.add_node(projected.nodes[i]);
        }
    }
    target.uv = projected.uv;
    target.quads = sweep.target_outward ? problem.quads : flipped(problem.quads);
    return projected;
}

/// Nodes of the target cap in the order of the source, if the mesh that the target has is that of the source.
/// \throws UnmeshableError not_sweepable, naming both faces, if it is not
template <brep B>
[[nodiscard]] std::vector<Index> match_target(const B& b, const BoundaryMesh& mesh, const SweepTopology& sweep,
                                              const SweepProblem& problem, const LevelIds& levels) {
    const FaceMesh& target = mesh.faces[sweep.target.index()];
    const PositionOf position(target.nodes);
    std::vector<std::pair<Index, Index>> seed;
    for (std::size_t i = 0; i < problem.loops.nodes.size(); ++i) {
        seed.emplace_back(problem.loops.nodes[i], position(levels.level(levels.layers)[i]));
    }
    const auto match = match_quads(problem.quads, sweep.target_outward ? target.quads : flipped(target.quads),
                                   problem.source_nodes.size(), seed);
    if (!match) {
        const int source_tag = b.tag(2, sweep.source.index());
        const int target_tag = b.tag(2, sweep.target.index());
        throw UnmeshableError(ErrorCode::not_sweepable,
                              "faces " + std::to_string(source_tag) + " and " + std::to_string(target_tag) +
                                  " are the caps of one sweep, but other solids need different meshes on them",
                              {source_tag, target_tag});
    }
    std::vector<Index> ids;
    for (const Index at : *match) {
        ids.push_back(target.nodes[at]);
    }
    return ids;
}

/// Adds the inner nodes of a sweep to \p mesh; returns the ids of all its nodes, level by level.
[[nodiscard]] PAVIOR_INLINE std::vector<Index> store_sweep(BoundaryMesh& mesh, const SweepMesh& swept,
                                                           const Loops& loops, const LevelIds& levels,
                                                           std::span<const Index> source_ids,
                                                           std::span<const Index> target_ids);

}  // namespace detail

/// Sweeps one solid: projects the source cap onto the target (or finds the source's mesh there, if the neighbour has
/// meshed it), places the inner levels, and repairs hexahedra that are inverted. The source cap and all linking sides
/// of
/// \p sweep must be meshed in \p mesh; the target's mesh and the inner nodes are added to it. \p intervals by edge id.
/// \throws what verify_problem() finds, UnmeshableError not_sweepable if a neighbour's mesh does not fit
template <brep B>
SolidMesh sweep_solid(const B& b, BoundaryMesh& mesh, const SweepTopology& sweep, std::span<const int> intervals,
                      const SolidSweepOptions& options) {
    const LevelIds levels = level_ids(b, mesh, sweep, intervals);
    const FaceMesh& source = mesh.faces[sweep.source.index()];
    SolidMesh result;
    SweepProblem problem;
    problem.layers = levels.layers;
    problem.source_nodes = detail::positions(mesh, source.nodes);
    problem.quads = sweep.source_outward ? detail::flipped(source.quads) : source.quads;
    problem.loops = detail::local_loops(levels, detail::PositionOf(source.nodes));
    problem.boundary_levels = detail::positions(mesh, levels.ids);
    std::vector<Index> target_ids;
    if (mesh.faces[sweep.target.index()].empty()) {
        TargetOptions target_options;
        target_options.untangle = target_options.smooth_repaired = options.smooth;
        // Beyond section 4.2.2: the target is corrected as the inner levels are, so that they fit together.
        target_options.correction = TargetCorrection::always;
        target_options.by = options.sweep.correction;
        const TargetMesh target = detail::mesh_target(b, mesh, sweep, problem, levels, target_options);
        result.target =
            TargetReport{target.residual, target.corrected, target.folded_by_map.size(), target.folded, target.smooth};
        target_ids = mesh.faces[sweep.target.index()].nodes;
    } else {
        target_ids = detail::match_target(b, mesh, sweep, problem, levels);
    }
    problem.target_nodes = detail::positions(mesh, target_ids);

    SweepResult swept = pavior::sweep(problem, options.sweep);
    if (options.smooth) {
        result.smooth = untangle_sweep(swept.mesh, problem.loops, options.sweep.execution);
    }
    result.layers = levels.layers;
    result.level_size = problem.source_nodes.size();
    result.nodes = detail::store_sweep(mesh, swept.mesh, problem.loops, levels, mesh.faces[sweep.source.index()].nodes,
                                       target_ids);
    result.quads = std::move(problem.quads);
    result.sweep = std::move(swept.report);
    return result;
}

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/one_to_one/sweep_solid-inl.hpp>
#endif
