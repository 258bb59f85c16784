#include "surface_polygons.hpp"

#include <Eigen/Geometry>

#include <algorithm>

namespace pavior::io {

namespace {

/// Ears of a polygon seen along its normal.
class EarCutter {
public:
    EarCutter(std::span<const Vec3> nodes, std::span<const Index> corners)
        : nodes_(nodes), left_(corners.begin(), corners.end()) {
        for (std::size_t i = 0; i < left_.size(); ++i) {  // Newell: twice the area vector
            normal_ += (at(i) - at(0)).cross(at(i + 1) - at(0));
        }
    }

    void cut(std::vector<TriCorners>& triangles) {
        while (left_.size() > 3) {
            const std::size_t ear = best_ear();
            triangles.push_back({id(ear + left_.size() - 1), id(ear), id(ear + 1)});
            left_.erase(left_.begin() + static_cast<std::ptrdiff_t>(ear));
        }
        triangles.push_back({left_[0], left_[1], left_[2]});
    }

private:
    [[nodiscard]] Index id(std::size_t i) const { return left_[i % left_.size()]; }
    [[nodiscard]] const Vec3& at(std::size_t i) const { return nodes_[id(i)]; }

    /// Twice the area of a triangle as seen along the normal.
    [[nodiscard]] double area(const Vec3& a, const Vec3& b, const Vec3& c) const {
        return (b - a).cross(c - a).dot(normal_);
    }

    /// The ear of the best shape; any corner where there is none (a polygon that crosses itself).
    [[nodiscard]] std::size_t best_ear() const {
        std::size_t best = 0;
        double best_shape = -1.0;
        for (std::size_t i = 0; i < left_.size(); ++i) {
            const Vec3& a = at(i + left_.size() - 1);
            const Vec3& b = at(i);
            const Vec3& c = at(i + 1);
            const double size = area(a, b, c);
            const double shape = size / ((b - a).squaredNorm() + (c - b).squaredNorm() + (a - c).squaredNorm());
            if (size > 0.0 && shape > best_shape && empty(i)) {
                best = i;
                best_shape = shape;
            }
        }
        return best;
    }

    /// True if no other corner lies in the triangle at corner i.
    [[nodiscard]] bool empty(std::size_t i) const {
        const Vec3& a = at(i + left_.size() - 1);
        const Vec3& b = at(i);
        const Vec3& c = at(i + 1);
        for (std::size_t k = i + 2; k + 1 < i + left_.size(); ++k) {
            const Vec3& x = at(k);
            if (area(a, b, x) >= 0.0 && area(b, c, x) >= 0.0 && area(c, a, x) >= 0.0 && x != a && x != c) {
                return false;
            }
        }
        return true;
    }

    std::span<const Vec3> nodes_;
    std::vector<Index> left_;
    Vec3 normal_ = Vec3::Zero();
};

}  // namespace

void cut_polygon(std::span<const Vec3> nodes, std::span<const Index> corners, std::vector<TriCorners>& triangles) {
    if (corners.size() == 3) {
        triangles.push_back({corners[0], corners[1], corners[2]});
    } else if (corners.size() > 3) {
        EarCutter(nodes, corners).cut(triangles);
    }
}

}  // namespace pavior::io
