#pragma once
/// \file
/// A patch of triangles as the image of a convex polygon.

#include <pavior/block/chain_curve.hpp>
#include <pavior/block/detail/mean_value.hpp>
#include <pavior/block/detail/nearest_weights.hpp>
#include <pavior/block/detail/patch_disc.hpp>
#include <pavior/block/detail/triangle_locator.hpp>
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

/// A one-to-one map of a convex polygon onto a disc of triangles: corners to corners, sides to sides by arc length.
/// A planar disc with straight sides and convex corners is its own polygon: the map is then a rigid motion. Others are
/// unrolled by mean value coordinates \cite floater2003 onto a polygon inscribed in a circle with sides of the lengths
/// of the disc's; its triangles are first refined, so that the map is smooth, but stay the same surface.
class PatchMap {
public:
    PatchMap() = default;
    /// \param enough  triangles at least in the refined disc
    /// \throws InputError size_mismatch (fewer than three sides), bad_index (points that do not exist), invalid_dual
    ///         (the sides are not the boundary of the triangles, or these are no disc). O(n^1.5) time, O(n log n)
    ///         memory.
    explicit PatchMap(const PatchDisc& disc, std::size_t enough = 200) {
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

    /// Corners of the polygon, counter-clockwise; corner s is that of the disc.
    [[nodiscard]] std::span<const Vec2> polygon() const { return polygon_; }
    /// The point of side \p s at the fraction \p t of its length.
    [[nodiscard]] Vec2 side(std::size_t s, double t) const {
        return detail::polygon_side(polygon_, static_cast<std::uint32_t>(s), t);
    }
    /// True if the map is a rigid motion.
    [[nodiscard]] bool rigid() const { return rigid_; }

    /// The point of the patch at \p uv. Outside of the polygon: of the nearest triangle. O(1) as a rule.
    [[nodiscard]] Vec3 at(const Vec2& uv) const {
        if (rigid_) {
            return frame_.origin + uv[0] * frame_.u + uv[1] * frame_.v;
        }
        const auto hit = plane_.locate(uv);
        const TriCorners& c = plane_.triangles()[hit.triangle];
        return hit.weights[0] * points_[c[0]] + hit.weights[1] * points_[c[1]] + hit.weights[2] * points_[c[2]];
    }
    /// The triangle of the disc as given that holds \p uv; the lowest if several do.
    [[nodiscard]] Index triangle_at(const Vec2& uv) const { return origin_[plane_.locate(uv).triangle]; }

    /// The place of the surface point nearest to \p x. O(n).
    [[nodiscard]] Vec2 nearest(const Vec3& x) const {
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
    /// Centroid of the triangles by area; it need not lie on them.
    [[nodiscard]] Vec3 centroid() const {
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
    /// The mean of the corners of the polygon: always inside.
    [[nodiscard]] Vec2 middle() const {
        Vec2 sum = Vec2::Zero();
        for (const Vec2& p : polygon_) {
            sum += p / static_cast<double>(polygon_.size());
        }
        return sum;
    }

private:
    struct Frame {
        Vec3 origin = Vec3::Zero(), u = Vec3::UnitX(), v = Vec3::UnitY(), normal = Vec3::UnitZ();
    };
    /// Frame of the mean plane, the triangles counter-clockwise seen against the normal.
    [[nodiscard]] static Frame plane_frame(const PatchDisc& disc) {
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

    [[nodiscard]] Vec2 flat(const Vec3& p) const {
        return {(p - frame_.origin).dot(frame_.u), (p - frame_.origin).dot(frame_.v)};
    }

    /// Sets polygon_ and says yes if the disc is planar, its sides straight and its corners convex.
    [[nodiscard]] bool find_polygon(const PatchDisc& disc) {
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

    [[nodiscard]] bool convex() const {
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

    bool rigid_ = false;
    Frame frame_;
    std::vector<Vec2> polygon_;
    std::vector<Vec3> points_;
    std::vector<Index> origin_;      // triangle of the disc as given
    detail::TriangleLocator plane_;  // the triangles in the polygon
};

}  // namespace pavior
