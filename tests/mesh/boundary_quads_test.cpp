#include "support/catch.hpp"
#include "support/foreign_meshes.hpp"
#include "support/shapes.hpp"

#include <pavior/math/quadrilateral.hpp>
#include <pavior/mesh/boundary_quads.hpp>

#include <vector>

using namespace pavior;

TEST_CASE("one hexahedron") {
    const std::vector<QuadCorners> wanted{{0, 2, 3, 1}, {0, 1, 5, 4}, {0, 4, 6, 2},
                                          {1, 3, 7, 5}, {2, 6, 7, 3}, {4, 5, 7, 6}};
    CHECK(boundary_quads(shapes::hex_box(1, 1, 1)) == wanted);
    CHECK(boundary_quads(archetype::Hexes(shapes::hex_box(1, 1, 1))) == wanted);
    CHECK(boundary_quads(HexMesh{}).empty());
}

TEST_CASE("the boundary of a box, outward, the same for any order of hexahedra and number of threads") {
    HexMesh mesh = shapes::hex_box(20, 21, 22, Vec3(2, 3, 4));
    const std::vector<QuadCorners> quads = boundary_quads(mesh);
    CHECK(quads.size() == 2 * (20 * 21 + 21 * 22 + 22 * 20));
    double volume = 0.0;
    for (const QuadCorners& q : quads) {
        volume += quad_flux({mesh.nodes[q[0]], mesh.nodes[q[1]], mesh.nodes[q[2]], mesh.nodes[q[3]]});
    }
    CHECK(volume == Approx(24.0));
    CHECK(boundary_quads(mesh, {3}) == quads);
    std::reverse(mesh.hexes.begin(), mesh.hexes.end());
    CHECK(boundary_quads(mesh) == quads);
}

TEST_CASE("what is no conforming mesh throws") {
    const auto code = [](const HexMesh& mesh, const Error::Ids& ids) {
        try {
            static_cast<void>(boundary_quads(mesh));
        } catch (const InputError& error) {
            CHECK(error.ids() == ids);
            return error.code();
        }
        return ErrorCode::overflow;
    };
    HexMesh mesh = shapes::hex_box(2, 1, 1);
    mesh.hexes[1][3] = 99;
    CHECK(code(mesh, {1}) == ErrorCode::bad_index);
    mesh = shapes::hex_box(2, 1, 1);
    mesh.hexes[1][3] = mesh.hexes[1][2];
    CHECK(code(mesh, {1}) == ErrorCode::bad_index);
    mesh = shapes::hex_box(2, 1, 1);
    mesh.nodes.resize(16, Vec3::Zero());
    mesh.hexes.push_back({1, 12, 13, 4, 7, 14, 15, 10});
    CHECK(code(mesh, {1, 4, 10, 7}) == ErrorCode::non_manifold);
    mesh = shapes::hex_box(2, 1, 1);
    const HexCorners c = mesh.hexes[1];
    mesh.hexes[1] = {c[4], c[5], c[6], c[7], c[0], c[1], c[2], c[3]};  // turned inside out
    CHECK(code(mesh, {1, 4, 10, 7}) == ErrorCode::bad_orientation);
}
