#pragma once

#include <pavior/core/error.hpp>
#include <pavior/one_to_one/sweep_model.hpp>
#include <pavior/part/mixed_model.hpp>
#include <pavior/submap/submap_model.hpp>

#include <cstddef>
#include <optional>
#include <string>
#include <utility>

namespace pavior {

PAVIOR_INLINE std::map<int, int> given_intervals(const AnyModel& b, const BoundaryMesh& given) {
    std::map<int, int> result;
    for (std::size_t e = 0; e < given.edges.size(); ++e) {
        if (!given.edges[e].nodes.empty()) {
            result.emplace(b.tag(1, e), static_cast<int>(given.edges[e].nodes.size()) - 1);
        }
    }
    return result;
}

PAVIOR_INLINE MixedMesh mixed_model(const AnyModel& b, std::span<const SweepTopology> sweeps,
                                    const SubmapModel& submaps, const SubmapIntervals& intervals,
                                    const CapMesher& mesher, BoundaryMesh given, const MixedModelOptions& options) {
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
