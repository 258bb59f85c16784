#pragma once
/// \file
/// The dual surfaces as polygons and the regions as polyhedra, to look at.

#include <pavior/contributions/regions.hpp>
#include <pavior/core/compiled.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace pavior {

/// Colours of section 5.7 \cite roca2009.
enum class DualColour : std::uint8_t {
    red,     ///< hard contribution of a face
    orange,  ///< hard, of an edge
    cyan,    ///< soft, of an edge
    yellow,  ///< hard, of a vertex
    blue,    ///< soft, of a vertex
};

/// Red, green and blue of \p colour, 0 to 1.
[[nodiscard]] constexpr std::array<double, 3> rgb(DualColour colour) {
    switch (colour) {
        case DualColour::red: return {0.85, 0.1, 0.1};
        case DualColour::orange: return {1.0, 0.55, 0.0};
        case DualColour::cyan: return {0.0, 0.8, 0.85};
        case DualColour::yellow: return {1.0, 0.9, 0.1};
        case DualColour::blue: break;
    }
    return {0.1, 0.25, 0.9};
}

/// The colour of a candidate of kind \p kind added as \p type (not none).
[[nodiscard]] constexpr DualColour dual_colour(CandidateKind kind, Contribution type) {
    if (kind == CandidateKind::face) {
        return DualColour::red;
    }
    const bool hard = type == Contribution::hard;
    return kind == CandidateKind::edge ? (hard ? DualColour::orange : DualColour::cyan)
                                       : (hard ? DualColour::yellow : DualColour::blue);
}

/// A colour for \p region: hues a golden section apart, so that numbers close to each other look different.
[[nodiscard]] PAVIOR_INLINE std::array<double, 3> region_rgb(Index region);

/// Cells over points: cell i has the points ids[begin[i]] .. ids[begin[i + 1] - 1].
struct PointCells {
    std::vector<Vec3> points;
    std::vector<Index> ids;
    std::vector<Index> begin{0};

    [[nodiscard]] std::size_t size() const { return begin.size() - 1; }
};

/// The local dual contributions as polygons of three or four points, in the order of tetrahedra and candidates.
struct DualSurfaces : PointCells {
    std::vector<DualColour> colour;  ///< one a polygon
    std::vector<Index> tet;          ///< tetrahedron of each polygon
};

/// The 15 pieces of all tetrahedra: four points are a tetrahedron, six a wedge, eight a hexahedron, numbered as in VTK
/// (VTK_TETRA, VTK_WEDGE, VTK_HEXAHEDRON). Faces are planar. In each tetrahedron: 4 pieces at nodes, 6 along edges,
/// 4 at faces, 1 inside.
struct RegionPolyhedra : PointCells {
    std::vector<Index> region;            ///< region of each piece
    std::vector<std::uint8_t> dimension;  ///< Regions::dimension() of it
};

namespace detail {

/// Global ids of the points: nodes, then 2 on each edge, 3 on each face, 4 in each tetrahedron.
class DualPoints {
public:
    explicit DualPoints(const TetTopology& topology);

    [[nodiscard]] std::size_t size() const { return end_; }
    /// Id of local point \p point of tetrahedron \p t with corners \p c.
    [[nodiscard]] Index id(const TetCorners& c, Index t, std::size_t point) const;

    /// Coordinates of all points, for planes at barycentric distance mu.
    template <tet_mesh M>
    [[nodiscard]] std::vector<Vec3> coordinates(const M& mesh, double mu) const {
        std::vector<Vec3> x;
        x.reserve(end_);
        for (const Index i : IndexRange(topology_.node_count())) {
            x.push_back(node(mesh, i));
        }
        const auto add = [&](const auto& nodes) {
            Vec3 sum = Vec3::Zero();
            for (const Index i : nodes) {
                sum += x[i];
            }
            for (const Index i : nodes) {
                x.push_back(mu * sum + (1.0 - mu * static_cast<double>(nodes.size())) * x[i]);
            }
        };
        std::for_each(topology_.edges.begin(), topology_.edges.end(), add);
        std::for_each(topology_.faces.begin(), topology_.faces.end(), add);
        for (const Index t : IndexRange(topology_.tet_faces.size())) {
            add(tet(mesh, t));
        }
        return x;
    }

private:
    const TetTopology& topology_;
    std::size_t edges_;
    std::size_t faces_;
    std::size_t inner_;
    std::size_t end_;
};

inline void check_mu(double mu) {
    if (!(mu > 0.0 && mu < 0.25)) {
        throw InputError(ErrorCode::bad_option, "mu must lie between 0 and 1/4, not " + std::to_string(mu));
    }
}

/// Leaves the points in use only, in their order.
PAVIOR_INLINE void drop_unused(PointCells& cells);

/// Local points of the 15 pieces; entry 28 + v stands for node v of the tetrahedron.
struct Piece {
    std::size_t size = 0;
    std::array<std::size_t, 8> points{};
};

[[nodiscard]] constexpr std::array<Piece, 15> make_pieces() {
    std::array<Piece, 15> all{};
    for (std::size_t v = 0; v < 4; ++v) {
        // Faces of tet_faces order are outward: v, then its successors a, b in one of them, c the remaining node.
        const auto& outward = tet_faces[(v + 1) % 4];
        const std::size_t at = static_cast<std::size_t>(outward[0]) == v   ? 0
                               : static_cast<std::size_t>(outward[1]) == v ? 1
                                                                           : 2;
        const auto b = static_cast<std::size_t>(outward[(at + 1) % 3]);
        const auto a = static_cast<std::size_t>(outward[(at + 2) % 3]);
        const std::size_t c = 6 - v - a - b;
        const auto e = [&](std::size_t w) { return edge_point(static_cast<std::size_t>(tet_edge_between[v][w]), v); };
        all[v] = {8, {28 + v, e(a), face_point(c, v), e(b), e(c), face_point(b, v), inner_point(v), face_point(a, v)}};
    }
    for (std::size_t k = 0; k < 6; ++k) {
        const auto i = static_cast<std::size_t>(tet_edges[k][0]);
        const auto j = static_cast<std::size_t>(tet_edges[k][1]);
        // (i, j, a, b) even: face b holds a, and a comes before b round the edge.
        std::size_t a = edge_faces[k][0];
        std::size_t b = edge_faces[k][1];
        const bool even = k == 0 || k == 2 || k == 3 || k == 5;
        if (!even) {
            std::swap(a, b);
        }
        all[4 + k] = {8,
                      {edge_point(k, i), face_point(b, i), inner_point(i), face_point(a, i), edge_point(k, j),
                       face_point(b, j), inner_point(j), face_point(a, j)}};
    }
    for (std::size_t f = 0; f < 4; ++f) {
        const auto& outward = tet_faces[f];
        const auto n = [&](std::size_t s) { return static_cast<std::size_t>(outward[s]); };
        all[10 + f] = {6,
                       {face_point(f, n(0)), face_point(f, n(1)), face_point(f, n(2)), inner_point(n(0)),
                        inner_point(n(1)), inner_point(n(2)), 0, 0}};
    }
    all[14] = {4, {inner_point(0), inner_point(1), inner_point(2), inner_point(3), 0, 0, 0, 0}};
    return all;
}

inline constexpr std::array<Piece, 15> tet_pieces = make_pieces();

}  // namespace detail

/// The contributions as polygons, for planes at barycentric distance 0 < \p mu < 1/4 from the faces; its value changes
/// the picture only. Points in use only, each once. O(n). \throws InputError bad_option (mu), overflow
template <tet_mesh M>
[[nodiscard]] DualSurfaces dual_surfaces(const M& mesh, const TetTopology& topology,
                                         const std::vector<TetContributions>& contributions, double mu = 0.1) {
    detail::check_mu(mu);
    const detail::DualPoints points(topology);
    DualSurfaces out;
    for (const Index t : IndexRange(contributions.size())) {
        const TetCorners c = tet(mesh, t);
        for (std::size_t i = 0; i < candidate_count && !contributions[t].empty(); ++i) {
            const Contribution type = contributions[t][i];
            if (type != Contribution::none) {
                for (std::size_t k = 0; k < tet_candidates[i].size; ++k) {
                    out.ids.push_back(points.id(c, t, tet_candidates[i].points[k]));
                }
                out.begin.push_back(static_cast<Index>(out.ids.size()));
                out.colour.push_back(dual_colour(tet_candidates[i].kind, type));
                out.tet.push_back(t);
            }
        }
    }
    out.points = points.coordinates(mesh, mu);
    detail::drop_unused(out);
    return out;
}

/// The regions as the 15 pieces of each tetrahedron. Points: V nodes + 2 on each of E edges + 3 on each of F faces + 4
/// in each of T tetrahedra, in this order; 15 T polyhedra. O(n), 1.3 kB a tetrahedron.
/// \throws InputError bad_option (mu), overflow
template <tet_mesh M>
[[nodiscard]] RegionPolyhedra region_polyhedra(const M& mesh, const TetTopology& topology, const Regions& regions,
                                               double mu = 0.1) {
    detail::check_mu(mu);
    const detail::DualPoints points(topology);
    RegionPolyhedra out;
    out.points = points.coordinates(mesh, mu);
    for (const Index t : IndexRange(topology.tet_faces.size())) {
        const TetCorners c = tet(mesh, t);
        for (std::size_t i = 0; i < detail::tet_pieces.size(); ++i) {
            const detail::Piece& piece = detail::tet_pieces[i];
            for (std::size_t k = 0; k < piece.size; ++k) {
                out.ids.push_back(piece.points[k] >= 28 ? c[piece.points[k] - 28] : points.id(c, t, piece.points[k]));
            }
            out.begin.push_back(static_cast<Index>(out.ids.size()));
            const Index region = i < 4    ? regions.node[c[i]]
                                 : i < 10 ? regions.edge[topology.tet_edges[t][i - 4]]
                                 : i < 14 ? regions.face[topology.tet_faces[t][i - 10]]
                                          : regions.tet[t];
            out.region.push_back(region);
            out.dimension.push_back(static_cast<std::uint8_t>(regions.dimension(region)));
        }
    }
    return out;
}

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/contributions/dual_surfaces-inl.hpp>
#endif
