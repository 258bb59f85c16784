#pragma once
/// \file
/// Patches as discs of triangles: what they must be.

#include <pavior/block/detail/disc_refinement.hpp>
#include <pavior/block/patch_map.hpp>
#include <pavior/core/error.hpp>
#include <pavior/mesh/cells.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace pavior {

namespace detail {

[[nodiscard]] inline double side_length(const PatchDisc& disc, std::span<const Index> side) {
    double sum = 0.0;
    for (std::size_t i = 1; i < side.size(); ++i) {
        sum += (disc.points[side[i]] - disc.points[side[i - 1]]).norm();
    }
    return sum;
}

inline void require_patch(bool condition, ErrorCode code, const char* message) {
    if (!condition) {
        throw InputError(code, message);
    }
}

inline void place_side(const PatchDisc& disc, std::uint32_t s, Disc& d, std::vector<std::array<Index, 2>>& edges) {
    const auto& side = disc.sides[s];
    require_patch(side.size() >= 2 && side.back() == disc.sides[(s + 1) % d.sides].front(), ErrorCode::invalid_dual,
                  "the sides of a patch do not follow each other");
    const double whole = side_length(disc, side);
    double reach = 0.0;
    for (std::size_t i = 0; i + 1 < side.size(); ++i) {
        require_patch(side[i] < d.places.size() && side[i + 1] < d.places.size(), ErrorCode::bad_index,
                      "a side names a point that its patch lacks");
        require_patch(d.places[side[i]].side == DiscPlace::inside, ErrorCode::invalid_dual, "a patch touches itself");
        const double even = static_cast<double>(i) / static_cast<double>(side.size() - 1);
        d.places[side[i]] = {s, whole > 0.0 ? reach / whole : even};
        reach += (disc.points[side[i + 1]] - disc.points[side[i]]).norm();
        edges.push_back({std::min(side[i], side[i + 1]), std::max(side[i], side[i + 1])});
    }
}

/// The sides must be the boundary of the triangles, which must be a disc.
inline void check_boundary(const Disc& d, std::vector<std::array<Index, 2>> sides) {
    const DiscEdges edges = disc_edges(d.triangles);
    std::vector<std::array<Index, 2>> boundary;
    for (std::size_t e = 0; e < edges.nodes.size(); ++e) {
        if (edges.boundary[e] != 0) {
            boundary.push_back(edges.nodes[e]);
        }
    }
    std::sort(sides.begin(), sides.end());
    require_patch(boundary == sides, ErrorCode::invalid_dual,
                  "the sides of a patch are not the boundary of its triangles");
    std::vector<char> used(d.points.size(), 0);
    for (const TriCorners& c : d.triangles) {
        for (const Index i : c) {
            used[i] = 1;
        }
    }
    const auto nodes = static_cast<std::size_t>(std::count(used.begin(), used.end(), 1));
    require_patch(nodes == d.points.size() && nodes + d.triangles.size() == edges.nodes.size() + 1,
                  ErrorCode::invalid_dual, "a patch is not a disc");
}

/// The disc with the place of each node.
[[nodiscard]] inline Disc checked_disc(const PatchDisc& disc) {
    require_patch(disc.sides.size() >= 3, ErrorCode::size_mismatch, "a patch needs three sides");
    const auto exists = [&](Index i) { return i < disc.points.size(); };
    for (const TriCorners& c : disc.triangles) {
        require_patch(std::all_of(c.begin(), c.end(), exists), ErrorCode::bad_index, "a patch names a point it lacks");
    }
    Disc d{disc.points, disc.triangles, {}, {}, static_cast<std::uint32_t>(disc.sides.size())};
    d.origin.resize(disc.triangles.size());
    for (std::size_t t = 0; t < d.origin.size(); ++t) {
        d.origin[t] = static_cast<Index>(t);
    }
    d.places.resize(disc.points.size());
    std::vector<std::array<Index, 2>> edges;
    for (std::uint32_t s = 0; s < d.sides; ++s) {
        place_side(disc, s, d, edges);
    }
    check_boundary(d, std::move(edges));
    return d;
}

}  // namespace detail
}  // namespace pavior
