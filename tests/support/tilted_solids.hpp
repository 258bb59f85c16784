#pragma once
// Random solids with tilted faces: the cells of random orthogonal ones between planes that are tilted one by one, and
// Ts whose four flanks are tilted. The blocks are those of the upright solids.

#include "support/random_solids.hpp"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pavior::test {

/// A surface and the blocks that its solid has.
struct CountedSolid {
    TaggedSurface surface;
    BlockCount want;
};

namespace detail {

struct TiltedPlane {
    Vec3 normal{0, 0, 1};
    double offset = 0;
};

/// Unit vector \p axis turned by up to \p degrees.
[[nodiscard]] inline Vec3 tilted(Random& random, std::size_t axis, double degrees) {
    Vec3 n = Vec3::Unit(static_cast<Eigen::Index>(axis));
    const double angle = random(0, 2 * std::numbers::pi);
    const Vec3 u = n.unitOrthogonal();
    const double tilt = std::tan(random(0.3, 1) * degrees * std::numbers::pi / 180);
    n += tilt * (std::cos(angle) * u + std::sin(angle) * n.cross(u));
    return n.normalized();
}

[[nodiscard]] inline Vec3 meet(const TiltedPlane& a, const TiltedPlane& b, const TiltedPlane& c) {
    Eigen::Matrix3d m;
    m << a.normal.transpose(), b.normal.transpose(), c.normal.transpose();
    return m.partialPivLu().solve(Vec3(a.offset, b.offset, c.offset));
}

/// Lattice points of tilted planes; true if no cell of the lattice is badly distorted.
struct TiltedLattice {
    std::array<int, 3> size{1, 1, 1};
    std::array<std::vector<TiltedPlane>, 3> planes;

    [[nodiscard]] Vec3 point(std::array<int, 3> g) const {
        return meet(planes[0][static_cast<std::size_t>(g[0])], planes[1][static_cast<std::size_t>(g[1])],
                    planes[2][static_cast<std::size_t>(g[2])]);
    }
    [[nodiscard]] bool sound() const {
        for (int z = 0; z < size[2]; ++z) {
            for (int y = 0; y < size[1]; ++y) {
                for (int x = 0; x < size[0]; ++x) {
                    for (int k = 0; k < 8; ++k) {
                        const std::array<int, 3> c{x + (k & 1), y + ((k >> 1) & 1), z + ((k >> 2) & 1)};
                        Eigen::Matrix3d d;
                        for (std::size_t axis = 0; axis < 3; ++axis) {
                            std::array<int, 3> other = c;
                            const bool low = (k >> axis & 1) == 0;
                            other[axis] += low ? 1 : -1;
                            const Vec3 edge = (point(other) - point(c)) * (low ? 1 : -1);
                            if (edge.norm() < 0.25) {
                                return false;
                            }
                            d.col(static_cast<Eigen::Index>(axis)) = edge.normalized();
                        }
                        if (d.determinant() < 0.5) {
                            return false;
                        }
                    }
                }
            }
        }
        return true;
    }
};

}  // namespace detail

/// Cells of a random orthogonal solid between planes each of which is tilted by up to \p degrees, less where they would
/// meet.
[[nodiscard]] inline CountedSolid tilted_voxels(Random& random, int most, double degrees) {
    const VoxelSolid solid = random_voxels(random, most);
    detail::TiltedLattice lattice{solid.size, {}};
    do {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const std::vector<double>& lines = solid.lines[axis];
            lattice.planes[axis].clear();
            for (const double line : lines) {
                const Vec3 n = detail::tilted(random, axis, degrees);
                Vec3 through(0.5 * solid.lines[0].back(), 0.5 * solid.lines[1].back(), 0.5 * solid.lines[2].back());
                through[static_cast<Eigen::Index>(axis)] = line;
                lattice.planes[axis].push_back({n, n.dot(through)});
            }
        }
        degrees *= 0.95;
    } while (!lattice.sound());
    CountedSolid out{voxel_surface(solid), count_blocks(solid)};
    const auto line = [&](std::size_t axis, double at) {
        const std::vector<double>& lines = solid.lines[axis];
        return static_cast<int>(std::find(lines.begin(), lines.end(), at) - lines.begin());
    };
    for (Vec3& x : out.surface.mesh.nodes) {
        x = lattice.point({line(0, x[0]), line(1, x[1]), line(2, x[2])});
    }
    return out;
}

/// A bar on a stem. The stem's flanks and the two flanks under the bar are planes tilted by up to \p degrees, so that
/// those under the bar are on no one plane. Four boxes: two of the bar beside the stem, one above it, and the stem.
[[nodiscard]] inline CountedSolid tilted_t(Random& random, double degrees) {
    VoxelSolid solid;
    solid.size = {3, 1, 2};
    solid.filled = {0, 1, 0, 1, 1, 1};
    solid.lines = {std::vector<double>{0, random(0.8, 1.2), random(2.0, 2.4), random(3.2, 3.6)},
                   std::vector<double>{0, random(0.8, 1.4)},
                   std::vector<double>{0, random(1.0, 1.4), random(2.2, 2.8)}};
    CountedSolid out{voxel_surface(solid), {32, 81}};
    const double x0 = solid.lines[0][1];
    const double x1 = solid.lines[0][2];
    const double z = solid.lines[2][1];
    const double limit = std::tan(degrees * std::numbers::pi / 180);
    double left = 0;
    double right = 0;
    do {  // parallel ones at two levels would be two sheets
        left = random(-limit, limit);
        right = random(-limit, limit);
    } while (std::abs(left + right) < 0.05);
    for (Vec3& p : out.surface.mesh.nodes) {  // the undersides rise or fall outwards; the flanks lean
        const double level = p[2];
        if (level == z && p[0] < x0) {
            p[2] += left * (x0 - p[0]);
        } else if (level == z && p[0] > x1) {
            p[2] += right * (p[0] - x1);
        }
    }
    const double lean0 = random(-limit, limit);
    const double lean1 = random(-limit, limit);
    for (Vec3& p : out.surface.mesh.nodes) {
        if (p[2] < z && (p[0] == x0 || p[0] == x1)) {
            p[0] += (p[0] == x0 ? lean0 : lean1) * (z - p[2]);
        }
    }
    return out;
}

}  // namespace pavior::test
