#pragma once
/// \file
/// Meshes touching solids, some swept, some submapped, beside others that are meshed already.

#include <pavior/core/error.hpp>
#include <pavior/one_to_one/sweep_model.hpp>
#include <pavior/submap/submap_model.hpp>

#include <cstddef>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace pavior {

struct MixedModelOptions {
    ModelSweepOptions sweep;
    SolidSubmapOptions submap;
};

/// Nodes: those given first, with their ids, then new ones as in ModelMesh. Hexahedra: swept solids, then submapped
/// ones. Quads of faces that were given are left out.
struct MixedMesh : ModelMesh {
    std::vector<SubmapSolidReport> submapped;  ///< in the order of SubmapModel::solids
};

/// The numbers of intervals of the edges of \p given, as IntervalOptions::edge_intervals.
template <brep B>
[[nodiscard]] std::map<int, int> given_intervals(const B& b, const BoundaryMesh& given) {
    std::map<int, int> result;
    for (std::size_t e = 0; e < given.edges.size(); ++e) {
        if (!given.edges[e].nodes.empty()) {
            result.emplace(b.tag(1, e), static_cast<int>(given.edges[e].nodes.size()) - 1);
        }
    }
    return result;
}

/// Meshes the solids of \p sweeps and \p submaps with the numbers of assign_submap_intervals() for both, each shared
/// face once: submapped faces first, then linking sides, then caps in an order in which each sweep finds the mesh of a
/// neighbour at its source. \p given (neighbour_boundary(), or empty) holds what neighbours that are done have made of
/// the faces and edges that they share; its edges must have the numbers of \p intervals (given_intervals()).
/// The result is not verified; use verify_hexes(). Deterministic if the model and the mesher are.
/// \throws UnmeshableError not_sweepable naming faces on which neighbours need different meshes, not_submappable naming
/// a face of a submapped solid whose given mesh is not structured; what sweep_model() and submap_model() throw
template <brep B, cap_mesher M>
[[nodiscard]] MixedMesh mixed_model(const B& b, std::span<const SweepTopology> sweeps, const SubmapModel& submaps,
                                    const SubmapIntervals& intervals, M&& mesher, BoundaryMesh given = {},
                                    const MixedModelOptions& options = {}) {
    MixedMesh result;
    report(options.sweep.progress, "edges", 0);
    const std::vector<int>& numbers = intervals.numbers.edges;
    std::vector<std::vector<double>> parameters = submap_parameters(b, intervals);
    parameters.resize(b.edge_count());
    if (options.sweep.follow_ribs) {
        std::vector<std::vector<double>> ribs = rib_parameters(b, sweeps, numbers);
        for (std::size_t e = 0; e < ribs.size(); ++e) {
            if (parameters[e].empty()) {
                parameters[e] = std::move(ribs[e]);
            }
        }
    }
    const std::size_t kept = given.nodes.size();
    BoundaryMesh mesh = mesh_edges(b, numbers, parameters, std::move(given));
    std::vector<bool> is_given;
    for (const FaceMesh& face : mesh.faces) {
        is_given.push_back(!face.empty());
    }
    report(options.sweep.progress, "faces", 0.05);
    const std::vector<std::optional<SubmapFace>> faces =
        mesh_submap_faces(b, mesh, submaps, intervals.numbers, options.submap.smooth);
    detail::mesh_linking_sides(b, mesh, sweeps, options.sweep.solid.smooth, result);
    const std::vector<SolidMesh> swept = detail::mesh_sweeps(b, mesh, sweeps, numbers, mesher, options.sweep, result);
    std::vector<SubmapSolid> submapped;
    for (const SubmapTopology& topology : submaps.solids) {
        submapped.push_back(submap_solid(b, mesh, submaps, topology, intervals.numbers, faces, options.submap));
    }
    detail::Renumbering number(mesh, result.mesh.nodes, kept);
    detail::append_sweeps(result, swept, number);
    for (std::size_t s = 0; s < submapped.size(); ++s) {
        detail::append_submap(result, submaps.solids[s], submapped[s], number, result.submapped);
    }
    detail::append_faces(result, mesh, number, [&](FaceId f) { return is_given[f.index()]; });
    report(options.sweep.progress, "done", 1);
    return result;
}

}  // namespace pavior
