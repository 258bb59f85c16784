#pragma once

#include <pavior/block/chain_curve.hpp>
#include <pavior/block/detail/disc_refinement.hpp>
#include <pavior/block/detail/mean_value.hpp>
#include <pavior/block/detail/nearest_weights.hpp>
#include <pavior/block/patch_map.hpp>
#include <pavior/core/error.hpp>
#include <pavior/mesh/cells.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
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

PAVIOR_INLINE Vec2 PatchMap::side(std::size_t s, double t) const {
    return detail::polygon_side(polygon_, static_cast<std::uint32_t>(s), t);
}

PAVIOR_INLINE PatchMap::PatchMap(const PatchDisc& disc, std::size_t enough) {
    detail::Disc d = detail::checked_disc(disc);
    frame_ = plane_frame(disc);
    std::vector<Vec2> uv;
    if (rigid_ = find_polygon(disc); !rigid_) {
        std::vector<double> lengths;
        for (const auto& side : disc.sides) {
            lengths.push_back(detail::side_length(disc, side));
        }
        polygon_ = detail::cyclic_polygon(std::move(lengths));
        d = detail::refine_disc(std::move(d), enough);
        uv = detail::embed_disc(d, polygon_);
    } else {
        for (const Vec3& p : disc.points) {
            uv.push_back(flat(p));
        }
    }
    points_ = std::move(d.points);
    origin_ = std::move(d.origin);
    plane_ = detail::TriangleLocator(std::move(uv), std::move(d.triangles));
}

PAVIOR_INLINE Vec3 PatchMap::at(const Vec2& uv) const {
    if (rigid_) {
        return frame_.origin + uv[0] * frame_.u + uv[1] * frame_.v;
    }
    const auto hit = plane_.locate(uv);
    const TriCorners& c = plane_.triangles()[hit.triangle];
    return hit.weights[0] * points_[c[0]] + hit.weights[1] * points_[c[1]] + hit.weights[2] * points_[c[2]];
}

PAVIOR_INLINE Vec2 PatchMap::nearest(const Vec3& x) const {
    double best = std::numeric_limits<double>::infinity();
    Vec2 place = Vec2::Zero();
    for (const TriCorners& c : plane_.triangles()) {
        const Eigen::Vector3d w = detail::nearest_weights(x, points_[c[0]], points_[c[1]], points_[c[2]]);
        const double d = (w[0] * points_[c[0]] + w[1] * points_[c[1]] + w[2] * points_[c[2]] - x).squaredNorm();
        if (d < best) {
            best = d;
            place = w[0] * plane_.uv()[c[0]] + w[1] * plane_.uv()[c[1]] + w[2] * plane_.uv()[c[2]];
        }
    }
    return place;
}

PAVIOR_INLINE Vec3 PatchMap::centroid() const {
    Vec3 sum = Vec3::Zero();
    Vec3 mean = Vec3::Zero();
    double area = 0.0;
    for (const TriCorners& c : plane_.triangles()) {
        const Vec3 third = (points_[c[0]] + points_[c[1]] + points_[c[2]]) / 3.0;
        const double a = (points_[c[1]] - points_[c[0]]).cross(points_[c[2]] - points_[c[0]]).norm();
        sum += a * third;
        mean += third / static_cast<double>(plane_.triangles().size());
        area += a;
    }
    return area > 0.0 ? Vec3(sum / area) : mean;
}

PAVIOR_INLINE Vec2 PatchMap::middle() const {
    Vec2 sum = Vec2::Zero();
    for (const Vec2& p : polygon_) {
        sum += p / static_cast<double>(polygon_.size());
    }
    return sum;
}

PAVIOR_INLINE PatchMap::Frame PatchMap::plane_frame(const PatchDisc& disc) {
    Frame frame;
    Vec3 normal = Vec3::Zero();
    for (const TriCorners& c : disc.triangles) {
        const Vec3& a = disc.points[c[0]];
        normal += (disc.points[c[1]] - a).cross(disc.points[c[2]] - a);
    }
    frame.origin = disc.points[disc.sides[0].front()];
    const Vec3 along = disc.points[disc.sides[0].back()] - frame.origin;
    if (normal.norm() > 0.0) {
        frame.normal = normal.normalized();
        const Vec3 u = along - along.dot(frame.normal) * frame.normal;
        frame.u = u.norm() > 0.0 ? Vec3(u.normalized()) : Vec3(frame.normal.unitOrthogonal());
        frame.v = frame.normal.cross(frame.u);
    }
    return frame;
}

PAVIOR_INLINE bool PatchMap::find_polygon(const PatchDisc& disc) {
    double size = 0.0;
    for (const Vec3& p : disc.points) {
        size = std::max(size, (p - frame_.origin).norm());
    }
    const double tolerance = 1e-9 * size;
    for (const Vec3& p : disc.points) {
        if (std::abs((p - frame_.origin).dot(frame_.normal)) > tolerance) {
            return false;
        }
    }
    polygon_.clear();
    for (const auto& side : disc.sides) {
        std::vector<Vec3> points;
        for (const Index i : side) {
            points.push_back(disc.points[i]);
        }
        if (ChainCurve(std::move(points)).sag() > tolerance) {
            return false;
        }
        polygon_.push_back(flat(disc.points[side.front()]));
    }
    return convex();
}

PAVIOR_INLINE bool PatchMap::convex() const {
    const std::size_t n = polygon_.size();
    double turned = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
        const Vec2 a = polygon_[(i + 1) % n] - polygon_[i];
        const Vec2 b = polygon_[(i + 2) % n] - polygon_[(i + 1) % n];
        const double cross = a[0] * b[1] - a[1] * b[0];
        if (!(cross > 1e-6 * a.norm() * b.norm())) {
            return false;
        }
        turned += std::atan2(cross, a.dot(b));
    }
    return turned < 7.0;  // one turn, not two
}

}  // namespace pavior
