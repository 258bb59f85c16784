#pragma once
/// \file
/// Embeds a disc of triangles in a convex polygon.

#include <pavior/block/detail/disc_refinement.hpp>
#include <pavior/core/error.hpp>

#include <Eigen/Geometry>
#include <Eigen/SparseCore>
#include <Eigen/SparseLU>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace pavior::detail {

/// The tangent of half the angle at \p a between \p b and \p c, in [1e-6, 1e6].
[[nodiscard]] inline double half_tangent(const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 u = b - a;
    const Vec3 v = c - a;
    const double sine = u.cross(v).norm();
    const double cosine = u.norm() * v.norm() + u.dot(v);
    return cosine > 0.0 && sine < 1e6 * cosine ? std::max(sine / cosine, 1e-6) : 1e6;
}

/// A point of side \p s of a polygon.
[[nodiscard]] inline Vec2 polygon_side(std::span<const Vec2> polygon, std::uint32_t s, double t) {
    return (1.0 - t) * polygon[s] + t * polygon[(s + 1) % polygon.size()];
}

/// Places the nodes of \p disc: those of the boundary on the sides of \p polygon by their fractions, each inner one at
/// the mean value combination of its neighbours \cite floater2003. All weights are positive, so the triangles do not
/// fold as long as the polygon is strictly convex and no inner edge joins two nodes of one side. One sparse LU.
[[nodiscard]] inline std::vector<Vec2> embed_disc(const Disc& disc, std::span<const Vec2> polygon) {
    std::vector<Vec2> uv(disc.points.size(), Vec2::Zero());
    std::vector<Eigen::Index> unknown(uv.size(), -1);
    Eigen::Index unknowns = 0;
    for (std::size_t i = 0; i < uv.size(); ++i) {
        const DiscPlace& place = disc.places[i];
        if (place.side == DiscPlace::inside) {
            unknown[i] = unknowns++;
        } else {
            uv[i] = polygon_side(polygon, place.side, place.t);
        }
    }
    if (unknowns == 0) {
        return uv;
    }
    std::vector<Eigen::Triplet<double>> entries;
    Eigen::MatrixX2d right = Eigen::MatrixX2d::Zero(unknowns, 2);
    const auto add = [&](Index from, Index to, double weight) {  // one wing of the weight of the edge from -> to
        const Eigen::Index row = unknown[from];
        if (row < 0) {
            return;
        }
        entries.emplace_back(row, row, weight);
        if (unknown[to] >= 0) {
            entries.emplace_back(row, unknown[to], -weight);
        } else {
            right.row(row) += weight * uv[to].transpose();
        }
    };
    double size = 0.0;
    for (const Vec3& p : disc.points) {
        size = std::max(size, (p - disc.points.front()).norm());
    }
    for (const TriCorners& c : disc.triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            const std::array<Index, 3> i{c[k], c[(k + 1) % 3], c[(k + 2) % 3]};
            const Vec3& a = disc.points[i[0]];
            const double half = half_tangent(a, disc.points[i[1]], disc.points[i[2]]);
            const double shortest = 1e-12 * size;
            for (const Index other : {i[1], i[2]}) {
                add(i[0], other, half * size / std::max((disc.points[other] - a).norm(), shortest));
            }
        }
    }
    Eigen::SparseMatrix<double> matrix(unknowns, unknowns);
    matrix.setFromTriplets(entries.begin(), entries.end());
    Eigen::SparseLU<Eigen::SparseMatrix<double>> solver(matrix);
    if (solver.info() != Eigen::Success) {
        throw InputError(ErrorCode::invalid_dual, "a patch could not be unrolled: it is not a disc");
    }
    const Eigen::MatrixX2d solution = solver.solve(right);
    for (std::size_t i = 0; i < uv.size(); ++i) {
        if (unknown[i] >= 0) {
            uv[i] = solution.row(unknown[i]).transpose();
        }
    }
    return uv;
}

/// The convex polygon inscribed in a circle whose sides are as long as \p lengths, as far as the centre of the circle
/// stays well inside: lengths that do not allow it are evened out. Counter-clockwise from (0, 0) along +x.
[[nodiscard]] inline std::vector<Vec2> cyclic_polygon(std::vector<double> lengths) {
    const std::size_t n = lengths.size();
    double mean = 0.0;
    for (const double l : lengths) {
        mean += l / static_cast<double>(n);
    }
    for (double& l : lengths) {
        l = mean > 0.0 ? std::max(l / mean, 0.05) : 1.0;
    }
    const auto turn = [&](double radius) {
        double sum = 0.0;
        for (const double l : lengths) {
            sum += 2.0 * std::asin(std::min(1.0, l / (2.0 * radius)));
        }
        return sum;
    };
    const double circle = 4.0 * std::acos(0.0);
    const auto smallest = [&] { return 0.52 * *std::max_element(lengths.begin(), lengths.end()); };
    while (turn(smallest()) < circle) {
        for (double& l : lengths) {
            l = 0.8 * l + 0.2;
        }
    }
    double low = smallest();
    double high = static_cast<double>(n) * low;
    for (int i = 0; i < 100; ++i) {
        const double middle = 0.5 * (low + high);
        (turn(middle) > circle ? low : high) = middle;
    }
    std::vector<Vec2> polygon;
    double angle = -std::acos(0.0) - std::asin(lengths[0] / (2.0 * low));
    const double scale = mean > 0.0 ? mean : 1.0;
    for (std::size_t i = 0; i < n; ++i) {
        polygon.emplace_back(scale * low * std::cos(angle), scale * low * std::sin(angle));
        angle += 2.0 * std::asin(lengths[i] / (2.0 * low));
    }
    const Vec2 origin = polygon.front();
    for (Vec2& p : polygon) {
        p -= origin;
    }
    return polygon;
}

}  // namespace pavior::detail
