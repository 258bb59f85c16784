#include "support/catch.hpp"
#include "support/tet_meshes.hpp"

#include <pavior/dual/spatial_order.hpp>

#include <algorithm>
#include <limits>
#include <numeric>
#include <random>

using namespace pavior;

namespace {
// Mean distance between tetrahedra that follow each other.
double jump(const TetMesh& mesh, const std::vector<Index>& order) {
    double sum = 0.0;
    for (std::size_t i = 1; i < order.size(); ++i) {
        sum += (mesh.nodes[mesh.tets[order[i]][0]] - mesh.nodes[mesh.tets[order[i - 1]][0]]).norm();
    }
    return sum / static_cast<double>(order.size());
}
}  // namespace

TEST_CASE("a permutation that keeps neighbours together") {
    TetMesh mesh = tet_meshes::tetrahedra(tet_meshes::box(12, 12, 12)).mesh;
    std::mt19937 random(3);
    std::shuffle(mesh.tets.begin(), mesh.tets.end(), random);
    std::vector<Index> order = spatial_order(mesh);
    std::vector<Index> given(order.size());
    std::iota(given.begin(), given.end(), Index{0});
    CHECK(jump(mesh, order) < 0.15 * jump(mesh, given));
    CHECK(order == spatial_order(archetype::Tets({mesh.nodes, mesh.tets, {}, {}, {}, {}, {}, {}})));
    std::sort(order.begin(), order.end());
    CHECK(order == given);
}

TEST_CASE("any scale and place; coordinates that are not finite; one place; nothing") {
    TetMesh mesh = tet_meshes::tetrahedra(tet_meshes::box(3, 2, 2)).mesh;
    const std::vector<Index> order = spatial_order(mesh);
    for (const double scale : {1e-200, 1e9, 1e200}) {
        TetMesh other = mesh;
        for (Vec3& x : other.nodes) {
            x = scale * x;
        }
        CHECK(spatial_order(other) == order);
    }
    mesh.nodes[4].y() = std::numeric_limits<double>::quiet_NaN();
    mesh.nodes[5].x() = std::numeric_limits<double>::infinity();
    CHECK(spatial_order(mesh).size() == mesh.tets.size());
    for (Vec3& x : mesh.nodes) {
        x = Vec3(1, 2, 3);
    }
    CHECK(spatial_order(mesh).size() == mesh.tets.size());
    CHECK(spatial_order(TetMesh{}).empty());
    mesh.tets[1][2] = 1000;
    CHECK_THROWS_AS(spatial_order(mesh), InputError);
}
