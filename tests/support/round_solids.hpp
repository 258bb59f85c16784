#pragma once
// Surfaces of round solids from rings of points: strips between rings, fans at the ends.

#include <pavior/mesh/tagged_mesh.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numbers>
#include <utility>
#include <vector>

namespace pavior::test {

using Ring = std::vector<Vec3>;

[[nodiscard]] inline double signed_volume(const TriMesh& mesh) {
    double sum = 0;
    for (const TriCorners& t : mesh.triangles) {
        sum += mesh.nodes[t[0]].cross(mesh.nodes[t[1]]).dot(mesh.nodes[t[2]]) / 6;
    }
    return sum;
}

/// Points of angle 2 pi k / n round the third axis.
[[nodiscard]] inline Ring circle(std::size_t n, double radius, double height) {
    Ring ring;
    for (std::size_t k = 0; k < n; ++k) {
        const double a = 2 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(n);
        ring.emplace_back(radius * std::cos(a), radius * std::sin(a), height);
    }
    return ring;
}

/// The points of a circle pushed out to the square |x|, |y| <= half; n is a multiple of 8.
[[nodiscard]] inline Ring square(std::size_t n, double half, double height) {
    Ring ring = circle(n, 1, height);
    for (Vec3& x : ring) {
        const double out = half / std::max(std::abs(x[0]), std::abs(x[1]));
        x[0] *= out;
        x[1] *= out;
    }
    return ring;
}

/// The surface that the rings sweep, closed by fans round their centres or, with \p loop, by a strip from the last to
/// the first; volume positive, or negative with \p cavity.
[[nodiscard]] inline TriMesh rings(const std::vector<Ring>& all, bool loop, bool cavity = false) {
    TriMesh mesh;
    const std::size_t n = all[0].size();
    for (const Ring& ring : all) {
        mesh.nodes.insert(mesh.nodes.end(), ring.begin(), ring.end());
    }
    const auto id = [&](std::size_t r, std::size_t k) { return static_cast<Index>(r * n + k % n); };
    for (std::size_t r = 0; r + (loop ? 0 : 1) < all.size(); ++r) {
        const std::size_t next = (r + 1) % all.size();
        for (std::size_t k = 0; k < n; ++k) {
            mesh.triangles.push_back({id(r, k), id(r, k + 1), id(next, k + 1)});
            mesh.triangles.push_back({id(r, k), id(next, k + 1), id(next, k)});
        }
    }
    for (const bool first : {true, false}) {
        if (loop) {
            break;
        }
        const std::size_t r = first ? 0 : all.size() - 1;
        Vec3 centre(0, 0, 0);
        for (const Vec3& x : all[r]) {
            centre += x / static_cast<double>(n);
        }
        const auto middle = static_cast<Index>(mesh.nodes.size());
        mesh.nodes.push_back(centre);
        for (std::size_t k = 0; k < n; ++k) {
            const Index a = id(r, k + (first ? 1 : 0));
            const Index b = id(r, k + (first ? 0 : 1));
            mesh.triangles.push_back({a, b, middle});
        }
    }
    if ((signed_volume(mesh) < 0) != cavity) {
        for (TriCorners& t : mesh.triangles) {
            std::swap(t[1], t[2]);
        }
    }
    return mesh;
}

/// A sphere of rings about the third axis, its poles fans of the smallest rings.
[[nodiscard]] inline TriMesh sphere(std::size_t n, double radius, bool cavity = false) {
    std::vector<Ring> all;
    for (std::size_t k = 1; k < n / 2; ++k) {
        const double a = std::numbers::pi * static_cast<double>(k) / static_cast<double>(n / 2);
        all.push_back(circle(n, radius * std::sin(a), radius * std::cos(a)));
    }
    TriMesh mesh = rings(all, false, cavity);
    mesh.nodes[mesh.nodes.size() - 2][2] = radius;
    mesh.nodes.back()[2] = -radius;
    return mesh;
}

/// Two shells in one mesh.
[[nodiscard]] inline TriMesh together(TriMesh a, const TriMesh& b) {
    const auto shift = static_cast<Index>(a.nodes.size());
    a.nodes.insert(a.nodes.end(), b.nodes.begin(), b.nodes.end());
    for (const TriCorners& t : b.triangles) {
        a.triangles.push_back({t[0] + shift, t[1] + shift, t[2] + shift});
    }
    return a;
}

/// Cross-sections of a torus from 0 to \p degrees (360: closed) about the third axis.
[[nodiscard]] inline TriMesh bent_tube(std::size_t n, std::size_t sections, double radius, double tube,
                                       double degrees) {
    std::vector<Ring> all;
    const bool loop = degrees >= 360;
    for (std::size_t s = 0; s < sections + (loop ? 0 : 1); ++s) {
        const double a = degrees * std::numbers::pi / 180 * static_cast<double>(s) / static_cast<double>(sections);
        Ring ring;
        for (const Vec3& x : circle(n, tube, 0)) {
            const double r = radius + x[0];
            ring.emplace_back(r * std::cos(a), r * std::sin(a), x[1]);
        }
        all.push_back(std::move(ring));
    }
    return rings(all, loop);
}

}  // namespace pavior::test
