#pragma once
/// \file
/// Untangling where the nodes move in the parameter plane of a surface.

#include <pavior/math/any_surface.hpp>
#include <pavior/math/point.hpp>
#include <pavior/smooth/detail/cell_energy.hpp>
#include <pavior/smooth/detail/foldover.hpp>
#include <pavior/smooth/detail/untangle.hpp>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace pavior::detail {

/// Upper triangular U with U^T U = [E F; F G], the first fundamental form of two derivatives: a square root of the
/// metric. Kept regular where the parametrisation is singular, relative to \p least.
[[nodiscard]] inline Eigen::Matrix2d metric_root(double E, double F, double G, double least) {
    const double e = std::max(E, least);
    Eigen::Matrix2d root;
    root << std::sqrt(e), F / std::sqrt(e), 0.0, std::sqrt(std::max(G - F * F / e, least));
    return root;
}

/// Distortion measured with the metric at each corner triangle, taken anew before each step of epsilon: what the energy
/// sees is the surface, however its parameters are scaled or skewed.
/// Metric: void(const Eigen::VectorXd& x, std::vector<Eigen::Matrix2d>& roots).
template <class Metric>
class MetricEnergy : public CellEnergy<2> {
public:
    MetricEnergy(CellEnergy<2> energy, Metric metric)
        : CellEnergy<2>(std::move(energy)), metric_of_(std::move(metric)) {}

    void refresh(const Eigen::VectorXd& x) {
        metric_of_(x, roots_);
        set_metric(roots_);
    }

private:
    Metric metric_of_;
    std::vector<Eigen::Matrix2d> roots_;
};

/// The smoothing_model of quads on a surface.
class SurfaceModel {
public:
    SurfaceModel(const AnySurface& surface, std::span<Vec2> uv, std::span<const QuadCorners> quads,
                 std::span<const std::uint8_t> fixed, std::span<const Vec3> reference, const UntangleOptions& options)
        : surface_(surface), uv_(uv), quads_(quads), fixed_(fixed), reference_(reference), options_(options) {
        points_.reserve(uv.size());
        for (const Vec2& at : uv) {
            points_.push_back(surface_.point(at));
        }
        unit_ = extent(points_);
        reference_unit_ = extent(reference);
        find_box();
    }

    [[nodiscard]] static bool concurrent() { return false; }
    [[nodiscard]] static bool concurrent(const Patch<2>&) { return false; }

    /// Scaled Jacobian in space about the surface's normal in the middle of the quad; not above the one in the
    /// parameter plane where the quad folds there.
    [[nodiscard]] double quality(Index c) const {
        const CellPoints<2> plane = parameters(quads_[c]);
        const double flat = scaled_jacobian<2>(plane, 0);
        const Vec3 normal = middle_normal(quads_[c]);
        if (!(flat > inverted_tolerance) || normal.isZero(0.0)) {
            return flat;
        }
        double least = 1.0;
        for (std::size_t k = 0; k < 4; ++k) {
            const Vec3 a = edge(quads_[c], k, 0);
            const Vec3 b = edge(quads_[c], k, 1);
            const double lengths = a.norm() * b.norm();
            least = std::min(least, lengths > 0.0 ? a.cross(b).dot(normal) / lengths : 0.0);
        }
        return least;
    }

    /// A corner between fixed nodes is folded in the parameter plane.
    [[nodiscard]] bool hopeless(Index c) const {
        const QuadCorners& q = quads_[c];
        for (std::size_t k = 0; k < 4; ++k) {
            const bool rigid = fixed_[q[k]] != 0 && fixed_[q[(k + 1) % 4]] != 0 && fixed_[q[(k + 3) % 4]] != 0;
            if (rigid &&
                !(scaled_determinant<2>(corner_edges<2>(parameters(q), static_cast<int>(k))) > inverted_tolerance)) {
                return true;
            }
        }
        return false;
    }

    /// Parameters and points of the free nodes.
    struct Saved {
        std::vector<Vec2> uv;
        std::vector<Vec3> points;
    };
    [[nodiscard]] Saved save(const Patch<2>& patch) const {
        Saved saved;
        for (std::size_t k = 0; k < patch.free_count; ++k) {
            saved.uv.push_back(uv_[patch.nodes[k]]);
            saved.points.push_back(points_[patch.nodes[k]]);
        }
        return saved;
    }
    void restore(const Patch<2>& patch, const Saved& saved) {
        for (std::size_t k = 0; k < patch.free_count; ++k) {
            uv_[patch.nodes[k]] = saved.uv[k];
            points_[patch.nodes[k]] = saved.points[k];
        }
    }

    int solve(const Patch<2>& patch, double wanted, const Execution& execution) {
        const Frame frame = frame_of(patch);
        CellEnergy<2> flat(coordinates(patch, frame), patch.cells, patch.free_count, 0, execution);
        if (!reference_.empty()) {
            set_ideal(flat, patch);
        }
        MetricEnergy energy(std::move(flat), [&](const Eigen::VectorXd& x, std::vector<Eigen::Matrix2d>& roots) {
            metric_roots(patch, frame, x, roots);
        });
        return move_patch(energy, wanted, options_, [&](const Eigen::VectorXd& x) { write(patch, frame, x); });
    }

private:
    /// Coordinates of a patch: x = to_patch (uv - origin), an affine image in which the surface looks isometric on
    /// average and its quads have area 1.
    struct Frame {
        Vec2 origin;
        Eigen::Matrix2d to_patch;
        Eigen::Matrix2d to_uv;
        double size = 1.0;
    };

    static double extent(std::span<const Vec3> points) {
        double result = 0.0;
        for (const Vec3& x : points) {
            result = std::max(result, (x - points[0]).cwiseAbs().maxCoeff());
        }
        return result > 0.0 ? result : 1.0;
    }

    /// Box of the parameters of the fixed nodes, of all nodes if none is fixed.
    void find_box() {
        const bool bounded = std::any_of(fixed_.begin(), fixed_.end(), [](std::uint8_t flag) { return flag != 0; });
        Eigen::AlignedBox2d box;
        for (std::size_t i = 0; i < uv_.size(); ++i) {
            if (fixed_[i] != 0 || !bounded) {
                box.extend(uv_[i]);
            }
        }
        low_ = uv_.empty() ? Vec2(Vec2::Zero()) : Vec2(box.min());
        high_ = uv_.empty() ? low_ : Vec2(box.max());
        const Vec2 range = high_ - low_;
        range_ = Vec2(range.x() > 0.0 ? range.x() : 1.0, range.y() > 0.0 ? range.y() : 1.0);
    }

    [[nodiscard]] Vec2 into_box(const Vec2& at) const { return at.cwiseMax(low_).cwiseMin(high_); }

    /// Parameters of a quad, each axis scaled by its range.
    [[nodiscard]] CellPoints<2> parameters(const QuadCorners& q) const {
        CellPoints<2> result;
        for (std::size_t k = 0; k < 4; ++k) {
            result.col(static_cast<Eigen::Index>(k)) = (uv_[q[k]] - uv_[q[0]]).cwiseQuotient(range_);
        }
        return result;
    }

    [[nodiscard]] Vec3 edge(const QuadCorners& q, std::size_t corner, std::size_t which) const {
        return (points_[q[(corner + (which == 0 ? 1U : 3U)) % 4]] - points_[q[corner]]) / unit_;
    }

    [[nodiscard]] Vec3 unit_normal(const Vec2& at) const {
        const std::pair<Vec3, Vec3> d = surface_.derivatives(into_box(at));
        const Vec3 du = d.first * (range_.x() / unit_);
        const Vec3 dv = d.second * (range_.y() / unit_);
        const Vec3 normal = du.cross(dv);
        const double lengths = du.norm() * dv.norm();
        return normal.norm() > 1e-12 * lengths ? Vec3(normal.normalized()) : Vec3(Vec3::Zero());
    }

    [[nodiscard]] Vec3 middle_normal(const QuadCorners& q) const {
        Vec3 normal = unit_normal(0.25 * (uv_[q[0]] + uv_[q[1]] + uv_[q[2]] + uv_[q[3]]));
        if (normal.isZero(0.0)) {
            for (const Index i : q) {
                normal += unit_normal(uv_[i]);
            }
        }
        return normal.norm() > 0.0 ? Vec3(normal.normalized()) : normal;
    }

    /// First fundamental form {E, F, G} at a point, which is moved into the box of the fixed nodes first.
    [[nodiscard]] Vec3 first_form(const Vec2& at) const {
        const std::pair<Vec3, Vec3> d = surface_.derivatives(into_box(at));
        const Vec3 du = d.first * (range_.x() / unit_);
        const Vec3 dv = d.second * (range_.y() / unit_);
        return {du.squaredNorm(), du.dot(dv), dv.squaredNorm()};
    }

    [[nodiscard]] Frame frame_of(const Patch<2>& patch) const {
        Frame frame;
        frame.origin = uv_[patch.nodes[0]];
        Vec3 mean = Vec3::Zero();
        std::vector<Vec3> forms;
        for (const Index c : patch.cell_ids) {
            const QuadCorners& q = quads_[c];
            forms.push_back(first_form(0.25 * (uv_[q[0]] + uv_[q[1]] + uv_[q[2]] + uv_[q[3]])));
            mean += forms.back() / static_cast<double>(patch.cells.size());
        }
        double area = 0.0;
        double edges = 0.0;
        for (std::size_t k = 0; k < patch.cells.size(); ++k) {
            const Vec3& g = forms[k];
            const double share = 1.0 / static_cast<double>(patch.cells.size());
            area += share * std::sqrt(std::max(0.0, g[0] * g[2] - g[1] * g[1])) *
                    signed_measure<2>(parameters(quads_[patch.cell_ids[k]]));
            edges +=
                share * edge(quads_[patch.cell_ids[k]], 0, 0).norm() * edge(quads_[patch.cell_ids[k]], 0, 1).norm();
        }
        frame.size = std::sqrt(area > 1e-9 * edges ? area : std::max(edges, 1e-300));
        const Eigen::Matrix2d root = metric_root(mean[0], mean[1], mean[2], 1e-24 * (mean[0] + mean[2]) + 1e-300);
        frame.to_patch = root * range_.cwiseInverse().asDiagonal() / frame.size;
        frame.to_uv = frame.to_patch.inverse();
        return frame;
    }

    [[nodiscard]] Eigen::Matrix2Xd coordinates(const Patch<2>& patch, const Frame& frame) const {
        Eigen::Matrix2Xd result(2, static_cast<Eigen::Index>(patch.nodes.size()));
        for (std::size_t k = 0; k < patch.nodes.size(); ++k) {
            result.col(static_cast<Eigen::Index>(k)) = frame.to_patch * (uv_[patch.nodes[k]] - frame.origin);
        }
        return result;
    }

    void write(const Patch<2>& patch, const Frame& frame, const Eigen::VectorXd& x) {
        for (std::size_t k = 0; k < patch.free_count; ++k) {
            const Index i = patch.nodes[k];
            uv_[i] = frame.origin + frame.to_uv * x.segment<2>(static_cast<Eigen::Index>(k) * 2);
            points_[i] = surface_.point(uv_[i]);
        }
    }

    /// Square root of the metric in the coordinates of the patch, in the middle of each corner triangle.
    void metric_roots(const Patch<2>& patch, const Frame& frame, const Eigen::VectorXd& x,
                      std::vector<Eigen::Matrix2d>& roots) const {
        const auto parameter = [&](Index local) {
            return local < patch.free_count
                       ? Vec2(frame.origin + frame.to_uv * x.segment<2>(static_cast<Eigen::Index>(local) * 2))
                       : uv_[patch.nodes[local]];
        };
        const Eigen::Matrix2d from_patch = range_.cwiseInverse().asDiagonal() * frame.to_uv / frame.size;
        roots.resize(patch.cells.size() * 4);
        for (std::size_t k = 0; k < roots.size(); ++k) {
            const QuadCorners& q = patch.cells[k / 4];
            const std::size_t corner = k % 4;
            const Vec2 a = parameter(q[corner]);
            const Vec2 b = parameter(q[(corner + 1) % 4]);
            const Vec2 d = parameter(q[(corner + 3) % 4]);
            const Vec3 g = first_form(a + ((b - a) + (d - a)) / 3.0);
            const double trace = g[0] + g[2];
            roots[k] = metric_root(g[0], g[1], g[2], 1e-24 * trace + 1e-300) * from_patch;
        }
    }

    /// Ideal corner triangles from the reference in space, scaled so that their mean area is 1, weighted by it; squares
    /// where the reference is degenerate or reflex.
    void set_ideal(CellEnergy<2>& energy, const Patch<2>& patch) const {
        std::vector<Eigen::Matrix2d> ideal(patch.cells.size() * 4, Eigen::Matrix2d::Identity());
        std::vector<double> weight(ideal.size(), 0.0);
        double sum = 0.0;
        std::size_t good = 0;
        for (std::size_t k = 0; k < ideal.size(); ++k) {
            const QuadCorners& q = quads_[patch.cell_ids[k / 4]];
            const std::size_t corner = k % 4;
            const auto between = [&](std::size_t from, std::size_t to) {
                return Vec3((reference_[q[to % 4]] - reference_[q[from % 4]]) / reference_unit_);
            };
            const Vec3 a = between(corner, corner + 1);
            const Vec3 b = between(corner, corner + 3);
            const Vec3 normal = between(0, 2).cross(between(1, 3));
            const double area = a.cross(b).norm();
            if (area > 1e-3 * a.norm() * b.norm() && a.cross(b).dot(normal) > 0.0) {
                ideal[k] << a.norm(), a.dot(b) / a.norm(), 0.0, area / a.norm();
                weight[k] = area;
                sum += area;
                ++good;
            }
        }
        const double mean = good != 0 ? sum / static_cast<double>(good) : 1.0;
        for (std::size_t k = 0; k < ideal.size(); ++k) {
            const bool degenerate = weight[k] <= 0.0;
            ideal[k] = degenerate ? ideal[k] : (ideal[k].inverse() * std::sqrt(mean)).eval();
            weight[k] = degenerate ? 1.0 : weight[k] / mean;
        }
        energy.set_ideal(std::move(ideal), std::move(weight));
    }

    AnySurface surface_;
    std::span<Vec2> uv_;
    std::span<const QuadCorners> quads_;
    std::span<const std::uint8_t> fixed_;
    std::span<const Vec3> reference_;
    const UntangleOptions& options_;
    std::vector<Vec3> points_;
    Vec2 low_, high_, range_;
    double unit_ = 1.0;
    double reference_unit_ = 1.0;
};

}  // namespace pavior::detail
