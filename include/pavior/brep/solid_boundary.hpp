#pragma once
/// \file
/// The boundary of one solid as half-edges seen from outside: faces, loops, twins and corner angles.

#include <pavior/brep/face_corners.hpp>
#include <pavior/core/compiled.hpp>
#include <pavior/core/error.hpp>

#include <algorithm>
#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace pavior {

/// The boundary of a solid in arrays, independent of the model it was read from.
///
/// A half-edge is an edge as one face uses it, in the sense of the face's loop seen from outside the solid
/// (counter-clockwise). Edges without length (poles, tips) are left out. Each other edge has exactly two half-edges, of
/// opposite senses; those of a seam belong to one face.
/// Half-edges of a loop are consecutive; faces are in the order of the model's solid_faces.
struct SolidBoundary {
    struct HalfEdge {
        OrientedEdge use;
        VertexId start;
        std::size_t face = 0;  ///< position in `faces`
        std::size_t loop = 0;  ///< position among the loops of the face
        std::size_t next = 0;  ///< following half-edge of the loop
        std::size_t twin = 0;  ///< the other half-edge of the edge
        double angle = 0.0;    ///< interior angle of the face at `start`, degrees
    };
    struct Face {
        OrientedFace face;
        int tag = 0;                     ///< the number by which users know the face
        std::vector<std::size_t> loops;  ///< first half-edge of each loop
        std::size_t begin = 0, end = 0;  ///< its half-edges are [begin, end)
        bool seam = false;               ///< an edge occurs twice
    };

    SolidId solid;
    int tag = 0;
    std::vector<Face> faces;
    std::vector<HalfEdge> half_edges;

    /// The half-edges of a loop from \p first on.
    [[nodiscard]] std::vector<std::size_t> loop_from(std::size_t first) const;

    [[nodiscard]] std::size_t twin_face(std::size_t half_edge) const {
        return half_edges[half_edges[half_edge].twin].face;
    }
};

namespace detail {

/// The edges of \p solid of no length (poles of spheres, tips of cones), which bound nothing.
template <brep B>
[[nodiscard]] std::set<EdgeId> degenerate_edges(const B& b, SolidId solid) {
    std::map<EdgeId, double> lengths;
    double longest = 0.0;
    for (const OrientedFace& f : b.solid_faces(solid)) {
        for (const EdgeLoop& loop : b.face_loops(f.face)) {
            for (const OrientedEdge& use : loop) {
                const double length = lengths.emplace(use.edge, b.edge_length(use.edge)).first->second;
                longest = std::max(longest, length);
            }
        }
    }
    std::set<EdgeId> result;
    for (const auto& [edge, length] : lengths) {
        const auto ends = b.edge_vertices(edge);
        if (length <= 1e-10 * longest && ends[0] == ends[1]) {
            result.insert(edge);
        }
    }
    return result;
}

/// Appends one loop as seen from outside.
template <brep B>
void add_half_edges(const B& b, SolidBoundary& boundary, std::size_t face, const EdgeLoop& loop) {
    const OrientedFace f = boundary.faces[face].face;
    const std::size_t first = boundary.half_edges.size();
    const std::size_t n = loop.size();
    const auto use = [&](std::size_t i) {
        const OrientedEdge own = f.outward ? loop[i % n] : loop[(2 * n - 1 - i) % n];
        return f.outward ? own : OrientedEdge{own.edge, !own.forward};
    };
    for (std::size_t i = 0; i < n; ++i) {
        SolidBoundary::HalfEdge h;
        h.use = use(i);
        h.start = b.edge_vertices(h.use.edge)[h.use.forward ? 0 : 1];
        h.face = face;
        h.loop = boundary.faces[face].loops.size();
        h.next = first + (i + 1) % n;
        h.angle = corner_angle(b, f, use(i + n - 1), h.use);
        boundary.half_edges.push_back(h);
    }
    boundary.faces[face].loops.push_back(first);
}

/// Pairs the half-edges of each edge. \throws InputError non_manifold
template <brep B>
void pair_half_edges(const B& b, SolidBoundary& boundary) {
    std::map<EdgeId, std::vector<std::size_t>> uses;
    for (std::size_t h = 0; h < boundary.half_edges.size(); ++h) {
        uses[boundary.half_edges[h].use.edge].push_back(h);
    }
    for (const auto& [edge, both] : uses) {
        if (both.size() != 2 || boundary.half_edges[both[0]].use.forward == boundary.half_edges[both[1]].use.forward) {
            const int tag = b.tag(1, edge.index());
            throw InputError(ErrorCode::non_manifold,
                             "solid " + std::to_string(boundary.tag) + " is not closed: its faces do not use edge " +
                                 std::to_string(tag) + " exactly twice, once in each sense",
                             {tag});
        }
        boundary.half_edges[both[0]].twin = both[1];
        boundary.half_edges[both[1]].twin = both[0];
        if (boundary.half_edges[both[0]].face == boundary.half_edges[both[1]].face) {
            boundary.faces[boundary.half_edges[both[0]].face].seam = true;
        }
    }
}

}  // namespace detail

/// Reads the boundary of \p solid. O(n log n) for n edges, plus a few evaluations of the model per corner.
/// \throws InputError non_manifold, with the user's tag of an edge, if the faces do not close the solid.
template <brep B>
[[nodiscard]] SolidBoundary solid_boundary(const B& b, SolidId solid) {
    SolidBoundary boundary;
    boundary.solid = solid;
    boundary.tag = b.tag(3, solid.index());
    const std::set<EdgeId> degenerate = detail::degenerate_edges(b, solid);
    for (const OrientedFace& f : b.solid_faces(solid)) {
        const std::size_t face = boundary.faces.size();
        boundary.faces.emplace_back();
        boundary.faces[face].face = f;
        boundary.faces[face].tag = b.tag(2, f.face.index());
        boundary.faces[face].begin = boundary.half_edges.size();
        for (EdgeLoop loop : b.face_loops(f.face)) {
            std::erase_if(loop, [&](const OrientedEdge& use) { return degenerate.contains(use.edge); });
            if (!loop.empty()) {
                detail::add_half_edges(b, boundary, face, loop);
            }
        }
        boundary.faces[face].end = boundary.half_edges.size();
    }
    detail::pair_half_edges(b, boundary);
    return boundary;
}

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/brep/solid_boundary-inl.hpp>
#endif
