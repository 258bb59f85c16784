#pragma once
// A cap mesher for tests: one loop, seen as four sides, filled by transfinite interpolation in the parameter plane.

#include <pavior/brep/face_surface.hpp>
#include <pavior/one_to_one/cap_boundary.hpp>
#include <pavior/sweep/transfinite.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace pavior::test {

/// First nodes of the four sides: the sharp corners if there are four, else every quarter.
inline std::array<std::size_t, 4> four_corners(const std::vector<Vec2>& uv) {
    const std::size_t m = uv.size();
    std::vector<std::size_t> sharp;
    for (std::size_t i = 0; i < m; ++i) {
        const Vec2 in = uv[i] - uv[(i + m - 1) % m];
        const Vec2 out = uv[(i + 1) % m] - uv[i];
        if (in.dot(out) < 0.7 * in.norm() * out.norm()) {
            sharp.push_back(i);
        }
    }
    if (sharp.size() == 4) {
        return {sharp[0], sharp[1], sharp[2], sharp[3]};
    }
    return {0, m / 4, m / 2, 3 * m / 4};
}

/// Makes CapMesh by transfinite interpolation. The loop may have any number of nodes whose opposite sides agree.
template <brep B>
struct GridCap {
    const B* model;

    CapMesh operator()(FaceId face, const CapBoundary& boundary) const {
        if (boundary.offsets.size() != 2) {
            throw std::logic_error("GridCap takes one loop");
        }
        const std::size_t m = boundary.ids.size();
        const auto corner = four_corners(boundary.uv);
        std::array<std::vector<std::size_t>, 4> side;
        for (std::size_t s = 0; s < 4; ++s) {
            for (std::size_t i = corner[s];; i = (i + 1) % m) {
                side[s].push_back(i);
                if (i == corner[(s + 1) % 4]) {
                    break;
                }
            }
        }
        std::reverse(side[2].begin(), side[2].end());
        std::reverse(side[3].begin(), side[3].end());
        std::array<std::vector<Vec2>, 4> uv;
        for (std::size_t s = 0; s < 4; ++s) {
            for (const std::size_t i : side[s]) {
                uv[s].push_back(boundary.uv[i]);
            }
        }
        const StructuredGrid<Vec2> grid = transfinite(GridSides<Vec2>{uv[0], uv[2], uv[3], uv[1]});
        CapMesh cap{boundary.points, boundary.uv, {}};
        std::vector<Index> number(grid.nodes.size());
        for (std::size_t k = 0; k <= grid.rows; ++k) {
            for (std::size_t i = 0; i <= grid.columns; ++i) {
                Index& id = number[grid.index(i, k)];
                if (k == 0 || k == grid.rows) {
                    id = static_cast<Index>(side[k == 0 ? 0 : 2][i]);
                } else if (i == 0 || i == grid.columns) {
                    id = static_cast<Index>(side[i == 0 ? 3 : 1][k]);
                } else {
                    id = static_cast<Index>(cap.nodes.size());
                    cap.nodes.push_back(model->face_point(face, grid(i, k)));
                    cap.uv.push_back(grid(i, k));
                }
            }
        }
        for (QuadCorners quad : structured_quads(grid.columns, grid.rows)) {
            for (Index& id : quad) {
                id = number[id];
            }
            cap.quads.push_back(quad);
        }
        return cap;
    }
};

}  // namespace pavior::test
