#pragma once
/// \file
/// Models that are swept round an axis, unrolled into straight ones.

#include <pavior/core/compiled.hpp>
#include <pavior/many_to_many/extrusion.hpp>
#include <pavior/many_to_many/unrolled_brep.hpp>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <Eigen/SVD>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace pavior {

/// A line that a path turns about.
struct Axis {
    Vec3 origin = Vec3::Zero(), direction = Vec3::UnitZ();  ///< direction of length 1
};

/// Cylinder coordinates that keep lengths at one radius: (r, radius * angle, z), a right-handed system. The angle is
/// within (-pi, pi), 0 towards `middle`.
class Unrolling {
public:
    /// \p middle: a direction that is not parallel to the axis
    Unrolling(const Axis& axis, const Vec3& middle, double radius)
        : axis_(axis),
          x_((middle - middle.dot(axis.direction) * axis.direction).normalized()),
          y_(axis.direction.cross(x_)),
          radius_(radius) {}

    [[nodiscard]] const Axis& axis() const { return axis_; }
    [[nodiscard]] double radius() const { return radius_; }

    [[nodiscard]] Vec3 unrolled(const Vec3& p) const;
    [[nodiscard]] Vec3 rolled(const Vec3& q) const {
        const double angle = q[1] / radius_;
        return axis_.origin + q[0] * (std::cos(angle) * x_ + std::sin(angle) * y_) + q[2] * axis_.direction;
    }
    /// The image of a direction \p d at \p p, which must be off the axis.
    [[nodiscard]] Vec3 unrolled(const Vec3& p, const Vec3& d) const;

private:
    Axis axis_;
    Vec3 x_, y_;
    double radius_;
};

namespace detail {

/// The lines that meet the normals of a surface at its samples: at most two are looked for, none if there are more
/// (planes, spheres). A line through c along d meets that through p along n where d . (p x n) + (c x d) . n = 0.
template <brep B>
void add_axes(const B& b, FaceId face, std::vector<Axis>& axes) {
    std::vector<std::pair<Vec3, Vec3>> samples;
    Vec3 middle = Vec3::Zero();
    for_each_normal(b, face, [&](const Vec2& uv, const Vec3& normal) {
        samples.emplace_back(b.face_point(face, uv), normal);
        middle += samples.back().first;
    });
    if (samples.size() < 6) {
        return;
    }
    middle /= static_cast<double>(samples.size());
    double scale = 0;
    for (const auto& sample : samples) {
        scale = std::max(scale, (sample.first - middle).norm());
    }
    Eigen::MatrixXd rows(static_cast<Eigen::Index>(samples.size()), 6);
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const Vec3 p = (samples[i].first - middle) / scale;
        rows.row(static_cast<Eigen::Index>(i)) << p.cross(samples[i].second).transpose(), samples[i].second.transpose();
    }
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(rows, Eigen::ComputeFullV);
    const auto& sigma = svd.singularValues();
    const double small = 1e-7 * sigma[0];
    const Eigen::Matrix<double, 6, 1> u = svd.matrixV().col(5);
    const Eigen::Matrix<double, 6, 1> v = svd.matrixV().col(4);
    std::vector<Eigen::Matrix<double, 6, 1>> lines;
    if (sigma[3] <= small || sigma[5] > small) {
        return;
    }
    if (sigma[4] > small) {
        lines.push_back(u);
    } else {  // a u + c v is a line where its two halves are perpendicular
        const double uu = u.head<3>().dot(u.tail<3>());
        const double uv = 0.5 * (u.head<3>().dot(v.tail<3>()) + v.head<3>().dot(u.tail<3>()));
        const double vv = v.head<3>().dot(v.tail<3>());
        const double root = std::sqrt(std::max(0.0, uv * uv - uu * vv));
        for (const double sign : {1.0, -1.0}) {
            const std::array<double, 2> one{-uv + sign * root, uu};
            const std::array<double, 2> other{vv, -uv - sign * root};
            const auto& best = std::hypot(one[0], one[1]) > std::hypot(other[0], other[1]) ? one : other;
            lines.emplace_back((best[0] * u + best[1] * v).normalized());
        }
    }
    for (const auto& line : lines) {
        const Vec3 d = line.head<3>();
        const Vec3 m = line.tail<3>();
        if (d.norm() < 1e-6 || std::abs(d.dot(m)) > 1e-6 * d.norm()) {
            continue;  // at infinity, or no line
        }
        std::vector<Vec3> direction;
        add_direction(direction, d);
        const Axis axis{middle + scale * d.cross(m) / d.squaredNorm(), direction.front()};
        const auto same = [&](const Axis& other) {
            return other.direction.cross(axis.direction).norm() < 1e-6 &&
                   (other.origin - axis.origin).cross(axis.direction).norm() < 1e-6 * scale;
        };
        if (std::none_of(axes.begin(), axes.end(), same)) {
            axes.push_back(axis);
        }
    }
}

}  // namespace detail

/// Axes of the surfaces of revolution among the faces of \p solids (not of spheres), in the order of the faces.
/// O(edges).
template <brep B>
[[nodiscard]] std::vector<Axis> revolution_axes(const B& b, std::span<const SolidId> solids) {
    std::vector<Axis> axes;
    for (const FaceId f : detail::faces_of(b, solids)) {
        detail::add_axes(b, f, axes);
    }
    return axes;
}

/// How to unroll \p solids round \p axis: cut where they leave the widest gap, true to length at the middle radius, or
/// farther out where \p size would turn by more than \p max_angle degrees there. Nothing if the solids reach the axis
/// or leave no gap of 10 degrees. O(edges), 128 points each.
template <brep B>
[[nodiscard]] std::optional<Unrolling> unroll_round(const B& b, std::span<const SolidId> solids, const Axis& axis,
                                                    double size, double max_angle = 45) {
    constexpr double least_gap = std::numbers::pi / 18;
    const Vec3 x = axis.direction.unitOrthogonal();
    const Unrolling plain(axis, x, 1);
    std::vector<double> angles;
    double low = std::numeric_limits<double>::infinity();
    double high = 0;
    detail::for_each_boundary_point(b, solids, [&](const Vec3& p) {
        const Vec3 q = plain.unrolled(p);
        low = std::min(low, q[0]);
        high = std::max(high, q[0]);
        angles.push_back(q[1]);
    });
    if (angles.empty() || !(low > 1e-3 * high)) {
        return std::nullopt;
    }
    std::sort(angles.begin(), angles.end());
    double gap = angles.front() + 2 * std::numbers::pi - angles.back();
    double cut = angles.back() + 0.5 * gap;
    for (std::size_t i = 0; i + 1 < angles.size(); ++i) {
        if (angles[i + 1] - angles[i] > gap) {
            gap = angles[i + 1] - angles[i];
            cut = angles[i] + 0.5 * gap;
        }
    }
    if (gap < least_gap) {
        return std::nullopt;
    }
    const double middle = cut + std::numbers::pi;
    const double radius = std::max(0.5 * (low + high), size * 180 / (std::numbers::pi * max_angle));
    return Unrolling(axis, std::cos(middle) * x + std::sin(middle) * axis.direction.cross(x), radius);
}

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/many_to_many/revolution-inl.hpp>
#endif
