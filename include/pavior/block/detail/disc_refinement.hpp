#pragma once
/// \file
/// Finer triangles on a disc, so that every interior node of it can be placed freely.

#include <pavior/math/point.hpp>
#include <pavior/mesh/cells.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace pavior::detail {

/// Where a node of a disc lies on its boundary: side s at the fraction t of its length; a corner is {s, 0}, and also
/// {s - 1, 1}. Inside: side is `inside`.
struct DiscPlace {
    static constexpr std::uint32_t inside = std::numeric_limits<std::uint32_t>::max();
    std::uint32_t side = inside;
    double t = 0.0;
};

/// A disc of triangles over \p sides sides, with the place of each node and the triangle that each came from.
struct Disc {
    std::vector<Vec3> points;
    std::vector<TriCorners> triangles;
    std::vector<Index> origin;
    std::vector<DiscPlace> places;
    std::uint32_t sides = 0;
};

/// The side that both ends lie on, or `inside`.
[[nodiscard]] inline std::uint32_t common_side(const Disc& disc, Index a, Index b) {
    const auto on = [&](const DiscPlace& p, std::uint32_t s) {
        return p.side == s || (p.side != DiscPlace::inside && p.t == 0.0 && (s + 1) % disc.sides == p.side);
    };
    const DiscPlace& pa = disc.places[a];
    const DiscPlace& pb = disc.places[b];
    if (pa.side == DiscPlace::inside || pb.side == DiscPlace::inside) {
        return DiscPlace::inside;
    }
    if (on(pb, pa.side)) {
        return pa.side;
    }
    if (on(pa, pb.side)) {
        return pb.side;
    }
    const std::uint32_t before = (pa.side + disc.sides - 1) % disc.sides;
    return on(pa, before) && on(pb, before) ? before : DiscPlace::inside;
}

/// The edges of a disc: nodes ascending, and whether one triangle only has it.
struct DiscEdges {
    std::vector<std::array<Index, 2>> nodes;
    std::vector<std::uint8_t> boundary;
    std::vector<std::array<Index, 3>> of_triangle;  ///< edge k runs from corner k to corner k + 1
};

[[nodiscard]] inline DiscEdges disc_edges(const std::vector<TriCorners>& triangles) {
    struct Use {
        std::array<Index, 2> nodes;
        Index triangle;
        std::uint32_t corner;
    };
    std::vector<Use> uses;
    uses.reserve(3 * triangles.size());
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        for (std::uint32_t k = 0; k < 3; ++k) {
            const Index a = triangles[t][k];
            const Index b = triangles[t][(k + 1) % 3];
            uses.push_back({{std::min(a, b), std::max(a, b)}, static_cast<Index>(t), k});
        }
    }
    std::sort(uses.begin(), uses.end(), [](const Use& a, const Use& b) {
        return a.nodes != b.nodes ? a.nodes < b.nodes : a.triangle < b.triangle;
    });
    DiscEdges edges;
    edges.of_triangle.resize(triangles.size());
    for (std::size_t i = 0; i < uses.size(); ++i) {
        if (i == 0 || uses[i].nodes != uses[i - 1].nodes) {
            edges.nodes.push_back(uses[i].nodes);
            edges.boundary.push_back(1);
        } else {
            edges.boundary.back() = 0;
        }
        edges.of_triangle[uses[i].triangle][uses[i].corner] = static_cast<Index>(edges.nodes.size() - 1);
    }
    return edges;
}

/// The fraction of side \p s at which a node of it lies.
[[nodiscard]] inline double fraction_on(const DiscPlace& place, std::uint32_t s) {
    return place.side == s ? place.t : 1.0;
}

/// The triangles that a triangle falls into when its marked edges are halved; middles[k] of edge k, or no_index.
template <class Emit>
void split_triangle(const TriCorners& c, const std::array<Index, 3>& middles, const Emit& emit) {
    std::uint32_t first = 0;  // turned so that the marked edges come first
    const auto marked = [&](std::uint32_t k) { return middles[(first + k) % 3] != no_index; };
    const auto count = static_cast<std::uint32_t>(3 - std::count(middles.begin(), middles.end(), no_index));
    while (count > 0 && count < 3 && !(marked(0) && !marked(2))) {
        ++first;
    }
    const auto corner = [&](std::uint32_t k) { return c[(first + k) % 3]; };
    const auto middle = [&](std::uint32_t k) { return middles[(first + k) % 3]; };
    if (count == 0) {
        emit(TriCorners{c});
    } else if (count == 1) {
        emit(TriCorners{corner(0), middle(0), corner(2)});
        emit(TriCorners{middle(0), corner(1), corner(2)});
    } else if (count == 2) {
        emit(TriCorners{middle(0), corner(1), middle(1)});
        emit(TriCorners{corner(0), middle(0), middle(1)});
        emit(TriCorners{corner(0), middle(1), corner(2)});
    } else {
        emit(TriCorners{corner(0), middle(0), middle(2)});
        emit(TriCorners{middle(0), corner(1), middle(1)});
        emit(TriCorners{middle(2), middle(1), corner(2)});
        emit(TriCorners{middle(0), middle(1), middle(2)});
    }
}

/// Halves the edges that split(edge) names.
template <class Split>
[[nodiscard]] Disc split_edges(Disc disc, const DiscEdges& edges, const Split& split) {
    std::vector<Index> middle(edges.nodes.size(), no_index);
    for (std::size_t e = 0; e < edges.nodes.size(); ++e) {
        if (!split(e)) {
            continue;
        }
        const auto [a, b] = edges.nodes[e];
        middle[e] = static_cast<Index>(disc.points.size());
        disc.points.emplace_back(0.5 * (disc.points[a] + disc.points[b]));
        const std::uint32_t side = edges.boundary[e] != 0 ? common_side(disc, a, b) : DiscPlace::inside;
        const bool inside = side == DiscPlace::inside;
        disc.places.push_back(
            {side, inside ? 0.0 : 0.5 * (fraction_on(disc.places[a], side) + fraction_on(disc.places[b], side))});
    }
    std::vector<TriCorners> triangles;
    std::vector<Index> origin;
    for (std::size_t t = 0; t < disc.triangles.size(); ++t) {
        const auto& e = edges.of_triangle[t];
        split_triangle(disc.triangles[t], {middle[e[0]], middle[e[1]], middle[e[2]]}, [&](const TriCorners& c) {
            triangles.push_back(c);
            origin.push_back(disc.origin[t]);
        });
    }
    disc.triangles = std::move(triangles);
    disc.origin = std::move(origin);
    return disc;
}

/// Halves the inner edges whose two ends lie on one side: they would be flat in a convex polygon.
[[nodiscard]] inline Disc split_dividing_edges(Disc disc) {
    const DiscEdges edges = disc_edges(disc.triangles);
    const auto divides = [&](std::size_t e) {
        return edges.boundary[e] == 0 && common_side(disc, edges.nodes[e][0], edges.nodes[e][1]) != DiscPlace::inside;
    };
    std::vector<std::uint8_t> marked(edges.nodes.size());
    for (std::size_t e = 0; e < marked.size(); ++e) {
        marked[e] = divides(e) ? 1 : 0;
    }
    return split_edges(std::move(disc), edges, [&](std::size_t e) { return marked[e] != 0; });
}

/// Halves all edges until there are \p enough triangles, and then those that divide.
[[nodiscard]] inline Disc refine_disc(Disc disc, std::size_t enough) {
    while (disc.triangles.size() < enough) {
        const DiscEdges edges = disc_edges(disc.triangles);
        disc = split_edges(std::move(disc), edges, [](std::size_t) { return true; });
    }
    return split_dividing_edges(std::move(disc));
}

}  // namespace pavior::detail
