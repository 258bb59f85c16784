#include "support/catch.hpp"

#include <pavior/mesh/builders.hpp>
#include <pavior/mesh/mesh_check.hpp>

#include <utility>

using namespace pavior;

namespace {

HexMesh cube() {
    HexMesh mesh;
    for (const double z : {0, 1}) {
        for (const auto& [x, y] : {std::pair{0, 0}, std::pair{1, 0}, std::pair{1, 1}, std::pair{0, 1}}) {
            mesh.nodes.emplace_back(x, y, z);
        }
    }
    mesh.hexes.push_back({0, 1, 2, 3, 4, 5, 6, 7});
    return mesh;
}

}  // namespace

TEST_CASE("A cube passes, with its counts, volume and quality") {
    const MeshCheck check = check_mesh(cube());
    CHECK(check.valid());
    CHECK(check.nodes == 8);
    CHECK(check.hexahedra == 1);
    CHECK(check.verify.volume == Approx(1));
    CHECK(check.quality.scaled_jacobian.min == Approx(1));
}

TEST_CASE("An inverted cube conforms but is not valid") {
    HexMesh mesh = cube();
    std::swap(mesh.nodes[0], mesh.nodes[6]);
    const MeshCheck check = check_mesh(mesh);
    CHECK(check.quality.inverted == 1);
    CHECK_FALSE(check.valid());
}

TEST_CASE("Ids out of range are a fault, and nothing is read there") {
    HexMesh mesh = cube();
    mesh.hexes[0][3] = 8;
    const MeshCheck check = check_mesh(mesh);
    CHECK(check.verify.find(MeshFault::id_out_of_range) != nullptr);
    CHECK(check.quality.f_shape.count == 0);
    CHECK_FALSE(check.valid());
}
