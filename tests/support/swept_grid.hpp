#pragma once
// Sweep problems on a square grid, with or without a square hole.
#include <pavior/mesh/boundary_loops.hpp>
#include <pavior/mesh/span_mesh.hpp>
#include <pavior/sweep/problem.hpp>

#include <Eigen/Geometry>

#include <cmath>
#include <functional>
#include <random>
#include <vector>

namespace pavior::test {

// Place of the point (x, y) of the unit square [-1, 1]^2 at t in [0, 1] along the sweep.
using Place = std::function<Vec3(double x, double y, double t)>;

inline Place straight(double length = 2.0) {
    return [=](double x, double y, double t) { return Vec3(x, y, length * t); };
}
// Sections turn, shrink and tilt: affine images of each other.
inline Place twisted() {
    return [](double x, double y, double t) {
        const double angle = 0.7 * t;
        const double size = 1.0 - 0.3 * t;
        const Vec3 flat(size * (std::cos(angle) * x - std::sin(angle) * y),
                        size * (std::sin(angle) * x + std::cos(angle) * y), 0);
        return Vec3(Eigen::AngleAxisd(0.5 * t, Vec3(1, 0.3, 0).normalized()) * flat +
                    Vec3(0.4 * t * t, 0.2 * t, 3 * t));
    };
}
// Square to a curved, unsymmetric section that leaves its plane: not affine.
inline Place warped() {
    return [](double x, double y, double t) {
        return Vec3(x + 0.2 * t * x * y + 0.3 * t, y + 0.25 * t * (1 - x * x) + 0.1 * t * y * y,
                    2.5 * t + 0.15 * std::sin(3 * t) * x * x - 0.1 * t * y * x);
    };
}

struct GridOptions {
    Index cells = 6;  // per side
    Index hole = 0;   // cells per side of a hole in the middle
    std::size_t layers = 4;
    double bump = 0.3;  // offset of the middle of the caps
};

inline QuadMesh square_grid(const GridOptions& options) {
    const Index n = options.cells;
    const Index first = (n - options.hole) / 2;
    const Index last = first + options.hole;
    std::vector<Index> id((n + 1) * (n + 1), 0);
    QuadMesh mesh;
    for (Index j = 0; j <= n; ++j) {
        for (Index i = 0; i <= n; ++i) {
            const bool removed = i > first && i < last && j > first && j < last;
            id[j * (n + 1) + i] = static_cast<Index>(mesh.nodes.size());
            if (!removed) {
                mesh.nodes.emplace_back(2.0 * i / n - 1.0, 2.0 * j / n - 1.0, 0.0);
            }
        }
    }
    for (Index j = 0; j < n; ++j) {
        for (Index i = 0; i < n; ++i) {
            if (!(i >= first && i < last && j >= first && j < last)) {
                const Index a = j * (n + 1) + i;
                mesh.quads.push_back({id[a], id[a + 1], id[a + n + 2], id[a + n + 1]});
            }
        }
    }
    return mesh;
}

inline SweepProblem grid_problem(const Place& place, const GridOptions& options = {}) {
    const QuadMesh plane = square_grid(options);
    const Loops loops = boundary_loops(plane);
    const auto cap = [&](double t, double height) {
        std::vector<Vec3> nodes;
        for (const Vec3& p : plane.nodes) {
            const double bump = std::cos(std::acos(-1.0) * p[0] / 2) * std::cos(std::acos(-1.0) * p[1] / 2);
            nodes.push_back(place(p[0], p[1], t) + Vec3(0, 0, height * bump));
        }
        // Loop nodes lie exactly where the levels put them.
        for (const Index i : loops.nodes) {
            nodes[i] = place(plane.nodes[i][0], plane.nodes[i][1], t);
        }
        return nodes;
    };
    std::vector<std::vector<Vec3>> levels(options.layers + 1);
    for (std::size_t k = 0; k <= options.layers; ++k) {
        for (const Index i : loops.nodes) {
            levels[k].push_back(place(plane.nodes[i][0], plane.nodes[i][1],
                                      static_cast<double>(k) / static_cast<double>(options.layers)));
        }
    }
    const QuadMesh source{cap(0, -options.bump), plane.quads};
    return make_sweep_problem(source, cap(1, options.bump), loops, levels);
}

// The problem with every point moved by \p move.
template <class Move>
SweepProblem moved(SweepProblem problem, const Move& move) {
    for (auto* points : {&problem.source_nodes, &problem.target_nodes, &problem.boundary_levels}) {
        for (Vec3& x : *points) {
            x = move(x);
        }
    }
    return problem;
}

// Noise of at most eps per coordinate on all points; loop nodes of the caps stay those of the levels.
inline SweepProblem noisy(SweepProblem problem, double eps, unsigned seed) {
    std::mt19937 generator(seed);
    std::uniform_real_distribution<double> noise(-eps, eps);
    problem = moved(std::move(problem), [&](const Vec3& x) {
        return Vec3(x + Vec3(noise(generator), noise(generator), noise(generator)));
    });
    for (std::size_t i = 0; i < problem.loops.nodes.size(); ++i) {
        problem.source_nodes[problem.loops.nodes[i]] = problem.level(0)[i];
        problem.target_nodes[problem.loops.nodes[i]] = problem.level(problem.layers)[i];
    }
    return problem;
}

}  // namespace pavior::test
