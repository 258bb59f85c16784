#pragma once
/// \file
/// The boundary-representation concept: topology and evaluation of a CAD model, whoever stores it.

#include <pavior/core/index.hpp>
#include <pavior/math/point.hpp>

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace pavior {

using VertexId = Id<struct BrepVertexTag>;
using EdgeId = Id<struct BrepEdgeTag>;
using FaceId = Id<struct BrepFaceTag>;
using SolidId = Id<struct BrepSolidTag>;

/// An edge run along (+) or against (-) its own parameter.
struct OrientedEdge {
    EdgeId edge;
    bool forward = true;

    friend constexpr auto operator<=>(const OrientedEdge&, const OrientedEdge&) = default;
};

/// A face as a solid sees it: outward is true where the face's own normal (d/du x d/dv) leaves the solid.
struct OrientedFace {
    FaceId face;
    bool outward = true;

    friend constexpr auto operator<=>(const OrientedFace&, const OrientedFace&) = default;
};

/// Closed boundary of a face: edges head to tail, the material of the face on the left when seen from the tip of the
/// face's own normal. A seam edge of a periodic face appears twice in one loop, once in each sense.
using EdgeLoop = std::vector<OrientedEdge>;

/// B is a brep if, for a const B& b (ids are dense, 0-based, valid for this b only):
/// 1. b.vertex_count(), b.edge_count(), b.face_count(), b.solid_count() give the number of entities;
/// 2. b.solid_faces(s) is a span of OrientedFace, b.face_loops(f) a span of EdgeLoop (outer loop first for a plane);
/// 3. b.edge_vertices(e) is {first, last}, equal for a closed edge;
/// 4. b.vertex_point(v) is a Vec3; b.edge_range(e) is {first, last} parameter, b.edge_point(e, t) a Vec3,
///    b.edge_derivative(e, t) the Vec3 d/dt, b.edge_length(e) its arc length;
/// 5. b.face_point(f, uv) is a Vec3, b.face_derivatives(f, uv) the pair {d/du, d/dv};
/// 6. b.closest_on_face(f, x) is the Vec2 uv of a point of the surface of f next to x;
/// 7. b.edge_on_face(e, t, f, forward) is the Vec2 uv on f of the point t of e; on a seam, `forward` picks the side on
///    which the loop of f runs along (true) or against (false) the edge;
/// 8. b.face_period(f) is {pu, pv}, 0 where the surface is not periodic;
/// 9. b.tag(dim, index) is the number by which users of the CAD file know the entity (dim 0 vertex .. 3 solid);
/// 10. (not checkable) faces of one solid are glued by sharing edges, edges by sharing vertices; all calls are const
///    and
///    deterministic; thread-safety is the model's own matter and assumed absent.
template <class B>
concept brep = requires(const B& b, VertexId v, EdgeId e, FaceId f, SolidId s, double t, Vec2 uv, Vec3 x) {
    { b.vertex_count() } -> std::convertible_to<std::size_t>;
    { b.edge_count() } -> std::convertible_to<std::size_t>;
    { b.face_count() } -> std::convertible_to<std::size_t>;
    { b.solid_count() } -> std::convertible_to<std::size_t>;
    { b.solid_faces(s) } -> std::convertible_to<std::span<const OrientedFace>>;
    { b.face_loops(f) } -> std::convertible_to<std::span<const EdgeLoop>>;
    { b.edge_vertices(e) } -> std::convertible_to<std::array<VertexId, 2>>;
    { b.vertex_point(v) } -> std::convertible_to<Vec3>;
    { b.edge_range(e) } -> std::convertible_to<std::array<double, 2>>;
    { b.edge_point(e, t) } -> std::convertible_to<Vec3>;
    { b.edge_derivative(e, t) } -> std::convertible_to<Vec3>;
    { b.edge_length(e) } -> std::convertible_to<double>;
    { b.face_point(f, uv) } -> std::convertible_to<Vec3>;
    { b.face_derivatives(f, uv) } -> std::convertible_to<std::pair<Vec3, Vec3>>;
    { b.closest_on_face(f, x) } -> std::convertible_to<Vec2>;
    { b.edge_on_face(e, t, f, true) } -> std::convertible_to<Vec2>;
    { b.face_period(f) } -> std::convertible_to<std::array<double, 2>>;
    { b.tag(2, f.index()) } -> std::convertible_to<int>;
};

/// All solids of a model.
template <brep B>
[[nodiscard]] std::vector<SolidId> all_solids(const B& b) {
    std::vector<SolidId> solids;
    for (std::int32_t s = 0; s < static_cast<std::int32_t>(b.solid_count()); ++s) {
        solids.push_back(SolidId{s});
    }
    return solids;
}

}  // namespace pavior
