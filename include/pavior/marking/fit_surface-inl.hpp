#pragma once

#include <pavior/marking/fit_surface.hpp>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace pavior {

namespace detail {

PAVIOR_INLINE Vec3 mean_centre(std::span<const Facet> facets) {
    Vec3 sum(0, 0, 0);
    double total = 0;
    for (const Facet& f : facets) {
        sum += f.area * f.centre;
        total += f.area;
    }
    return sum / total;
}

PAVIOR_INLINE Vec3 mean_normal(std::span<const Facet> facets) {
    Vec3 sum(0, 0, 0);
    for (const Facet& f : facets) {
        sum += f.area * f.normal;
    }
    return sum;
}

/// Sets the sense so that the normals agree with most of the triangles.
inline void orient(PatchSurface& s, std::span<const Facet> facets) {
    double agree = 0;
    for (const Facet& f : facets) {
        agree += f.area * s.normal(f.centre).dot(f.normal);
    }
    s.sense = agree < 0 ? -s.sense : s.sense;
}

/// The surface with its parameters moved: point (3), axis turned (2), radius, tube; lengths in units of `size`.
[[nodiscard]] inline PatchSurface moved(const PatchSurface& s, const Eigen::Matrix<double, 7, 1>& step, double size) {
    PatchSurface out = s;
    const Vec3 u = s.axis.unitOrthogonal();
    out.point += size * step.head<3>();
    out.axis = (s.axis + step[3] * u + step[4] * s.axis.cross(u)).normalized();
    out.radius += s.kind == SurfaceKind::cone ? step[5] : size * step[5];
    out.tube += s.kind == SurfaceKind::torus ? size * step[6] : 0.0;
    return out;
}

/// Gauss-Newton steps on the sum of the squared distances of the points.
[[nodiscard]] inline PatchSurface polished(PatchSurface s, std::span<const Vec3> points) {
    using Vec7 = Eigen::Matrix<double, 7, 1>;
    double size = 0;
    for (const Vec3& x : points) {
        size = std::max(size, (x - points[0]).norm());
    }
    const auto error = [&](const PatchSurface& t) {
        double sum = 0;
        for (const Vec3& x : points) {
            sum += t.distance(x) * t.distance(x);
        }
        return sum;
    };
    double last = error(s);
    for (int round = 0; round < 20 && last > 0; ++round) {
        Eigen::Matrix<double, 7, 7> a = Eigen::Matrix<double, 7, 7>::Zero();
        Vec7 b = Vec7::Zero();
        std::vector<std::array<PatchSurface, 2>> turned;
        for (Eigen::Index k = 0; k < 7; ++k) {
            turned.push_back({moved(s, 1e-5 * Vec7::Unit(k), size), moved(s, -1e-5 * Vec7::Unit(k), size)});
        }
        for (const Vec3& x : points) {
            Vec7 row;
            for (Eigen::Index k = 0; k < 7; ++k) {
                const auto& both = turned[static_cast<std::size_t>(k)];
                row[k] = (both[0].distance(x) - both[1].distance(x)) / (2e-5 * size);
            }
            a += row * row.transpose();
            b -= row * s.distance(x) / size;
        }
        a.diagonal().array() += 1e-12 * a.trace();
        const PatchSurface next = moved(s, a.ldlt().solve(b), size);
        const double now = error(next);
        if (!(now < last)) {
            break;
        }
        s = next;
        last = now;
    }
    return s;
}

[[nodiscard]] inline PatchSurface plane_through(std::span<const Facet> facets, std::span<const Vec3> points) {
    PatchSurface s;
    s.axis = mean_normal(facets).normalized();
    Vec3 centre(0, 0, 0);
    for (const Vec3& x : points) {
        centre += x;
    }
    centre /= static_cast<double>(points.size());
    Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
    for (const Vec3& x : points) {
        spread += (x - centre) * (x - centre).transpose();
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(spread);
    const Vec3 best = eigen.eigenvectors().col(0);
    if (std::abs(best.dot(s.axis)) > 0.99 && eigen.eigenvalues()(1) > 1e-8 * eigen.eigenvalues()(2)) {
        s.axis = best.dot(s.axis) > 0 ? best : Vec3(-best);
    }
    s.point = centre;
    return s;
}

PAVIOR_INLINE std::optional<Circle> fit_circle(std::span<const Vec2> points) {
    if (points.size() < 3) {
        return std::nullopt;
    }
    Vec2 mean(0, 0);
    for (const Vec2& p : points) {
        mean += p / static_cast<double>(points.size());
    }
    Eigen::Matrix2d a = Eigen::Matrix2d::Zero();
    Vec2 b(0, 0);
    double square = 0;
    for (const Vec2& p : points) {
        const Vec2 d = p - mean;
        a += d * d.transpose();
        b += 0.5 * d.squaredNorm() * d;
        square += d.squaredNorm() / static_cast<double>(points.size());
    }
    if (std::abs(a.determinant()) <= 1e-12 * a.trace() * a.trace()) {
        return std::nullopt;
    }
    const Vec2 offset = a.ldlt().solve(b);
    return Circle{mean + offset, std::sqrt(square + offset.squaredNorm())};
}

/// Directions and least eigenvalue over the greatest of the spread of the normals (about their mean, or about zero).
struct NormalSpread {
    Vec3 axis{0, 0, 1};
    double least = 1.0;
    double middle = 1.0;
};

[[nodiscard]] inline NormalSpread normal_spread(std::span<const Facet> facets, bool about_mean) {
    Vec3 mean(0, 0, 0);
    double total = 0;
    for (const Facet& f : facets) {
        total += f.area;
    }
    if (about_mean) {
        mean = mean_normal(facets) / total;
    }
    Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
    for (const Facet& f : facets) {
        spread += f.area / total * (f.normal - mean) * (f.normal - mean).transpose();
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(spread);
    return {eigen.eigenvectors().col(0), eigen.eigenvalues()(0), eigen.eigenvalues()(1)};
}

[[nodiscard]] inline std::optional<PatchSurface> cylinder_through(std::span<const Facet> facets,
                                                                  std::span<const Vec3> points) {
    const NormalSpread spread = normal_spread(facets, false);
    if (spread.least > 0.02 || spread.middle < 1e-6) {
        return std::nullopt;
    }
    PatchSurface s;
    s.kind = SurfaceKind::cylinder;
    s.axis = spread.axis;
    const Vec3 u = s.axis.unitOrthogonal();
    const Vec3 v = s.axis.cross(u);
    std::vector<Vec2> flat;
    for (const Vec3& x : points) {
        flat.emplace_back(u.dot(x), v.dot(x));
    }
    const std::optional<Circle> circle = fit_circle(flat);
    if (!circle) {
        return std::nullopt;
    }
    s.point = circle->centre[0] * u + circle->centre[1] * v;
    s.radius = circle->radius;
    return polished(s, points);
}

[[nodiscard]] inline std::optional<PatchSurface> sphere_through(std::span<const Vec3> points) {
    if (points.size() < 4) {
        return std::nullopt;
    }
    const auto n = static_cast<double>(points.size());
    Vec3 mean(0, 0, 0);
    for (const Vec3& x : points) {
        mean += x / n;
    }
    Eigen::Matrix3d a = Eigen::Matrix3d::Zero();
    Vec3 b(0, 0, 0);
    double square = 0;
    for (const Vec3& x : points) {
        const Vec3 d = x - mean;
        a += d * d.transpose();
        b += 0.5 * d.squaredNorm() * d;
        square += d.squaredNorm() / n;
    }
    const double scale = a.trace();
    if (std::abs(a.determinant()) <= 1e-12 * scale * scale * scale) {
        return std::nullopt;
    }
    const Vec3 offset = a.ldlt().solve(b);
    PatchSurface s;
    s.kind = SurfaceKind::sphere;
    s.point = mean + offset;
    s.radius = std::sqrt(square + offset.squaredNorm());
    return s;
}

PAVIOR_INLINE std::optional<std::pair<Vec3, Vec3>> axis_of_revolution(std::span<const Facet> facets) {
    const Vec3 centre = mean_centre(facets);
    double size = 0;
    for (const Facet& f : facets) {
        size = std::max(size, (f.centre - centre).norm());
    }
    if (!(size > 0)) {
        return std::nullopt;
    }
    Eigen::Matrix<double, 6, 6> sum = Eigen::Matrix<double, 6, 6>::Zero();
    for (const Facet& f : facets) {
        Eigen::Matrix<double, 6, 1> row;
        row << ((f.centre - centre) / size).cross(f.normal), f.normal;
        sum += f.area * row * row.transpose();
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>> eigen(sum);
    if (eigen.eigenvalues()(0) > 0.01 * eigen.eigenvalues()(5) ||
        eigen.eigenvalues()(1) < 1e-6 * eigen.eigenvalues()(5)) {
        return std::nullopt;  // plane, sphere, cylinder: more than one axis
    }
    const Vec3 direction = eigen.eigenvectors().col(0).head<3>();
    const Vec3 moment = eigen.eigenvectors().col(0).tail<3>();
    const double square = direction.squaredNorm();
    if (square < 1e-3 || std::abs(direction.dot(moment)) > 0.1 * square) {
        return std::nullopt;  // extruded or helical
    }
    return std::pair(Vec3(centre + size * direction.cross(moment) / square), Vec3(direction.normalized()));
}

[[nodiscard]] inline std::optional<PatchSurface> torus_through(std::span<const Facet> facets,
                                                               std::span<const Vec3> points) {
    const auto axis = axis_of_revolution(facets);
    if (!axis) {
        return std::nullopt;
    }
    PatchSurface s;
    s.kind = SurfaceKind::torus;
    s.point = axis->first;
    s.axis = axis->second;
    std::vector<Vec2> profile;
    for (const Vec3& x : points) {
        const AxisPoint p = about_axis(s, x);
        profile.emplace_back(p.radius, p.height);
    }
    const std::optional<Circle> circle = fit_circle(profile);
    if (!circle || circle->centre[0] < 1e-3 * circle->radius) {
        return std::nullopt;
    }
    s.point += circle->centre[1] * s.axis;
    s.radius = circle->centre[0];
    s.tube = circle->radius;
    return polished(s, points);
}

[[nodiscard]] inline std::optional<PatchSurface> cone_through(std::span<const Facet> facets,
                                                              std::span<const Vec3> points) {
    const NormalSpread spread = normal_spread(facets, true);
    if (spread.least > 0.02 || spread.middle < 1e-6) {
        return std::nullopt;
    }
    Eigen::Matrix3d a = Eigen::Matrix3d::Zero();  // the apex is on the planes of all triangles
    Vec3 b(0, 0, 0);
    double slope = 0;
    double total = 0;
    for (const Facet& f : facets) {
        a += f.area * f.normal * f.normal.transpose();
        b += f.area * f.normal.dot(f.centre) * f.normal;
        slope += f.area * f.normal.dot(spread.axis);
        total += f.area;
    }
    slope /= total;
    if (std::abs(a.determinant()) <= 1e-9 * a.trace() * a.trace() * a.trace() || std::abs(slope) > 0.999) {
        return std::nullopt;
    }
    PatchSurface s;
    s.kind = SurfaceKind::cone;
    s.point = a.ldlt().solve(b);
    s.axis = spread.axis.dot(mean_centre(facets) - s.point) < 0 ? Vec3(-spread.axis) : spread.axis;
    s.radius = std::abs(slope) / std::sqrt(1 - slope * slope);
    return polished(s, points);
}

/// Largest distance of the centres, and of the given points, from the surface.
[[nodiscard]] inline double largest_distance(const PatchSurface& s, std::span<const Facet> facets,
                                             std::span<const Vec3> points) {
    double most = 0;
    for (const Facet& f : facets) {
        most = std::max(most, std::abs(s.distance(f.centre)));
    }
    for (const Vec3& x : points) {
        most = std::max(most, std::abs(s.distance(x)));
    }
    return most;
}

/// The surface with its side, if it fits.
[[nodiscard]] inline std::optional<PatchSurface> held(std::optional<PatchSurface> s, std::span<const Facet> facets,
                                                      std::span<const Vec3> points, double tolerance) {
    if (s) {
        orient(*s, facets);
        if (!fit_holds(*s, facets, points, tolerance)) {
            s.reset();
        }
    }
    return s;
}

/// Two circles are on a cone and on a sphere: the one closer to the triangles.
[[nodiscard]] inline std::optional<PatchSurface> cone_or_sphere(std::span<const Facet> facets,
                                                                std::span<const Vec3> points, double tolerance) {
    std::optional<PatchSurface> sphere = held(sphere_through(points), facets, points, tolerance);
    std::optional<PatchSurface> cone = held(cone_through(facets, points), facets, points, tolerance);
    const bool both = sphere && cone;
    if (both ? largest_distance(*sphere, facets, points) < largest_distance(*cone, facets, points) : !cone) {
        return sphere;
    }
    return cone;
}

[[nodiscard]] inline PatchSurface curved_through(std::span<const Facet> facets, std::span<const Vec3> points,
                                                 double tolerance) {
    if (const auto cylinder = held(cylinder_through(facets, points), facets, points, tolerance)) {
        return *cylinder;
    }
    if (const auto round = cone_or_sphere(facets, points, tolerance)) {
        return *round;
    }
    if (const auto torus = held(torus_through(facets, points), facets, points, tolerance)) {
        return *torus;
    }
    PatchSurface s;
    s.kind = SurfaceKind::facets;
    s.facets.assign(facets.begin(), facets.end());
    return s;
}

}  // namespace detail

PAVIOR_INLINE PatchSurface fit_surface(std::span<const Facet> facets, std::span<const Vec3> points, double tolerance) {
    PatchSurface s = detail::plane_through(facets, points);
    if (!detail::fit_holds(s, facets, points, tolerance)) {
        s = detail::curved_through(facets, points, tolerance);
    }
    s.sagitta = detail::largest_distance(s, facets, points);
    return s;
}

}  // namespace pavior
