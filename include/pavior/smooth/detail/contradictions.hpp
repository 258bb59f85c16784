#pragma once
/// \file
/// Corners at fixed nodes that cannot all be positive, wherever the free node on their common edge goes.

#include <pavior/core/index.hpp>
#include <pavior/smooth/detail/cell_shape.hpp>
#include <pavior/smooth/detail/patch.hpp>
#include <pavior/smooth/distortion.hpp>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace pavior::detail {

/// A unit direction and how many half-spaces normal * direction > 0 it lies in.
template <int D>
struct ConeDirection {
    Eigen::Matrix<double, D, 1> direction;
    std::size_t inside = 0;
};

/// A direction inside as many half-spaces as a search over the subsets of up to D normals finds; \p first if no other
/// is inside more. If there is one inside all it is found: the point of their convex hull nearest to the origin gives
/// it.
/// \param normals  unit length. O(m^(D + 1)) for m normals, of which a star of hexahedra has a few.
template <int D>
[[nodiscard]] ConeDirection<D> direction_in_cone(std::span<const Eigen::Matrix<double, D, 1>> normals,
                                                 const Eigen::Matrix<double, D, 1>& first) {
    using Vector = Eigen::Matrix<double, D, 1>;
    ConeDirection<D> best;
    const auto offer = [&](const Vector& point) {
        const double length = point.norm();
        if (!(length > 1e-9)) {
            return;
        }
        const Vector direction = point / length;
        const auto count = static_cast<std::size_t>(std::count_if(
            normals.begin(), normals.end(), [&](const Vector& normal) { return normal.dot(direction) > 1e-9; }));
        if (count > best.inside) {
            best = {direction, count};
        }
    };
    offer(first);
    const std::size_t m = normals.size();
    for (std::size_t a = 0; a < m && best.inside < m; ++a) {
        offer(normals[a]);
        for (std::size_t b = a + 1; b < m && best.inside < m; ++b) {
            offer(normals[a] + normals[b]);
            if constexpr (D == 3) {
                for (std::size_t c = b + 1; c < m; ++c) {
                    const Vector across = (normals[b] - normals[a]).cross(normals[c] - normals[a]);
                    offer(across.dot(normals[a]) * across);
                }
            }
        }
    }
    return best;
}

/// Finds the corners that contradict others at the same fixed node: with one free node among its neighbours, each asks
/// for a half-space of that node's positions.
/// Points: CellPoints<D> points(Index cell).
template <int D, class Points>
class ContradictionFinder {
public:
    ContradictionFinder(std::span<const CellCorners<D>> cells, std::span<const std::uint8_t> fixed,
                        const PatchFinder<D>& finder, const Points& points)
        : cells_(cells), fixed_(fixed), finder_(finder), points_(points) {}

    /// Bit k of the result is set for corner k of a cell that is given up; one entry per cell, or none if nothing
    /// contradicts. Only stars with an inverted corner of the cells \p inverted count. O(inverted cells).
    [[nodiscard]] std::vector<std::uint32_t> find(std::span<const Index> inverted) {
        for (const Index id : inverted) {
            for (std::size_t at = 0; at < cells_[id].size(); ++at) {
                const Corner corner{id, at, lone_free(cells_[id], at)};
                const bool done = !given_up_.empty() && (given_up_[id] >> at & 1U) != 0;
                if (!done && corner.slot >= 0 && !(scaled_determinant<D>(edges(corner)) > 0.0)) {
                    resolve(corner);
                }
            }
        }
        return std::move(given_up_);
    }

private:
    using Vector = Eigen::Matrix<double, D, 1>;
    struct Corner {
        Index cell;
        std::size_t at;
        int slot;  ///< of the free neighbour
    };

    /// The slot of the only free neighbour of a fixed corner; -1 if there is none or another.
    [[nodiscard]] int lone_free(const CellCorners<D>& cell, std::size_t at) const {
        int slot = -1;
        for (int k = 0; k < D && fixed_[cell[at]] != 0; ++k) {
            const auto other = static_cast<std::size_t>(CellTopology<D>::neighbours[at][static_cast<std::size_t>(k)]);
            if (fixed_[cell[other]] == 0) {
                slot = slot == -1 ? k : D;
            }
        }
        return slot < D ? slot : -1;
    }
    [[nodiscard]] Index neighbour(const Corner& c) const {
        const auto slot = static_cast<std::size_t>(c.slot);
        return cells_[c.cell][static_cast<std::size_t>(CellTopology<D>::neighbours[c.at][slot])];
    }
    [[nodiscard]] Eigen::Matrix<double, D, D> edges(const Corner& c) const {
        return corner_edges<D>(points_(c.cell), static_cast<int>(c.at));
    }

    /// The corners with the fixed and the free node of \p suspect.
    [[nodiscard]] std::vector<Corner> star_of(const Corner& suspect) const {
        const Index centre = cells_[suspect.cell][suspect.at];
        std::vector<Corner> star;
        for (const Index id : finder_.cells_round(centre)) {
            for (std::size_t at = 0; at < cells_[id].size(); ++at) {
                const Corner corner{id, at, lone_free(cells_[id], at)};
                if (cells_[id][at] == centre && corner.slot >= 0 && neighbour(corner) == neighbour(suspect)) {
                    star.push_back(corner);
                }
            }
        }
        return star;
    }

    void resolve(const Corner& suspect) {
        const std::vector<Corner> star = star_of(suspect);
        std::vector<Vector> normals;
        for (const Corner& corner : star) {
            const Vector normal = cofactors<D>(edges(corner)).col(corner.slot);
            normals.push_back(normal.norm() > 0.0 ? Vector(normal.normalized()) : normal);
        }
        const ConeDirection<D> best = direction_in_cone<D>(normals, edges(suspect).col(suspect.slot));
        for (std::size_t k = 0; k < star.size() && best.inside < star.size(); ++k) {
            if (best.inside == 0 || !(normals[k].dot(best.direction) > 1e-9)) {
                given_up_.resize(cells_.size(), 0);
                given_up_[star[k].cell] |= 1U << star[k].at;
            }
        }
    }

    std::span<const CellCorners<D>> cells_;
    std::span<const std::uint8_t> fixed_;
    const PatchFinder<D>& finder_;
    const Points& points_;
    std::vector<std::uint32_t> given_up_;
};

}  // namespace pavior::detail
