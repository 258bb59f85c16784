#pragma once
/// \file
/// The triangle of a set in space that is nearest to a point.

#include <pavior/core/index.hpp>
#include <pavior/math/box.hpp>
#include <pavior/math/point.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace pavior::detail {

[[nodiscard]] inline double squared_distance_to_triangle(const Vec3& x, const std::array<Vec3, 3>& t) {
    const Vec3 u = t[1] - t[0];
    const Vec3 v = t[2] - t[0];
    const Vec3 d = x - t[0];
    const Vec3 n = u.cross(v);
    const double square = n.squaredNorm();
    if (square > 0) {
        const double p = n.dot(d.cross(v)) / square;
        const double q = n.dot(u.cross(d)) / square;
        if (p >= 0 && q >= 0 && p + q <= 1) {
            return n.dot(d) * n.dot(d) / square;
        }
    }
    double best = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 e = t[(k + 1) % 3] - t[k];
        const double s = std::clamp(e.dot(x - t[k]) / std::max(e.squaredNorm(), 1e-300), 0.0, 1.0);
        best = std::min(best, (x - t[k] - s * e).squaredNorm());
    }
    return best;
}

/// Triangles in a tree of boxes. A query takes O(log n) for points close to them.
class NearTriangles {
public:
    using Triangle = std::array<Vec3, 3>;
    /// Nearest triangle: squared distance, and height above its plane. Among equally near ones that with the greatest
    /// height: the point lies before that one, and beside the others.
    struct Hit {
        double square = std::numeric_limits<double>::infinity();
        double height = 0;
    };

    NearTriangles() = default;
    explicit NearTriangles(std::vector<Triangle> triangles) : triangles_(std::move(triangles)) {
        boxes_.resize(triangles_.empty() ? 0 : 2 * leaves(triangles_.size()));
        if (!triangles_.empty()) {
            build(1, 0, triangles_.size());
        }
    }

    /// Among those whose squared distance is less than \p limit; its square is \p limit if there are none.
    [[nodiscard]] Hit nearest(const Vec3& x, double limit = std::numeric_limits<double>::infinity()) const {
        Hit hit;
        hit.square = limit;
        if (!triangles_.empty()) {
            descend(1, 0, triangles_.size(), x, hit);
        }
        return hit;
    }

private:
    static constexpr std::size_t leaf_size = 4;

    [[nodiscard]] static std::size_t leaves(std::size_t n) {
        std::size_t count = 1;
        while (count * leaf_size < n) {
            count *= 2;
        }
        return 2 * count;
    }

    void build(std::size_t node, std::size_t begin, std::size_t end) {
        Box<Vec3>& box = boxes_[node];
        for (std::size_t t = begin; t < end; ++t) {
            for (const Vec3& p : triangles_[t]) {
                box.add(p);
            }
        }
        if (end - begin <= leaf_size) {
            return;
        }
        Eigen::Index axis = 0;
        (box.high - box.low).maxCoeff(&axis);
        const std::size_t middle = (begin + end) / 2;
        const auto at = [&](std::size_t i) { return triangles_.begin() + static_cast<std::ptrdiff_t>(i); };
        std::nth_element(at(begin), at(middle), at(end), [axis](const Triangle& a, const Triangle& b) {
            return a[0][axis] + a[1][axis] + a[2][axis] < b[0][axis] + b[1][axis] + b[2][axis];
        });
        build(2 * node, begin, middle);
        build(2 * node + 1, middle, end);
    }

    void descend(std::size_t node, std::size_t begin, std::size_t end, const Vec3& x, Hit& hit) const {
        if (end - begin <= leaf_size) {
            for (std::size_t t = begin; t < end; ++t) {
                improve(triangles_[t], x, hit);
            }
            return;
        }
        const std::size_t middle = (begin + end) / 2;
        const double left = boxes_[2 * node].square_distance(x);
        const double right = boxes_[2 * node + 1].square_distance(x);
        for (const bool first : {left <= right, left > right}) {
            if ((first ? left : right) <= hit.square * (1 + 1e-9)) {
                descend(2 * node + (first ? 0 : 1), first ? begin : middle, first ? middle : end, x, hit);
            }
        }
    }

    static void improve(const Triangle& t, const Vec3& x, Hit& hit) {
        const double square = squared_distance_to_triangle(x, t);
        if (!(square <= hit.square * (1 + 1e-9))) {
            return;
        }
        const Vec3 n = (t[1] - t[0]).cross(t[2] - t[0]);
        const double height = n.dot(x - t[0]) / std::max(n.norm(), std::numeric_limits<double>::min());
        if (square < hit.square * (1 - 1e-9) || std::abs(height) > std::abs(hit.height)) {
            hit = {std::min(square, hit.square), height};
        }
    }

    std::vector<Triangle> triangles_;
    std::vector<Box<Vec3>> boxes_;
};

}  // namespace pavior::detail
