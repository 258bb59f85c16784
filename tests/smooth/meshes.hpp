#pragma once
// Meshes for the tests of smoothing, and an independent look at what is inverted.

#include <pavior/math/point.hpp>
#include <pavior/mesh/cells.hpp>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <span>
#include <vector>

namespace pavior_test {

using pavior::HexCorners;
using pavior::Index;
using pavior::QuadCorners;
using pavior::Vec2;
using pavior::Vec3;

// The same numbers on every platform.
class Random {
public:
    explicit Random(unsigned seed) : engine_(seed) {}
    double operator()(double low, double high) {
        return low + (high - low) * static_cast<double>(engine_()) / 4294967296.0;
    }

private:
    std::mt19937 engine_;
};

struct QuadGrid {
    std::vector<Vec2> nodes;
    std::vector<QuadCorners> quads;
    std::vector<std::uint8_t> fixed;
};

struct HexGrid {
    std::vector<Vec3> nodes;
    std::vector<HexCorners> hexes;
    std::vector<std::uint8_t> fixed;
};

// nx by ny unit squares, the boundary fixed; node (i, j) is i + (nx + 1) j.
inline QuadGrid quad_grid(Index nx, Index ny) {
    QuadGrid grid;
    for (Index j = 0; j <= ny; ++j) {
        for (Index i = 0; i <= nx; ++i) {
            grid.nodes.push_back({static_cast<double>(i), static_cast<double>(j)});
            grid.fixed.push_back(i == 0 || j == 0 || i == nx || j == ny ? 1 : 0);
            if (i < nx && j < ny) {
                const Index a = i + (nx + 1) * j;
                grid.quads.push_back({a, a + 1, a + nx + 2, a + nx + 1});
            }
        }
    }
    return grid;
}

// nx by ny by nz unit cubes, the boundary fixed.
inline HexGrid hex_grid(Index nx, Index ny, Index nz) {
    HexGrid grid;
    const Index row = nx + 1;
    const Index layer = row * (ny + 1);
    for (Index k = 0; k <= nz; ++k) {
        for (Index j = 0; j <= ny; ++j) {
            for (Index i = 0; i <= nx; ++i) {
                grid.nodes.push_back({static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)});
                grid.fixed.push_back(i == 0 || j == 0 || k == 0 || i == nx || j == ny || k == nz ? 1 : 0);
                if (i < nx && j < ny && k < nz) {
                    const Index a = i + row * j + layer * k;
                    grid.hexes.push_back({a, a + 1, a + row + 1, a + row, a + layer, a + layer + 1, a + layer + row + 1,
                                          a + layer + row});
                }
            }
        }
    }
    return grid;
}

// A disc: a square of n x n quads in the middle, 4 n quads in each of `rings` rings round it; the circle is fixed.
inline QuadGrid disc(Index n, Index rings) {
    QuadGrid grid = quad_grid(n, n);
    const double half = 0.5 * static_cast<double>(n);
    for (Vec2& x : grid.nodes) {
        x = (x - Vec2(half, half)) / half * 0.4;
    }
    std::vector<Index> rim;
    const Index m = n + 1;
    for (Index i = 0; i < n; ++i)
        rim.push_back(i);
    for (Index j = 0; j < n; ++j)
        rim.push_back(n + m * j);
    for (Index i = n; i > 0; --i)
        rim.push_back(i + m * n);
    for (Index j = n; j > 0; --j)
        rim.push_back(m * j);
    grid.fixed.assign(grid.nodes.size(), 0);
    std::vector<Index> last = rim;
    for (Index ring = 1; ring <= rings; ++ring) {
        std::vector<Index> next;
        const double t = static_cast<double>(ring) / static_cast<double>(rings);
        for (const Index i : rim) {
            const Vec2 inner = grid.nodes[i];
            next.push_back(static_cast<Index>(grid.nodes.size()));
            grid.nodes.push_back((1.0 - t) * inner + t * inner.normalized());
            grid.fixed.push_back(ring == rings ? 1 : 0);
        }
        for (std::size_t k = 0; k < rim.size(); ++k) {
            const std::size_t l = (k + 1) % rim.size();
            grid.quads.push_back({last[k], next[k], next[l], last[l]});
        }
        last = next;
    }
    return grid;
}

// Straight from the definition: a corner whose edges do not span a positive area.
inline bool inverted(std::span<const Vec2> x, const QuadCorners& q) {
    for (std::size_t k = 0; k < 4; ++k) {
        const Vec2 a = x[q[(k + 1) % 4]] - x[q[k]];
        const Vec2 b = x[q[(k + 3) % 4]] - x[q[k]];
        if (!(a.x() * b.y() - a.y() * b.x() > 0.0)) {
            return true;
        }
    }
    return false;
}

// det of the trilinear map on a lattice of (n + 1)^3 points.
inline double lattice_min_det(std::span<const Vec3> x, const HexCorners& h, int n) {
    double least = INFINITY;
    for (int code = 0; code < (n + 1) * (n + 1) * (n + 1); ++code) {
        const double u = static_cast<double>(code % (n + 1)) / n;
        const double v = static_cast<double>(code / (n + 1) % (n + 1)) / n;
        const double w = static_cast<double>(code / (n + 1) / (n + 1)) / n;
        const auto mix = [&](std::array<Vec3, 4> d, double s, double t) {
            return Vec3((1 - s) * (1 - t) * d[0] + s * (1 - t) * d[1] + (1 - s) * t * d[2] + s * t * d[3]);
        };
        Eigen::Matrix3d J;
        J << mix({x[h[1]] - x[h[0]], x[h[2]] - x[h[3]], x[h[5]] - x[h[4]], x[h[6]] - x[h[7]]}, v, w),
            mix({x[h[3]] - x[h[0]], x[h[2]] - x[h[1]], x[h[7]] - x[h[4]], x[h[6]] - x[h[5]]}, u, w),
            mix({x[h[4]] - x[h[0]], x[h[5]] - x[h[1]], x[h[7]] - x[h[3]], x[h[6]] - x[h[2]]}, u, v);
        least = std::min(least, J.determinant());
    }
    return least;
}

inline std::size_t count_inverted(std::span<const Vec2> nodes, std::span<const QuadCorners> quads) {
    std::size_t count = 0;
    for (const QuadCorners& q : quads) {
        count += inverted(nodes, q) ? 1U : 0U;
    }
    return count;
}

inline std::size_t count_inverted(std::span<const Vec3> nodes, std::span<const HexCorners> hexes, int n = 2) {
    std::size_t count = 0;
    for (const HexCorners& h : hexes) {
        count += lattice_min_det(nodes, h, n) > 0.0 ? 0U : 1U;
    }
    return count;
}

// Moves every node that is not fixed by up to `amount` in each direction.
template <class Grid>
void shake(Grid& grid, double amount, unsigned seed) {
    Random random(seed);
    for (std::size_t i = 0; i < grid.nodes.size(); ++i) {
        for (Eigen::Index d = 0; d < grid.nodes[i].size() && grid.fixed[i] == 0; ++d) {
            grid.nodes[i][d] += random(-amount, amount);
        }
    }
}

template <class Grid>
bool fixed_kept(const Grid& before, const Grid& after) {
    for (std::size_t i = 0; i < before.nodes.size(); ++i) {
        if (before.fixed[i] != 0 && before.nodes[i] != after.nodes[i]) {
            return false;
        }
    }
    return true;
}

}  // namespace pavior_test
