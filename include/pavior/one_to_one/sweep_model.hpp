#pragma once
/// \file
/// Sweeps all solids of a CAD model into one conforming hexahedral mesh.

#include <pavior/brep/solids_mesh.hpp>
#include <pavior/core/compiled.hpp>
#include <pavior/core/progress.hpp>
#include <pavior/one_to_one/cap_order.hpp>
#include <pavior/one_to_one/mesh_linking_side.hpp>
#include <pavior/one_to_one/rib_parameters.hpp>
#include <pavior/one_to_one/structure_side.hpp>
#include <pavior/one_to_one/sweep_solid.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace pavior {

struct ModelSweepOptions {
    SolidSweepOptions solid;
    /// Ribs follow each other where equal spacing would fold a linking side (rib_parameters()).
    bool follow_ribs = true;
    Progress progress = {};
};

/// What became of one solid.
struct SolidReport {
    SolidId solid;
    FaceId source, target;  ///< as swept: the source is where the quads come from
    std::size_t first_hex = 0, hex_count = 0;
    std::size_t layers = 0;
    SweepReport sweep;
    std::optional<TargetReport> target_projection;
    SmoothReport smooth;
};

/// Hexahedra of a model with their entities. Nodes of the first solid come level by level in the order of its source;
/// those of each further solid follow in the same way, as far as they are new. Hexahedra come solid by solid, layer by
/// layer, in the order of the quads of the source; quads face by face.
struct ModelMesh : SolidsMesh {
    std::vector<SolidReport> solids;       ///< in the order of meshing
    std::vector<LinkingFaceReport> sides;  ///< linking sides
};

namespace detail {

/// Meshes the linking sides of all sweeps, each face once; those meshed already are put in rows and columns.
template <brep B>
void mesh_linking_sides(const B& b, BoundaryMesh& mesh, std::span<const SweepTopology> sweeps, bool smooth,
                        ModelMesh& result) {
    for (const SweepTopology& sweep : sweeps) {
        for (const std::vector<LinkingSide>& loop : sweep.loops) {
            for (const LinkingSide& side : loop) {
                const FaceMesh& face = mesh.faces[side.face.index()];
                if (face.empty()) {
                    result.sides.push_back(mesh_linking_side(b, mesh, side, smooth));
                } else if (side.rectangle() && !face.structured()) {
                    (void)structure_side(mesh, side, b.face_period(side.face));  // side_ids() complains
                }
            }
        }
    }
}

/// Meshes the caps and the inside of all sweeps, shared caps once. Edges and linking sides must be meshed.
template <brep B, class M>
[[nodiscard]] std::vector<SolidMesh> mesh_sweeps(const B& b, BoundaryMesh& mesh, std::span<const SweepTopology> sweeps,
                                                 std::span<const int> intervals, M&& mesher,
                                                 const ModelSweepOptions& options, ModelMesh& result) {
    const auto meshed = [&](FaceId f) { return !mesh.faces[f.index()].empty(); };
    const std::vector<SweepStep> steps = cap_order(sweeps, meshed);
    std::vector<SolidMesh> solids;
    for (std::size_t i = 0; i < steps.size(); ++i) {
        const double done = 0.2 + 0.8 * static_cast<double>(i) / static_cast<double>(steps.size());
        const SweepTopology& given = sweeps[steps[i].sweep];
        const SweepTopology sweep = steps[i].backwards ? reversed(given) : given;
        if (!meshed(sweep.source)) {
            report(options.progress, "caps", done);
            mesh_cap_face(b, mesh, sweep.source, mesher);
        }
        report(options.progress, "layers", done);
        SolidMesh solid = sweep_solid(b, mesh, sweep, intervals, options.solid);
        result.solids.push_back({sweep.solid, sweep.source, sweep.target, 0, solid.layers * solid.quads.size(),
                                 solid.layers, solid.sweep, solid.target, solid.smooth});
        solids.push_back(std::move(solid));
    }
    return solids;
}

/// Appends the hexahedra of all sweeps in the order of meshing.
PAVIOR_INLINE void append_sweeps(ModelMesh& result, std::span<const SolidMesh> solids, Renumbering& number);

}  // namespace detail

/// Meshes the solids of \p sweeps (one topology a solid, see recognition.hpp) with the numbers of \p intervals (by edge
/// id, see intervals.hpp): edges, linking sides, caps in an order that meshes shared faces once, levels. Entities own
/// their nodes, so the result conforms across shared faces. \p mesher makes the quads of the free caps.
/// The result is not verified; use verify_hexes(). Deterministic if the model and the mesher are.
/// \throws UnmeshableError naming faces where neighbours need different meshes on a shared face; what \p mesher throws;
/// InputError where a boundary admits no sweep (see verify_problem())
template <brep B, cap_mesher M>
[[nodiscard]] ModelMesh sweep_model(const B& b, std::span<const SweepTopology> sweeps, std::span<const int> intervals,
                                    M&& mesher, const ModelSweepOptions& options = {}) {
    ModelMesh result;
    report(options.progress, "edges", 0);
    std::vector<std::vector<double>> parameters;
    if (options.follow_ribs) {
        parameters = rib_parameters(b, sweeps, intervals);
    }
    BoundaryMesh mesh = mesh_edges(b, intervals, parameters);
    report(options.progress, "linking sides", 0.05);
    detail::mesh_linking_sides(b, mesh, sweeps, options.solid.smooth, result);
    const std::vector<SolidMesh> solids = detail::mesh_sweeps(b, mesh, sweeps, intervals, mesher, options, result);
    detail::Renumbering number(mesh, result.mesh.nodes);
    detail::append_sweeps(result, solids, number);
    detail::append_faces(result, mesh, number, [](FaceId) { return false; });
    report(options.progress, "done", 1);
    return result;
}

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/one_to_one/sweep_model-inl.hpp>
#endif
