#pragma once
/// \file
/// Which entities of a model bound which, and where the quads of its faces meet.

#include <pavior/brep/brep.hpp>
#include <pavior/core/compiled.hpp>
#include <pavior/math/box.hpp>
#include <pavior/mesh/cells.hpp>
#include <pavior/mesh/edge_table.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace pavior::detail {

/// Which entities bound which, ids sorted. Closed edges of no length (poles) are left out.
struct Incidences {
    std::vector<std::vector<VertexId>> face_vertices;
    std::vector<std::vector<EdgeId>> face_edges, face_seams, vertex_edges;
    std::vector<std::vector<FaceId>> edge_faces, vertex_faces;

    /// Edges of the faces of \p set (sorted): those that all of them share, else all but seams.
    [[nodiscard]] std::vector<EdgeId> edges_between(std::span<const FaceId> set) const;
    /// Vertices that belong to all faces of \p set (sorted, not empty).
    [[nodiscard]] std::vector<VertexId> vertices_between(std::span<const FaceId> set) const;
    /// Only seams meet there.
    [[nodiscard]] bool pole(VertexId v) const;
    [[nodiscard]] bool seam(EdgeId e) const;
};

template <brep B>
[[nodiscard]] Incidences incidences(const B& b) {
    Incidences result;
    result.vertex_edges.resize(b.vertex_count());
    result.vertex_faces.resize(b.vertex_count());
    result.edge_faces.resize(b.edge_count());
    std::vector<double> length;
    for (std::size_t e = 0; e < b.edge_count(); ++e) {
        length.push_back(b.edge_length(EdgeId{static_cast<std::int32_t>(e)}));
    }
    const double longest = length.empty() ? 0.0 : *std::max_element(length.begin(), length.end());
    const auto add = [](auto& sorted, auto id) {
        const auto at = std::lower_bound(sorted.begin(), sorted.end(), id);
        const bool fresh = at == sorted.end() || *at != id;
        if (fresh) {
            sorted.insert(at, id);
        }
        return fresh;
    };
    for (std::size_t i = 0; i < b.face_count(); ++i) {
        const FaceId f{static_cast<std::int32_t>(i)};
        auto& vertices = result.face_vertices.emplace_back();
        auto& edges = result.face_edges.emplace_back();
        auto& seams = result.face_seams.emplace_back();
        for (const EdgeLoop& loop : b.face_loops(f)) {
            for (const OrientedEdge& use : loop) {
                const std::array<VertexId, 2> ends = b.edge_vertices(use.edge);
                if (ends[0] == ends[1] && length[use.edge.index()] <= 1e-10 * longest) {
                    continue;
                }
                if (!add(edges, use.edge)) {
                    add(seams, use.edge);
                }
                add(result.edge_faces[use.edge.index()], f);
                for (const VertexId v : ends) {
                    add(vertices, v);
                    add(result.vertex_faces[v.index()], f);
                    add(result.vertex_edges[v.index()], use.edge);
                }
            }
        }
    }
    return result;
}

/// Where quads of different faces meet.
struct QuadSkeleton {
    EdgeTable edges;
    std::vector<std::pair<Index, FaceId>> node_faces;  ///< sorted, each pair once
    /// Sorted faces that meet in mesh edges: of two faces or more, or of one that ends there. Each set once.
    std::vector<std::vector<FaceId>> sets;
    std::vector<std::pair<Index, Index>> node_sets;  ///< (node, set) once for each such mesh edge of the node; sorted
    std::vector<double> shortest;                    ///< length of the shortest mesh edge of each node
};

[[nodiscard]] PAVIOR_INLINE QuadSkeleton quad_skeleton(std::span<const Vec3> nodes, std::span<const QuadCorners> quads,
                                                       std::span<const FaceId> faces);

/// The middle of the parameters of \p f in its periodic directions: half-way between the two sides of a seam, else of
/// the box round the outer loop.
template <brep B>
[[nodiscard]] Vec2 middle_parameters(const B& b, FaceId f, std::span<const EdgeId> seams) {
    const std::array<double, 2> period = b.face_period(f);
    Box<Vec2> box;
    Vec2 last = Vec2::Zero();
    const std::span<const EdgeLoop> loops = b.face_loops(f);
    for (const OrientedEdge& use : loops.empty() ? EdgeLoop{} : loops[0]) {
        const std::array<double, 2> range = b.edge_range(use.edge);
        for (int i = 0; i <= 8; ++i) {
            const double part = (use.forward ? i : 8 - i) / 8.0;
            Vec2 uv = b.edge_on_face(use.edge, range[0] + part * (range[1] - range[0]), f, use.forward);
            for (Eigen::Index k = 0; k < 2 && !box.empty(); ++k) {
                const double p = period[static_cast<std::size_t>(k)];
                uv[k] -= p > 0 ? p * std::round((uv[k] - last[k]) / p) : 0.0;
            }
            box.add(uv);
            last = uv;
        }
    }
    Vec2 middle = !box.empty() ? Vec2(0.5 * (box.low + box.high)) : Vec2(0.5 * period[0], 0.5 * period[1]);
    for (const EdgeId e : seams) {
        const std::array<double, 2> range = b.edge_range(e);
        const Vec2 one = b.edge_on_face(e, 0.5 * (range[0] + range[1]), f, true);
        const Vec2 other = b.edge_on_face(e, 0.5 * (range[0] + range[1]), f, false);
        for (Eigen::Index k = 0; k < 2; ++k) {
            if (std::abs(one[k] - other[k]) > 0.5 * period[static_cast<std::size_t>(k)] &&
                period[static_cast<std::size_t>(k)] > 0) {
                middle[k] = 0.5 * (one[k] + other[k]);
            }
        }
    }
    return middle;
}

}  // namespace pavior::detail

#ifndef PAVIOR_COMPILED
#include <pavior/brep/detail/entity_incidences-inl.hpp>
#endif
