#pragma once
/// \file
/// The sweep of one solid of a CAD model whose source cap and linking sides are meshed.

#include <pavior/core/error.hpp>
#include <pavior/core/progress.hpp>
#include <pavior/model/cap_boundary.hpp>
#include <pavior/model/face_surface.hpp>
#include <pavior/model/match_quads.hpp>
#include <pavior/model/side_grid.hpp>
#include <pavior/smooth/hexes.hpp>
#include <pavior/sweep/sweep.hpp>
#include <pavior/sweep/target_projection.hpp>

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace pavior {

/// How solids are swept.
struct SolidSweepOptions {
    SweepOptions sweep;  ///< method, strategy, correction, threads
    /// Repair quads and hexahedra that would be inverted, moving nodes only there. False: touch nothing.
    bool smooth = true;
};

/// The mesh of one solid: nodes by id, level by level in the order of the source cap.
struct SolidMesh {
    std::size_t level_size = 0;   ///< nodes of a level
    std::size_t layers = 0;
    std::vector<Index> nodes;     ///< (layers + 1) x level_size ids in BoundaryMesh::nodes
    std::vector<QuadCorners> quads;  ///< of one level, positions in it, counter-clockwise about the sweep direction
    SweepReport sweep;
    std::optional<TargetReport> target;  ///< none if the target was meshed already
    SmoothReport smooth;                 ///< of the hexahedra
};

namespace detail {

/// Quads seen from the other side.
[[nodiscard]] inline std::vector<QuadCorners> flipped(std::vector<QuadCorners> quads) {
    for (QuadCorners& quad : quads) {
        std::swap(quad[1], quad[3]);
    }
    return quads;
}

/// Ids to positions in a list of ids.
class PositionOf {
public:
    explicit PositionOf(std::span<const Index> ids) {
        positions_.reserve(ids.size());
        for (std::size_t i = 0; i < ids.size(); ++i) {
            positions_.emplace(ids[i], static_cast<Index>(i));
        }
    }
    [[nodiscard]] Index operator()(Index id) const {
        const auto found = positions_.find(id);
        return found == positions_.end() ? no_node : found->second;
    }

private:
    std::unordered_map<Index, Index> positions_;
};

[[nodiscard]] inline std::vector<Vec3> positions(const BoundaryMesh& mesh, std::span<const Index> ids) {
    std::vector<Vec3> points;
    points.reserve(ids.size());
    for (const Index id : ids) {
        points.push_back(mesh.nodes[id]);
    }
    return points;
}

/// The loops of a sweep as positions in the source cap.
[[nodiscard]] inline Loops local_loops(const LevelIds& levels, const PositionOf& position) {
    Loops loops;
    for (std::size_t l = 0; l + 1 < levels.offsets.size(); ++l) {
        std::vector<Index> loop;
        for (std::size_t i = levels.offsets[l]; i < levels.offsets[l + 1]; ++i) {
            loop.push_back(position(levels.level(0)[i]));
            PAVIOR_ASSERT(loop.back() != no_node);
        }
        loops.add(loop);
    }
    return loops;
}

/// Projects the source cap onto the target face and stores its mesh there.
template <brep B>
TargetReport mesh_target(const B& b, BoundaryMesh& mesh, const SweepTopology& sweep, const SweepProblem& problem,
                         const LevelIds& levels, bool smooth) {
    const FaceMesh& source = mesh.faces[sweep.source.index()];
    const CapBoundary boundary = cap_boundary(b, mesh, sweep.target);
    const PositionOf on_boundary(boundary.ids);
    TargetProblem input;
    input.source_uv = source.uv;
    input.quads = problem.quads;
    input.loops = problem.loops;
    input.source_nodes = problem.source_nodes;
    for (const Index id : levels.level(levels.layers)) {
        const Index at = on_boundary(id);
        PAVIOR_ASSERT(at != no_node);
        input.target_boundary_uv.push_back(boundary.uv[at]);
        input.target_boundary.push_back(mesh.nodes[id]);
    }
    TargetOptions options;
    options.smooth = smooth;
    TargetMesh projected = project_target(FaceSurface<B>{&b, sweep.target}, input, options);

    FaceMesh& target = mesh.faces[sweep.target.index()];
    target.nodes.assign(problem.source_nodes.size(), no_node);
    for (std::size_t i = 0; i < problem.loops.nodes.size(); ++i) {
        target.nodes[problem.loops.nodes[i]] = levels.level(levels.layers)[i];
    }
    for (std::size_t i = 0; i < target.nodes.size(); ++i) {
        if (target.nodes[i] == no_node) {
            target.nodes[i] = mesh.add_node(projected.nodes[i]);
        }
    }
    target.uv = std::move(projected.uv);
    target.quads = sweep.target_outward ? problem.quads : flipped(problem.quads);
    return std::move(projected.report);
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

/// Untangles the hexahedra of a solid with the nodes of its boundary fixed.
inline SmoothReport untangle_solid(BoundaryMesh& mesh, const SolidMesh& solid, const SweepProblem& problem,
                                   const Execution& execution) {
    std::vector<Vec3> nodes = positions(mesh, solid.nodes);
    std::vector<std::uint8_t> fixed(nodes.size(), 0);
    const std::size_t n = solid.level_size;
    std::fill(fixed.begin(), fixed.begin() + static_cast<std::ptrdiff_t>(n), std::uint8_t{1});
    std::fill(fixed.end() - static_cast<std::ptrdiff_t>(n), fixed.end(), std::uint8_t{1});
    std::vector<HexCorners> hexes;
    hexes.reserve(solid.layers * solid.quads.size());
    for (std::size_t k = 0; k < solid.layers; ++k) {
        for (const Index node : problem.loops.nodes) {
            fixed[k * n + node] = 1;
        }
        const auto below = static_cast<Index>(k * n);
        const auto above = static_cast<Index>((k + 1) * n);
        for (const QuadCorners& q : solid.quads) {
            hexes.push_back({below + q[0], below + q[1], below + q[2], below + q[3], above + q[0], above + q[1],
                             above + q[2], above + q[3]});
        }
    }
    UntangleOptions options;
    options.execution = execution;
    SmoothReport report = untangle_hexes(nodes, hexes, fixed, options);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        mesh.nodes[solid.nodes[i]] = nodes[i];
    }
    return report;
}

}  // namespace detail

/// Sweeps one solid: projects the source cap onto the target (or finds the source's mesh there, if the neighbour has
/// meshed it), places the inner levels, and repairs hexahedra that are inverted. The source cap and all linking sides of
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

    result.layers = levels.layers;
    result.level_size = source.nodes.size();
    result.quads = problem.quads;
    result.nodes = source.nodes;
    std::vector<Index> target_ids;
    if (mesh.faces[sweep.target.index()].empty()) {
        result.target = detail::mesh_target(b, mesh, sweep, problem, levels, options.smooth);
        target_ids = mesh.faces[sweep.target.index()].nodes;
    } else {
        target_ids = detail::match_target(b, mesh, sweep, problem, levels);
    }
    problem.target_nodes = detail::positions(mesh, target_ids);

    const SweepMesh swept = pavior::sweep(problem, options.sweep);
    result.sweep = swept.report();
    std::vector<Vec3> level(result.level_size);
    std::vector<Index> ids(result.level_size);
    for (std::size_t k = 1; k < levels.layers; ++k) {
        std::fill(ids.begin(), ids.end(), no_node);
        for (std::size_t i = 0; i < problem.loops.nodes.size(); ++i) {
            ids[problem.loops.nodes[i]] = levels.level(k)[i];
        }
        swept.level(k, level);
        for (std::size_t i = 0; i < ids.size(); ++i) {
            ids[i] = ids[i] == no_node ? mesh.add_node(level[i]) : ids[i];
        }
        result.nodes.insert(result.nodes.end(), ids.begin(), ids.end());
    }
    result.nodes.insert(result.nodes.end(), target_ids.begin(), target_ids.end());
    if (options.smooth) {
        result.smooth = detail::untangle_solid(mesh, result, problem, options.sweep.execution);
    }
    return result;
}

}  // namespace pavior
