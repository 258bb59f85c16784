#pragma once
// Internals of target_projection.hpp: checks, orientation, residuals of the boundary.

#include <pavior/affine/fit.hpp>
#include <pavior/core/error.hpp>
#include <pavior/mesh/cells.hpp>
#include <pavior/sweep/boundary_error.hpp>
#include <pavior/sweep/folded_quads.hpp>
#include <pavior/sweep/harmonic_error.hpp>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace pavior::detail {

template <class P>
void require_finite(std::span<const P> points, const char* what) {
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (!points[i].allFinite()) {
            throw InputError(ErrorCode::not_finite, std::string(what) + " that is not finite",
                             {static_cast<std::int64_t>(i)});
        }
    }
}

inline void require_size(std::size_t size, std::size_t wanted, const char* what) {
    if (size != wanted) {
        throw InputError(ErrorCode::size_mismatch, std::string(what) + ": " + std::to_string(size) + " given, " +
                                                       std::to_string(wanted) + " wanted");
    }
}

/// Marks the nodes of the loops with 1. InputError for loops or quads that name nodes outside [0, count), and for nodes
/// that the loops name twice.
[[nodiscard]] inline std::vector<std::uint8_t> mark_boundary(std::size_t count, std::span<const QuadCorners> quads,
                                                             const Loops& loops) {
    if (loops.nodes.empty()) {
        throw InputError(ErrorCode::empty_input, "a cap without boundary nodes");
    }
    verify_loop_offsets(loops.offsets, loops.nodes.size());
    std::vector<std::uint8_t> boundary(count, 0);
    for (const Index i : loops.nodes) {
        if (i >= count || boundary[i] != 0) {
            throw InputError(ErrorCode::bad_index,
                             i >= count ? "a loop names a node that does not exist" : "the loops name a node twice",
                             {i});
        }
        boundary[i] = 1;
    }
    for (std::size_t q = 0; q < quads.size(); ++q) {
        if (std::any_of(quads[q].begin(), quads[q].end(), [count](Index i) { return i >= count; })) {
            throw InputError(ErrorCode::bad_index, "a quad names a node that does not exist",
                             {static_cast<std::int64_t>(q)});
        }
    }
    return boundary;
}

/// The loop points as the columns of a matrix.
template <class P>
[[nodiscard]] auto columns(std::span<const P> points) {
    Eigen::Matrix<double, P::RowsAtCompileTime, Eigen::Dynamic> X(static_cast<Eigen::Index>(P::RowsAtCompileTime),
                                                                  static_cast<Eigen::Index>(points.size()));
    for (std::size_t i = 0; i < points.size(); ++i) {
        X.col(static_cast<Eigen::Index>(i)) = points[i];
    }
    return X;
}

template <class P>
[[nodiscard]] std::vector<P> pick(std::span<const P> nodes, std::span<const Index> ids) {
    std::vector<P> points(ids.size());
    std::transform(ids.begin(), ids.end(), points.begin(), [nodes](Index i) { return nodes[i]; });
    return points;
}

/// Signed area inside the loops (holes run the other way).
[[nodiscard]] inline double loops_area(std::span<const Vec2> points, std::span<const std::size_t> offsets) {
    double area = 0.0;
    for (std::size_t l = 0; l + 1 < offsets.size(); ++l) {
        area += signed_area(points.subspan(offsets[l], offsets[l + 1] - offsets[l]));
    }
    return area;
}

[[nodiscard]] inline double quads_area(std::span<const Vec2> uv, std::span<const QuadCorners> quads) {
    double area = 0.0;
    for (const QuadCorners& q : quads) {
        area += signed_area(gather(uv, q));
    }
    return area;
}

/// Adds sum_i w_i residual_i to point j of \p images for every inner node j, w_i ~ 1 / |at_j - at_(loop node i)|^2,
/// normalised over all loops; at distance 0 that loop node takes all. O(inner x loop nodes).
template <class At, class P>
void add_residuals(std::span<const At> at, std::span<const std::uint8_t> boundary, std::span<const Index> loop_nodes,
                   std::span<const P> residuals, std::span<P> images) {
    for (std::size_t j = 0; j < at.size(); ++j) {
        if (boundary[j] != 0) {
            continue;
        }
        double weights = 0.0;
        P sum = P::Zero();
        for (std::size_t i = 0; i < loop_nodes.size(); ++i) {
            const double square = (at[j] - at[loop_nodes[i]]).squaredNorm();
            if (!(square > 0.0)) {
                sum = residuals[i];
                weights = 1.0;
                break;
            }
            weights += 1.0 / square;
            sum += residuals[i] / square;
        }
        images[j] += sum / weights;
    }
}

/// The same by discrete harmonic functions on the quads (HarmonicError), or with the weights above.
template <class P>
void spread_residuals(BoundaryCorrection by, std::span<const Vec3> at, std::span<const QuadCorners> quads,
                      std::span<const std::uint8_t> boundary, std::span<const Index> loop_nodes,
                      std::span<const P> residuals, std::span<P> images) {
    if (by != BoundaryCorrection::harmonic) {
        add_residuals(at, boundary, loop_nodes, residuals, images);
        return;
    }
    const HarmonicError error(at, quads, loop_nodes);
    const Eigen::MatrixXd rows = columns(residuals).transpose();
    const HarmonicError::Prepared prepared = error.prepare(rows);
    for (std::size_t j = 0; j < at.size(); ++j) {
        if (boundary[j] == 0) {
            images[j] += prepared.field.row(static_cast<Eigen::Index>(j)).transpose();
        }
    }
}

}  // namespace pavior::detail
