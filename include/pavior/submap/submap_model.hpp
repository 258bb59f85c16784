#pragma once
/// \file
/// Submaps solids of a CAD model into one conforming structured hexahedral mesh.

#include <pavior/brep/match_quads.hpp>
#include <pavior/brep/solids_mesh.hpp>
#include <pavior/core/compiled.hpp>
#include <pavior/core/progress.hpp>
#include <pavior/submap/submap_intervals.hpp>
#include <pavior/submap/submap_recognition.hpp>
#include <pavior/submap/submap_solid.hpp>

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace pavior {

struct ModelSubmapOptions {
    SolidSubmapOptions solid;
    Progress progress = {};
};

/// What became of one submapped solid.
struct SubmapSolidReport {
    SolidId solid;
    std::size_t first_hex = 0, hex_count = 0;
    LatticePoint<3> low{}, high{};  ///< box of the lattice
    double deviation = 0.0;         ///< largest difference of an angle from its class, degrees
    SmoothReport smooth;
};

/// What became of one submapped face.
struct SubmapFaceReport {
    FaceId face;
    std::size_t folded_harmonic = 0;  ///< quads folded before repair
    std::vector<Index> folded;        ///< quads (in the order of the face) still folded
};

/// Hexahedra of a model with their entities. Nodes of the first solid come in the order of its lattice (i fastest),
/// those of each further solid follow in the same way, as far as they are new. Hexahedra come solid by solid in the
/// order of the lattice, quads face by face.
struct SubmappedMesh : SolidsMesh {
    std::vector<LatticePoint<3>> hex_lattice;  ///< one a hexahedron: its smallest (i, j, k) in its solid
    std::vector<SubmapSolidReport> solids;     ///< in the order of SubmapModel::solids
    std::vector<SubmapFaceReport> faces;       ///< by face id

    /// The smallest determinant of unit edge vectors at a corner or of unit axes at a centre, as in SmoothReport.
    [[nodiscard]] double min_scaled_jacobian() const;
};

/// Parameters of the nodes of all edges for mesh_edges(); empty where equal spacing is as good.
template <brep B>
[[nodiscard]] std::vector<std::vector<double>> submap_parameters(const B& b, const SubmapIntervals& intervals) {
    std::vector<std::vector<double>> result(intervals.fractions.size());
    for (std::size_t e = 0; e < result.size(); ++e) {
        if (!intervals.fractions[e].empty()) {
            result[e] = edge_parameters(b, EdgeId{static_cast<std::int32_t>(e)}, intervals.fractions[e]);
        }
    }
    return result;
}

namespace detail {

/// Gives the nodes of \p given to the structured mesh of \p f, if the two are one mesh.
template <brep B>
void adopt_mesh(const B& b, BoundaryMesh& mesh, FaceId f, const FaceMesh& given) {
    FaceMesh& own = mesh.faces[f.index()];
    const PositionOf position(given.nodes);
    std::vector<std::pair<Index, Index>> seed;
    for (std::size_t i = 0; i < own.nodes.size(); ++i) {
        if (const Index at = position(own.nodes[i]); at != no_index) {
            seed.emplace_back(static_cast<Index>(i), at);
        }
    }
    const auto match = match_quads(own.quads, given.quads, own.nodes.size(), seed);
    if (!match) {
        const int tag = b.tag(2, f.index());
        throw UnmeshableError(
            ErrorCode::not_submappable,
            "face " + std::to_string(tag) + ": the quads that the solid on its other side has made are not structured",
            {tag});
    }
    for (std::size_t i = 0; i < own.nodes.size(); ++i) {
        own.nodes[i] = given.nodes[(*match)[i]];
        own.uv[i] = given.uv[(*match)[i]];
    }
}

}  // namespace detail

/// Meshes the faces of all solids of \p submaps, each once. The edges must be meshed. A face that is meshed already
/// keeps its nodes.
/// \return by face id; nothing for faces of no solid
/// \throws UnmeshableError not_submappable naming a face that is meshed already, but not with this structure
template <brep B>
[[nodiscard]] std::vector<std::optional<SubmapFace>> mesh_submap_faces(const B& b, BoundaryMesh& mesh,
                                                                       const SubmapModel& submaps,
                                                                       const SubmapNumbers& numbers, bool repair) {
    std::vector<std::optional<SubmapFace>> faces(submaps.faces.size());
    for (const SubmapTopology& solid : submaps.solids) {
        for (const LogicalSide& side : solid.sides) {
            const FaceId f = side.face.face;
            if (!faces[f.index()]) {
                const FaceMesh given = std::exchange(mesh.faces[f.index()], {});
                faces[f.index()] = mesh_submap_face(b, mesh, f, submaps.faces[f.index()], numbers, repair);
                if (!given.empty()) {
                    detail::adopt_mesh(b, mesh, f, given);
                }
            }
        }
    }
    return faces;
}

namespace detail {

/// Appends the hexahedra of one solid, nodes in the order of its lattice, and a report to \p reports.
PAVIOR_INLINE void append_submap(SolidsMesh& result, const SubmapTopology& topology, const SubmapSolid& solid,
                                 Renumbering& number, std::vector<SubmapSolidReport>& reports);

}  // namespace detail

/// Meshes the solids of \p submaps (recognise_submaps()) with the numbers of assign_submap_intervals(): edges, faces,
/// inner nodes. Entities own their nodes, so the result conforms across shared faces. The result is not verified; use
/// verify_hexes(). Deterministic if the model is.
/// \throws InputError infeasible_intervals if the numbers do not fit the solids
template <brep B>
[[nodiscard]] SubmappedMesh submap_model(const B& b, const SubmapModel& submaps, const SubmapIntervals& intervals,
                                         const ModelSubmapOptions& options = {}) {
    SubmappedMesh result;
    report(options.progress, "edges", 0);
    const SubmapNumbers& numbers = intervals.numbers;
    BoundaryMesh mesh = mesh_edges(b, numbers.edges, submap_parameters(b, intervals));
    report(options.progress, "faces", 0.05);
    const std::vector<std::optional<SubmapFace>> faces =
        mesh_submap_faces(b, mesh, submaps, numbers, options.solid.smooth);
    std::vector<SubmapSolid> solids;
    for (const SubmapTopology& topology : submaps.solids) {
        report(options.progress, "solids",
               0.3 + 0.7 * static_cast<double>(solids.size()) / static_cast<double>(submaps.solids.size()));
        solids.push_back(submap_solid(b, mesh, submaps, topology, numbers, faces, options.solid));
    }
    detail::Renumbering number(mesh, result.mesh.nodes);
    for (std::size_t s = 0; s < solids.size(); ++s) {
        detail::append_submap(result, submaps.solids[s], solids[s], number, result.solids);
        for (const HexCorners& hex : solids[s].hexes) {
            result.hex_lattice.push_back(solids[s].lattice[hex[0]]);
        }
    }
    for (std::size_t f = 0; f < faces.size(); ++f) {
        if (faces[f]) {
            result.faces.push_back({FaceId{static_cast<std::int32_t>(f)}, faces[f]->folded_harmonic, faces[f]->folded});
        }
    }
    detail::append_faces(result, mesh, number, [&](FaceId f) { return !faces[f.index()]; });
    report(options.progress, "done", 1);
    return result;
}

/// All steps in one: recognition, intervals, mesh. \p intervals.size must be given.
/// Where a scaled Jacobian stays below options.solid.sufficient_jacobian, vertices of different heights are put on
/// different layers (LevelOptions::distinct) and the best of up to three meshes is taken.
/// \throws UnmeshableError not_submappable or infeasible_intervals naming faces
template <brep B, integer_solver Solver>
[[nodiscard]] SubmappedMesh submap_model(const B& b, std::span<const SolidId> solids, const IntervalOptions& intervals,
                                         Solver&& solver, const SubmapOptions& shape = {},
                                         const ModelSubmapOptions& options = {}) {
    const SubmapModel submaps = recognise_submaps(b, solids, shape, solver);
    std::optional<SubmappedMesh> best;
    for (const double distinct : {no_bound, 0.3, 0.1}) {
        const SubmapIntervals numbers = assign_submap_intervals(b, {}, submaps, intervals, {true, distinct}, solver);
        SubmappedMesh mesh = submap_model(b, submaps, numbers, options);
        if (!best || mesh.min_scaled_jacobian() > best->min_scaled_jacobian()) {
            best = std::move(mesh);
        }
        if (best->min_scaled_jacobian() >= options.solid.sufficient_jacobian) {
            break;
        }
    }
    return std::move(*best);
}

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/submap/submap_model-inl.hpp>
#endif
