#include <pavior/sweep/sweep.hpp>

#include <array>
#include <cstdio>
#include <vector>

int main() {
    using Point = std::array<double, 3>;
    std::vector<Point> source, target;  // nine nodes a cap, the middle one raised; the target is wider
    for (const double y : {0, 1, 2})
        for (const double x : {0, 1, 2}) {
            source.push_back({x, y, x == 1 && y == 1 ? 0.3 : 0.0});
            target.push_back({1.5 * x, y, 3 + source.back()[2]});
        }
    const std::vector<std::array<int, 4>> quads{{0, 1, 4, 3}, {1, 2, 5, 4}, {3, 4, 7, 6}, {4, 5, 8, 7}};
    const pavior::QuadMeshView<Point, std::array<int, 4>> cap{source, quads};
    const pavior::Loops loops = pavior::boundary_loops(cap);
    std::vector<std::vector<Point>> levels(4);  // the boundary at levels 0 .. 3
    for (std::size_t k = 0; k < 4; ++k)
        for (const auto i : loops.nodes)
            levels[k].push_back({(1 + double(k) / 6) * source[i][0], source[i][1], double(k)});
    const auto [mesh, report] = pavior::sweep(cap, target, loops, levels);
    std::printf("%zu hexahedra, %zu nodes, middle of level 1 at z = %.2f\n", mesh.hex_count(), mesh.nodes().size(),
                mesh.level(1)[4].z());
}
