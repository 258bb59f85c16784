#pragma once
// Meshes of sweeps and of a part with several caps, with their quality.

#include <pavior/core/index.hpp>
#include <pavior/math/hexahedron.hpp>
#include <pavior/math/point.hpp>

#include "smooth/meshes.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

namespace pavior_test {

using pavior::HexPoints;
using pavior::no_index;

inline double quality(const HexGrid& grid, const HexCorners& h) {
    HexPoints points;
    for (std::size_t k = 0; k < 8; ++k) {
        points[k] = grid.nodes[h[k]];
    }
    return pavior::hex_scaled_jacobian(points);
}

inline std::vector<double> sorted_quality(const HexGrid& grid) {
    std::vector<double> all;
    for (const HexCorners& h : grid.hexes) {
        all.push_back(quality(grid, h));
    }
    std::sort(all.begin(), all.end());
    return all;
}

inline double least(const HexGrid& grid) { return sorted_quality(grid).front(); }

// A square column that turns by 60 degrees and bends by 90.
inline HexGrid twisted_sweep(Index n, Index layers) {
    HexGrid grid = hex_grid(n, n, layers);
    for (Vec3& x : grid.nodes) {
        const double t = x.z() / layers;
        const Vec2 p =
            Eigen::Rotation2Dd(std::numbers::pi / 3 * t) * Vec2(2.0 * x.x() / n - 1.0, 2.0 * x.y() / n - 1.0);
        const double a = 0.5 * std::numbers::pi * t;
        x = Vec3((3.5 + p.x()) * std::cos(a), p.y(), (3.5 + p.x()) * std::sin(a));
    }
    return grid;
}

// A sweep between two caps with different bumps, whose sections shear and taper on the way.
inline HexGrid sweep_between_unlike_caps(Index n, Index layers) {
    HexGrid grid = hex_grid(n, n, layers);
    for (Vec3& x : grid.nodes) {
        const double t = x.z() / layers;
        const double u = 2.0 * x.x() / n - 1.0;
        const double v = 2.0 * x.y() / n - 1.0;
        const double bump = std::cos(1.57 * u) * std::cos(1.57 * v);
        x = Vec3(u * (1.0 + 0.3 * t * v * v) + 0.4 * t * t, v * (1.0 - 0.3 * t * u * u),
                 2.0 * t + 0.3 * (1.0 - t) * u * u - 0.35 * t * v * v + 0.3 * (t - 0.3) * bump * bump);
    }
    return grid;
}

// Cells of a grid that `keep` wants, without unused nodes; the boundary is fixed.
template <class Keep>
HexGrid part_of_grid(Index nx, Index ny, Index nz, const Keep& keep) {
    const HexGrid full = hex_grid(nx, ny, nz);
    HexGrid part;
    std::vector<Index> id(full.nodes.size(), no_index);
    std::vector<int> uses(full.nodes.size(), 0);
    for (const HexCorners& h : full.hexes) {
        if (!keep(full.nodes[h[0]])) {
            continue;
        }
        HexCorners corners = h;
        for (Index& i : corners) {
            ++uses[i];
            if (id[i] == no_index) {
                id[i] = static_cast<Index>(part.nodes.size());
                part.nodes.push_back(full.nodes[i]);
            }
            i = id[i];
        }
        part.hexes.push_back(corners);
    }
    part.fixed.resize(part.nodes.size());
    for (std::size_t i = 0; i < id.size(); ++i) {
        if (id[i] != no_index) {
            part.fixed[id[i]] = uses[i] < 8 ? 1 : 0;
        }
    }
    return part;
}

// Several sources and targets: a plate with a boss, a step, a slot from below and a hole, sheared and stretched.
inline HexGrid many_to_many_part() {
    HexGrid grid = part_of_grid(12, 9, 9, [](const Vec3& x) {
        const bool plate = x.z() >= 2 && x.z() < 6 && !(x.x() >= 4 && x.x() < 6 && x.y() >= 3 && x.y() < 6);
        const bool boss = x.z() >= 6 && x.x() >= 7;
        const bool foot = x.z() < 2 && (x.y() < 3 || x.y() >= 6);
        return plate || boss || foot;
    });
    for (Vec3& x : grid.nodes) {
        x = Vec3(1.2 * x.x() + 0.25 * x.y() + 0.02 * x.z() * x.z(), 0.9 * x.y(), 0.7 * x.z() + 0.01 * x.x() * x.y());
    }
    return grid;
}

}  // namespace pavior_test
