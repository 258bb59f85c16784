#pragma once
/// \file
/// The boundary nodes of a cap, and the cap meshes made from them.

#include <pavior/brep/boundary_mesh.hpp>
#include <pavior/brep/seamless.hpp>
#include <pavior/core/compiled.hpp>
#include <pavior/core/error.hpp>
#include <pavior/one_to_one/cap_plane.hpp>
#include <pavior/sweep/unwrap.hpp>

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace pavior {

/// Boundary nodes of a face, loop by loop in the order and sense of its own loops, one entry a node.
struct CapBoundary {
    std::vector<std::size_t> offsets{0};  ///< loop l is [offsets[l], offsets[l + 1])
    std::vector<Index> ids;               ///< node ids of the BoundaryMesh
    std::vector<Vec3> points;
    std::vector<Vec2> uv;  ///< continuous along each loop; holes on the same sheet as the outer loop
    /// Of a face with a seam and a cap_plane(): `uv` are coordinates in that, the seam is left out, and the outer loop
    /// comes first. A seam of any other face is part of its loop, run twice.
    std::optional<CapPlane> plane = {};
};

/// All-quad mesh of a cap: nodes 0 .. m-1 are the m boundary nodes in the order given, inner nodes follow. Quads are
/// counter-clockwise about the face's own normal.
struct CapMesh {
    std::vector<Vec3> nodes;
    std::vector<Vec2> uv;  ///< parameters on the face, one a node; not continuous on a face with a seam
    std::vector<QuadCorners> quads;
};

/// M makes cap meshes: m(face, boundary) returns a CapMesh, or throws an Error that names the face.
template <class M>
concept cap_mesher = requires(M&& m, FaceId face, const CapBoundary& boundary) {
    { m(face, boundary) } -> std::convertible_to<CapMesh>;
};

/// Any cap_mesher that can be copied, behind one type; std::ref() of one that cannot.
using CapMesher = std::function<CapMesh(FaceId face, const CapBoundary& boundary)>;

namespace detail {

/// Twice the area that a loop encloses.
[[nodiscard]] PAVIOR_INLINE double twice_area(std::span<const Vec2> loop);

/// cap_boundary() of a face with a seam, by its cap_plane().
template <brep B>
[[nodiscard]] CapBoundary seamless_boundary(const B& b, const BoundaryMesh& mesh, FaceId face, const CapPlane& plane) {
    CapBoundary result;
    result.plane = plane;
    std::vector<std::vector<Index>> loops;
    for (const EdgeLoop& loop : seamless_loops(b.face_loops(face))) {
        loops.push_back(chain_nodes(b, mesh, loop, face, true).nodes);
        loops.back().pop_back();  // the first node again
    }
    const auto area = [&](const std::vector<Index>& ids) {
        std::vector<Vec2> loop;
        for (const Index id : ids) {
            loop.push_back(plane.coordinates(mesh.nodes[id]));
        }
        return twice_area(loop);
    };
    std::stable_sort(loops.begin(), loops.end(), [&](const auto& l, const auto& r) { return area(l) > area(r); });
    for (const std::vector<Index>& loop : loops) {
        for (const Index id : loop) {
            result.ids.push_back(id);
            result.points.push_back(mesh.nodes[id]);
            result.uv.push_back(plane.coordinates(mesh.nodes[id]));
        }
        result.offsets.push_back(result.ids.size());
    }
    return result;
}

}  // namespace detail

/// Collects the boundary of \p face, whose edges must be meshed. O(boundary nodes).
template <brep B>
[[nodiscard]] CapBoundary cap_boundary(const B& b, const BoundaryMesh& mesh, FaceId face) {
    if (has_seam(b, face)) {
        if (const std::optional<CapPlane> plane = cap_plane(b, face)) {
            return detail::seamless_boundary(b, mesh, face, *plane);
        }
    }
    CapBoundary result;
    const Periods periods = b.face_period(face);
    for (const EdgeLoop& loop : b.face_loops(face)) {
        ChainNodes chain = chain_nodes(b, mesh, loop, face, true);
        unwrap_chain(chain.uv, periods);
        chain.nodes.pop_back();  // the first node again
        chain.uv.pop_back();
        if (result.offsets.size() > 1) {
            const auto outer = std::span(result.uv).first(result.offsets[1]);
            const Vec2 shift = inside_shift(chain.uv.front(), outer, periods);
            for (Vec2& uv : chain.uv) {
                uv += shift;
            }
        }
        for (std::size_t i = 0; i < chain.nodes.size(); ++i) {
            result.ids.push_back(chain.nodes[i]);
            result.points.push_back(mesh.nodes[chain.nodes[i]]);
            result.uv.push_back(chain.uv[i]);
        }
        result.offsets.push_back(result.ids.size());
    }
    return result;
}

/// Meshes \p face with \p mesher between the nodes of its edges and stores it in mesh.faces[face].
template <brep B, cap_mesher M>
void mesh_cap_face(const B& b, BoundaryMesh& mesh, FaceId face, M&& mesher) {
    const CapBoundary boundary = cap_boundary(b, mesh, face);
    const CapMesh cap = mesher(face, boundary);
    PAVIOR_ASSERT(cap.nodes.size() >= boundary.ids.size() && cap.uv.size() == cap.nodes.size());
    FaceMesh& result = mesh.faces[face.index()];
    result.nodes = boundary.ids;
    for (std::size_t i = boundary.ids.size(); i < cap.nodes.size(); ++i) {
        result.nodes.push_back(mesh.add_node(cap.nodes[i]));
    }
    result.uv = cap.uv;
    result.quads = cap.quads;
}

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/one_to_one/cap_boundary-inl.hpp>
#endif
