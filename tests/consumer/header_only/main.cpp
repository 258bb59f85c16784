// A program that knows pavior's headers and nothing else: a mesh type of its own, its boundary, and threads.
#include <pavior/core/execution.hpp>
#include <pavior/core/parallel_for.hpp>
#include <pavior/math/affine_map.hpp>
#include <pavior/mesh/boundary_loops.hpp>

#include <array>
#include <cstddef>
#include <cstdio>
#include <vector>

namespace {

struct Plate {
    std::vector<std::array<float, 3>> points;
    std::vector<std::array<int, 4>> cells;
};

}  // namespace

template <>
struct pavior::mesh_access<Plate> {
    static std::size_t node_count(const Plate& plate) { return plate.points.size(); }
    static const std::array<float, 3>& node(const Plate& plate, Index i) { return plate.points[i]; }
    static std::size_t quad_count(const Plate& plate) { return plate.cells.size(); }
    static const std::array<int, 4>& quad(const Plate& plate, Index q) { return plate.cells[q]; }
};

int main() {
    // Two quads side by side: the boundary runs round all six nodes.
    const Plate plate{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {1, 1, 0}, {2, 1, 0}}, {{0, 1, 4, 3}, {1, 2, 5, 4}}};
    const pavior::Loops loops = pavior::boundary_loops(plate);
    const bool boundary = loops.size() == 1 && loops.nodes == std::vector<pavior::Index>{0, 1, 2, 5, 4, 3};

    // Every node lifted by 5, on two threads.
    const pavior::AffineMap<> lift{Eigen::Matrix3d::Identity(), {0, 0, 0}, {0, 0, 5}};
    std::vector<double> heights(plate.points.size());
    pavior::parallel_for({2}, heights.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            heights[i] = lift(pavior::node(plate, static_cast<pavior::Index>(i))).z();
        }
    });
    const bool lifted = heights == std::vector<double>(6, 5.0);

    std::printf("boundary %d, lifted %d\n", boundary, lifted);
    return boundary && lifted ? 0 : 1;
}
