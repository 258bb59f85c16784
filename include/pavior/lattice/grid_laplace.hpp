#pragma once
/// \file
/// Positions of the inner nodes of a lattice region: a discrete harmonic map with given layer widths.

#include <pavior/core/compiled.hpp>
#include <pavior/core/error.hpp>
#include <pavior/lattice/logical_grid.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace pavior {

/// What the layers of a lattice region are like in space, axis by axis.
template <std::size_t D>
struct LatticeLayers {
    /// width[a][i]: width of the layer between coordinates low[a] + i and low[a] + i + 1, any unit, > 0.
    std::array<std::vector<double>, D> width;
    /// Coordinates (ascending, with low[a] and high[a]) at which alone the region changes: it is the same all along
    /// between two of them.
    std::array<std::vector<int>, D> planes;
};

namespace detail {

/// Widths of the layers of a region as the mean of the segments that cross them.
template <std::size_t D>
class LayerWidths {
public:
    explicit LayerWidths(const LogicalGrid<D>& grid) : low_(grid.low()) {
        for (std::size_t a = 0; a < D; ++a) {
            sum_[a].assign(static_cast<std::size_t>(grid.high()[a] - grid.low()[a]), 0.0);
            count_[a].assign(sum_[a].size(), 0.0);
        }
    }
    void add(std::size_t axis, int coordinate, double length) {
        const auto i = static_cast<std::size_t>(coordinate - low_[axis]);
        sum_[axis][i] += length;
        count_[axis][i] += 1.0;
    }
    /// Layers of no width take the mean of the others.
    [[nodiscard]] std::array<std::vector<double>, D> take() const {
        std::array<std::vector<double>, D> result;
        double all = 0.0, layers = 0.0;
        for (std::size_t a = 0; a < D; ++a) {
            for (std::size_t i = 0; i < sum_[a].size(); ++i) {
                result[a].push_back(count_[a][i] > 0.0 ? sum_[a][i] / count_[a][i] : 0.0);
                all += result[a].back();
                layers += 1.0;
            }
        }
        for (std::vector<double>& axis : result) {
            for (double& width : axis) {
                width = width > 0.0 ? width : all > 0.0 ? all / layers : 1.0;
            }
        }
        return result;
    }

private:
    LatticePoint<D> low_;
    std::array<std::vector<double>, D> sum_, count_;
};

/// The region seen on some of its lattice planes only, with one value a point.
template <std::size_t D, class P>
class LaplaceLevel {
public:
    /// \p kept per axis: coordinates kept, relative to the low corner.
    LaplaceLevel(const LogicalGrid<D>& grid, const LatticeLayers<D>& layers,
                 const std::array<std::vector<int>, D>& kept)
        : kept_(kept) {
        std::size_t points = 1;
        for (std::size_t a = 0; a < D; ++a) {
            stride_[a] = points;
            points *= kept_[a].size();
            for (std::size_t i = 0; i + 1 < kept_[a].size(); ++i) {
                double sum = 0.0;
                for (int c = kept_[a][i]; c < kept_[a][i + 1]; ++c) {
                    sum += layers.width[a][static_cast<std::size_t>(c)];
                }
                width_[a].push_back(sum);
            }
            for (std::size_t i = 0; i < kept_[a].size(); ++i) {
                const double before = i > 0 ? width_[a][i - 1] : 0.0;
                const double after = i + 1 < kept_[a].size() ? width_[a][i] : 0.0;
                dual_[a].push_back(0.5 * (before + after));
            }
        }
        x.assign(points, P::Zero());
        std::array<std::size_t, D> p{};
        for (std::size_t at = 0; at < points; ++at) {
            LatticePoint<D> fine;
            for (std::size_t a = 0; a < D; ++a) {
                fine[a] = grid.low()[a] + kept_[a][p[a]];
            }
            if (grid.inner(fine)) {
                free_.push_back(at);
                add_stencil(p);
            }
            for (std::size_t a = 0; a < D && ++p[a] == kept_[a].size(); ++a) {
                p[a] = 0;
            }
        }
    }

    /// Solves for the free values from those present, by conjugate gradients with Jacobi's preconditioner, until no
    /// value would move by more than \p tolerance in a Jacobi step.
    void solve(double tolerance, int max_iterations) {
        const std::size_t n = free_.size();
        std::vector<P> r(n), q(n), direction(x.size(), P::Zero());
        P rho = P::Zero();
        double step = 0.0;
        const auto restart = [&](auto&& fill) {
            P sum = P::Zero();
            step = 0.0;
            for (std::size_t i = 0; i < n; ++i) {
                fill(i);
                sum += r[i].cwiseAbs2() / diagonal_[i];
                step = std::max(step, r[i].cwiseAbs().maxCoeff() / diagonal_[i]);
            }
            return sum;
        };
        rho = restart([&](std::size_t i) { r[i] = -product(i, x); });
        for (std::size_t i = 0; i < n; ++i) {
            direction[free_[i]] = r[i] / diagonal_[i];
        }
        for (int k = 0; k < max_iterations && step > tolerance; ++k) {
            P curvature = P::Zero();
            for (std::size_t i = 0; i < n; ++i) {
                q[i] = product(i, direction);
                curvature += q[i].cwiseProduct(direction[free_[i]]);
            }
            const P alpha = quotient(rho, curvature);
            const P next = restart([&](std::size_t i) {
                x[free_[i]] += alpha.cwiseProduct(direction[free_[i]]);
                r[i] -= alpha.cwiseProduct(q[i]);
            });
            const P beta = quotient(next, rho);
            for (std::size_t i = 0; i < n; ++i) {
                direction[free_[i]] = r[i] / diagonal_[i] + beta.cwiseProduct(direction[free_[i]]);
            }
            rho = next;
        }
    }

    /// Free values interpolated from a level whose planes are some of these.
    void interpolate(const LaplaceLevel& coarse) {
        std::array<std::vector<std::size_t>, D> below;
        std::array<std::vector<double>, D> part;
        for (std::size_t a = 0; a < D; ++a) {
            double at = 0.0, from = 0.0;
            std::size_t c = 0;
            for (std::size_t i = 0; i < kept_[a].size(); ++i) {
                if (c + 2 < coarse.kept_[a].size() && kept_[a][i] >= coarse.kept_[a][c + 1]) {
                    from += coarse.width_[a][c++];
                }
                below[a].push_back(c);
                part[a].push_back((at - from) / coarse.width_[a][c]);
                at += i < width_[a].size() ? width_[a][i] : 0.0;
            }
        }
        for (const std::size_t at : free_) {
            P sum = P::Zero();
            for (std::size_t corner = 0; corner < (std::size_t{1} << D); ++corner) {
                double weight = 1.0;
                std::size_t from = 0;
                for (std::size_t a = 0; a < D; ++a) {
                    const std::size_t i = at / stride_[a] % kept_[a].size();
                    const bool upper = (corner >> a & 1U) != 0;
                    weight *= upper ? part[a][i] : 1.0 - part[a][i];
                    from += (below[a][i] + (upper ? 1 : 0)) * coarse.stride_[a];
                }
                if (weight > 1e-14) {
                    sum += weight * coarse.x[from];
                }
            }
            x[at] = sum;
        }
    }

    [[nodiscard]] std::size_t free_count() const { return free_.size(); }
    [[nodiscard]] const std::vector<std::size_t>& free() const { return free_; }
    /// Lattice point of position \p at, relative to the low corner.
    [[nodiscard]] LatticePoint<D> point(std::size_t at) const {
        LatticePoint<D> p;
        for (std::size_t a = 0; a < D; ++a) {
            p[a] = kept_[a][at / stride_[a] % kept_[a].size()];
        }
        return p;
    }

    std::vector<P> x;  ///< per point of the box

private:
    using Stencil = std::array<double, 2 * D>;

    [[nodiscard]] static P quotient(const P& a, const P& b) {
        P result = P::Zero();
        for (Eigen::Index c = 0; c < a.size(); ++c) {
            result[c] = b[c] > 0.0 ? a[c] / b[c] : 0.0;
        }
        return result;
    }

    /// Conductances to the neighbours before and after, axis by axis: area of the dual face over the distance.
    void add_stencil(const std::array<std::size_t, D>& p) {
        Stencil s;
        double volume = 1.0;
        for (std::size_t a = 0; a < D; ++a) {
            volume *= dual_[a][p[a]];
        }
        double sum = 0.0;
        for (std::size_t a = 0; a < D; ++a) {
            const double area = volume / dual_[a][p[a]];
            s[2 * a] = area / width_[a][p[a] - 1];
            s[2 * a + 1] = area / width_[a][p[a]];
            sum += s[2 * a] + s[2 * a + 1];
        }
        stencil_.push_back(s);
        diagonal_.push_back(sum);
    }

    [[nodiscard]] P product(std::size_t i, const std::vector<P>& v) const {
        const std::size_t at = free_[i];
        const Stencil& s = stencil_[i];
        P sum = diagonal_[i] * v[at];
        for (std::size_t a = 0; a < D; ++a) {
            sum -= s[2 * a] * v[at - stride_[a]] + s[2 * a + 1] * v[at + stride_[a]];
        }
        return sum;
    }

    std::array<std::vector<int>, D> kept_;
    std::array<std::size_t, D> stride_{};
    std::array<std::vector<double>, D> width_, dual_;
    std::vector<std::size_t> free_;  ///< positions of the inner nodes
    std::vector<Stencil> stencil_;
    std::vector<double> diagonal_;
};

/// The planes without every second one between any two of \p key; the same list if nothing can go.
[[nodiscard]] PAVIOR_INLINE std::vector<int> every_second(const std::vector<int>& kept, const std::vector<int>& key);

}  // namespace detail

/// Places the inner nodes of \p grid: each coordinate is discretely harmonic on the rectilinear grid with the widths of
/// \p layers, the nodes of the boundary given. Where the boundary is that of a rectilinear grid of these widths (moved,
/// turned or sheared), so are the inner nodes. Solved on ever finer lattices (cascadic multigrid), to about 1e-4 of the
/// smallest width. Elements may fold where the region is far from convex.
/// \tparam P a fixed-size Eigen vector, e.g. Vec3 or Vec2.
/// \param nodes one point per node of the grid, in and out: those on the boundary are read, the inner ones written.
/// O(lattice points of the bounding box); deterministic. \throws InputError size_mismatch, bad_option (a width that is
/// not positive, planes that do not start and end with the box).
template <std::size_t D, class P>
void place_inner_nodes(const LogicalGrid<D>& grid, const LatticeLayers<D>& layers, std::vector<P>& nodes) {
    std::array<std::vector<int>, D> key, kept;
    double smallest = std::numeric_limits<double>::infinity();
    if (nodes.size() != grid.node_count()) {
        throw InputError(ErrorCode::size_mismatch, "one point per node of the region is needed");
    }
    for (std::size_t a = 0; a < D; ++a) {
        const int extent = grid.high()[a] - grid.low()[a];
        if (layers.width[a].size() != static_cast<std::size_t>(extent)) {
            throw InputError(ErrorCode::size_mismatch, "one width per layer of the region is needed");
        }
        for (const double w : layers.width[a]) {
            if (!(w > 0.0) || !std::isfinite(w)) {
                throw InputError(ErrorCode::bad_option, "widths of layers must be positive");
            }
            smallest = std::min(smallest, w);
        }
        for (const int plane : layers.planes[a]) {
            key[a].push_back(plane - grid.low()[a]);
        }
        if (key[a].empty() || key[a].front() != 0 || key[a].back() != extent ||
            !std::is_sorted(key[a].begin(), key[a].end())) {
            throw InputError(ErrorCode::bad_option, "planes must ascend from one end of the region to the other");
        }
        for (int i = 0; i <= extent; ++i) {
            kept[a].push_back(i);
        }
    }
    std::vector<std::array<std::vector<int>, D>> levels{kept};
    for (bool coarser = true; coarser;) {
        std::array<std::vector<int>, D> next;
        coarser = false;
        for (std::size_t a = 0; a < D; ++a) {
            next[a] = detail::every_second(levels.back()[a], key[a]);
            coarser = coarser || next[a].size() < levels.back()[a].size();
        }
        if (coarser) {
            levels.push_back(std::move(next));
        }
    }
    using Level = detail::LaplaceLevel<D, P>;
    std::optional<Level> coarse;
    for (std::size_t l = levels.size(); l-- > 0;) {
        Level level(grid, layers, levels[l]);
        P sum = P::Zero();
        double count = 0.0;
        for (std::size_t at = 0; at < level.x.size(); ++at) {
            LatticePoint<D> p = level.point(at);
            for (std::size_t a = 0; a < D; ++a) {
                p[a] += grid.low()[a];
            }
            const Index node = grid.node(p);
            if (node != no_index && !grid.inner(p)) {
                level.x[at] = nodes[node];
                sum += nodes[node];
                count += 1.0;
            }
        }
        if (coarse) {
            level.interpolate(*coarse);
        } else {
            for (const std::size_t at : level.free()) {
                level.x[at] = sum / count;
            }
        }
        const bool first = !coarse;
        level.solve((first ? 1e-9 : 1e-4) * smallest, first ? 5000 : 200);
        coarse.emplace(std::move(level));
    }
    for (const std::size_t at : coarse->free()) {
        LatticePoint<D> p = coarse->point(at);
        for (std::size_t a = 0; a < D; ++a) {
            p[a] += grid.low()[a];
        }
        nodes[grid.node(p)] = coarse->x[at];
    }
}

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/lattice/grid_laplace-inl.hpp>
#endif
