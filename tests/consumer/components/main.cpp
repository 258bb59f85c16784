// A program that links the compiled components: an integer program, a mesh file, a decomposition, tetrahedra, an
// arrangement.
#include <pavior/glpk/solve_program.hpp>
#include <pavior/imprint/imprint.hpp>
#include <pavior/io/mesh_file.hpp>
#include <pavior/math/small_svd.hpp>
#include <pavior/tetra/tetrahedralize.hpp>

#include <array>
#include <cstdio>

int main() {
    // glpk: x + y >= 5 with costs 2 and 3 is cheapest at x = 4 (its bound), y = 1.
    pavior::IntegerProgram program;
    const auto x = program.add({.lower = 0, .upper = 4, .cost = 2, .integer = true, .name = "x"});
    const auto y = program.add({.lower = 0, .upper = 9, .cost = 3, .integer = true, .name = "y"});
    program.rows.push_back({.lower = 5, .upper = pavior::no_bound, .terms = {{x, 1.0}, {y, 1.0}}, .name = "sum"});
    const pavior::IntegerSolution solution = pavior::solve(program);
    const bool solved = solution.found() && solution.values == std::vector<double>{4.0, 1.0};

    // io: a cube written and read back.
    pavior::HexMeshData cube;
    for (const double z : {0.0, 1.0}) {
        for (const auto& [u, v] : {std::array{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}}) {
            cube.mesh.nodes.emplace_back(u, v, z);
        }
    }
    cube.mesh.hexes.push_back({0, 1, 2, 3, 4, 5, 6, 7});
    bool same = true;
    for (const char* file : {"cube.vtu", "cube.msh"}) {
        pavior::write_mesh(file, cube);
        const pavior::HexMeshData copy = pavior::read_mesh(file);
        same = same && copy.mesh.nodes == cube.mesh.nodes && copy.mesh.hexes == cube.mesh.hexes;
    }

    // compiled: the decomposition of a matrix with the singular values 5, 3, 2.
    const pavior::SmallSvd<double, 3, 3> svd = pavior::small_svd<double, 3, 3>(Eigen::Vector3d(2, -5, 3).asDiagonal());
    const double error = (svd.w - Eigen::Vector3d(5, 3, 2)).norm();

    // tetra: a tetrahedron is filled with itself.
    pavior::TaggedSurface surface;
    surface.mesh.nodes = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    surface.mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
    const bool filled = pavior::tetrahedralize(surface).mesh.tets.size() == 1;

    // imprint: two lines cross in one point and make four edges.
    pavior::PlaneCurves cross;
    cross.add(std::array{pavior::Vec2(-1, 0), pavior::Vec2(1, 0)});
    cross.add(std::array{pavior::Vec2(0, -1), pavior::Vec2(0, 1)});
    const bool crossed = pavior::imprint(cross, {1e-9, {}}).edges.size() == 4;

    std::printf("integer program %d, files %d, error %.1e, filled %d, crossed %d\n", solved, same, error, filled,
                crossed);
    return solved && same && filled && crossed && error < 1e-14 ? 0 : 1;
}
