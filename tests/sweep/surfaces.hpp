#pragma once
// Parametric surfaces as a user of the library would write them, shared by the tests of this room.

#include <pavior/math/parametric_surface.hpp>

#include <Eigen/Geometry>

#include <cmath>
#include <utility>

namespace surfaces {

using pavior::Vec2;
using pavior::Vec3;
using Derivatives = std::pair<Vec3, Vec3>;

/// Plane with skew axes of different lengths.
struct SkewPlane {
    Vec3 origin{1.0, 2.0, 3.0};
    Vec3 u{2.0, 0.0, 0.5};
    Vec3 v{0.3, 0.7, 0.0};
    [[nodiscard]] Vec3 point(const Vec2& p) const { return origin + p.x() * u + p.y() * v; }
    [[nodiscard]] Derivatives derivatives(const Vec2&) const { return {u, v}; }
};

/// The plane z = height with Cartesian parameters.
struct FlatPlane {
    double height = 0.0;
    [[nodiscard]] Vec3 point(const Vec2& p) const { return {p.x(), p.y(), height}; }
    [[nodiscard]] Derivatives derivatives(const Vec2&) const { return {Vec3::UnitX(), Vec3::UnitY()}; }
    [[nodiscard]] Vec2 closest(const Vec3& x) const { return {x.x(), x.y()}; }
};

/// Cylinder about z, u the angle; flipped: (v, u) instead, so that the normal points inwards.
struct Cylinder {
    double radius = 2.0;
    bool flipped = false;
    [[nodiscard]] Vec3 point(const Vec2& p) const {
        const auto [a, z] = split(p);
        return {radius * std::cos(a), radius * std::sin(a), z};
    }
    [[nodiscard]] Derivatives derivatives(const Vec2& p) const {
        const double a = split(p).first;
        const Vec3 around(-radius * std::sin(a), radius * std::cos(a), 0.0);
        return flipped ? Derivatives{Vec3::UnitZ(), around} : Derivatives{around, Vec3::UnitZ()};
    }
    [[nodiscard]] Vec2 closest(const Vec3& x) const {
        const double a = std::atan2(x.y(), x.x());
        return flipped ? Vec2(x.z(), a) : Vec2(a, x.z());
    }

private:
    [[nodiscard]] std::pair<double, double> split(const Vec2& p) const {
        return flipped ? std::pair{p.y(), p.x()} : std::pair{p.x(), p.y()};
    }
};

/// Unit sphere, u longitude, v latitude.
struct Sphere {
    [[nodiscard]] Vec3 point(const Vec2& p) const {
        return {std::cos(p.x()) * std::cos(p.y()), std::sin(p.x()) * std::cos(p.y()), std::sin(p.y())};
    }
    [[nodiscard]] Derivatives derivatives(const Vec2& p) const {
        return {Vec3(-std::sin(p.x()) * std::cos(p.y()), std::cos(p.x()) * std::cos(p.y()), 0.0),
                Vec3(-std::cos(p.x()) * std::sin(p.y()), -std::sin(p.x()) * std::sin(p.y()), std::cos(p.y()))};
    }
    [[nodiscard]] Vec2 closest(const Vec3& x) const {
        return {std::atan2(x.y(), x.x()), std::atan2(x.z(), std::hypot(x.x(), x.y()))};
    }
};

/// z = height + bend x y.
struct Saddle {
    double bend = 0.7;
    double height = 0.0;
    [[nodiscard]] Vec3 point(const Vec2& p) const { return {p.x(), p.y(), height + bend * p.x() * p.y()}; }
    [[nodiscard]] Derivatives derivatives(const Vec2& p) const {
        return {Vec3(1.0, 0.0, bend * p.y()), Vec3(0.0, 1.0, bend * p.x())};
    }
};

/// Torus about z, u around the axis, v around the tube.
struct Torus {
    double big = 3.0;
    double small = 1.0;
    [[nodiscard]] Vec3 point(const Vec2& p) const {
        const double r = big + small * std::cos(p.y());
        return {r * std::cos(p.x()), r * std::sin(p.x()), small * std::sin(p.y())};
    }
    [[nodiscard]] Derivatives derivatives(const Vec2& p) const {
        const double r = big + small * std::cos(p.y());
        return {Vec3(-r * std::sin(p.x()), r * std::cos(p.x()), 0.0),
                small * Vec3(-std::sin(p.y()) * std::cos(p.x()), -std::sin(p.y()) * std::sin(p.x()), std::cos(p.y()))};
    }
};

/// The plane z = 0 whose parameters swirl: the point at radius r is turned by twist * r^2.
struct Swirl {
    double twist = 1.0;
    [[nodiscard]] Vec3 point(const Vec2& p) const {
        const double a = twist * p.squaredNorm();
        return {std::cos(a) * p.x() - std::sin(a) * p.y(), std::sin(a) * p.x() + std::cos(a) * p.y(), 0.0};
    }
    [[nodiscard]] Derivatives derivatives(const Vec2& p) const {
        const double a = twist * p.squaredNorm();
        const Vec3 x = point(p);
        const Vec3 turned(-x.y(), x.x(), 0.0);
        return {Vec3(std::cos(a), std::sin(a), 0.0) + 2.0 * twist * p.x() * turned,
                Vec3(-std::sin(a), std::cos(a), 0.0) + 2.0 * twist * p.y() * turned};
    }
    [[nodiscard]] Vec2 closest(const Vec3& x) const {
        const double a = -twist * (x.x() * x.x() + x.y() * x.y());
        return {std::cos(a) * x.x() - std::sin(a) * x.y(), std::sin(a) * x.x() + std::cos(a) * x.y()};
    }
};

}  // namespace surfaces
