#pragma once
/// \file
/// CAD models seen in coordinates that follow a path.

#include <pavior/brep/all_tags.hpp>
#include <pavior/brep/edge_mesh.hpp>
#include <pavior/many_to_many/extrusion.hpp>

#include <array>
#include <concepts>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace pavior {

/// Coordinates in which what was swept along a path is straight: m.unrolled(p) are those of the point p of space,
/// m.rolled(q) is the point of coordinates q, m.unrolled(p, d) the image of the direction d at p (the derivative).
template <class M>
concept path_coordinates = requires(const M& m, const Vec3& p) {
    { m.unrolled(p) } -> std::convertible_to<Vec3>;
    { m.rolled(p) } -> std::convertible_to<Vec3>;
    { m.unrolled(p, p) } -> std::convertible_to<Vec3>;
};

/// A model as it looks in other coordinates; a view, models brep. Topology and parameters stay. closest_on_face() is
/// the point closest in space. Lengths of edges are those in the coordinates, which must be one to one on the solids
/// that are asked about.
template <brep B, path_coordinates M>
class UnrolledBrep {
public:
    /// Keeps references.
    UnrolledBrep(const B& b, const M& map) : b_(b), map_(map) {}

    [[nodiscard]] std::size_t vertex_count() const { return b_.vertex_count(); }
    [[nodiscard]] std::size_t edge_count() const { return b_.edge_count(); }
    [[nodiscard]] std::size_t face_count() const { return b_.face_count(); }
    [[nodiscard]] std::size_t solid_count() const { return b_.solid_count(); }
    [[nodiscard]] std::span<const OrientedFace> solid_faces(SolidId s) const { return b_.solid_faces(s); }
    [[nodiscard]] std::span<const EdgeLoop> face_loops(FaceId f) const { return b_.face_loops(f); }
    [[nodiscard]] std::array<VertexId, 2> edge_vertices(EdgeId e) const { return b_.edge_vertices(e); }
    [[nodiscard]] Vec3 vertex_point(VertexId v) const { return map_.unrolled(b_.vertex_point(v)); }
    [[nodiscard]] std::array<double, 2> edge_range(EdgeId e) const { return b_.edge_range(e); }
    [[nodiscard]] Vec3 edge_point(EdgeId e, double t) const { return map_.unrolled(b_.edge_point(e, t)); }
    [[nodiscard]] Vec3 edge_derivative(EdgeId e, double t) const {
        return map_.unrolled(b_.edge_point(e, t), b_.edge_derivative(e, t));
    }
    [[nodiscard]] double edge_length(EdgeId e) const { return detail::arc_length(*this, e, 32).length.back(); }
    [[nodiscard]] Vec3 face_point(FaceId f, const Vec2& uv) const { return map_.unrolled(b_.face_point(f, uv)); }
    [[nodiscard]] std::pair<Vec3, Vec3> face_derivatives(FaceId f, const Vec2& uv) const {
        const Vec3 x = b_.face_point(f, uv);
        const auto [du, dv] = b_.face_derivatives(f, uv);
        return {map_.unrolled(x, du), map_.unrolled(x, dv)};
    }
    [[nodiscard]] Vec2 closest_on_face(FaceId f, const Vec3& x) const { return b_.closest_on_face(f, map_.rolled(x)); }
    [[nodiscard]] Vec2 edge_on_face(EdgeId e, double t, FaceId f, bool forward) const {
        return b_.edge_on_face(e, t, f, forward);
    }
    [[nodiscard]] std::array<double, 2> face_period(FaceId f) const { return b_.face_period(f); }
    [[nodiscard]] int tag(int dim, std::size_t index) const { return b_.tag(dim, index); }
    [[nodiscard]] std::vector<int> all_tags(int dim, std::size_t index) const {
        return pavior::all_tags(b_, dim, index);
    }

private:
    const B& b_;
    const M& map_;
};

namespace detail {

/// Calls visit(p) with points of the boundary of \p solids: 129 of each edge a face, and some of each face.
template <brep B, class Visit>
void for_each_boundary_point(const B& b, std::span<const SolidId> solids, Visit&& visit) {
    constexpr int per_edge = 128;
    for (const FaceId f : faces_of(b, solids)) {
        for (const Vec2& uv : face_samples(b, f)) {
            visit(b.face_point(f, uv));
        }
        for (const EdgeLoop& loop : b.face_loops(f)) {
            for (const OrientedEdge& use : loop) {
                const auto range = b.edge_range(use.edge);
                for (int i = 0; i <= per_edge; ++i) {
                    visit(b.edge_point(use.edge, range[0] + (range[1] - range[0]) * i / per_edge));
                }
            }
        }
    }
}

}  // namespace detail

}  // namespace pavior
