#include "support/catch.hpp"
#include "support/grid_cap.hpp"
#include "support/test_brep.hpp"

#include <pavior/one_to_one/cap_boundary.hpp>

using namespace pavior;

static_assert(cap_mesher<test::GridCap<test::TestBrep>>);

TEST_CASE("the boundary of a cap lists each node once, loop by loop, with its parameters") {
    test::TestBrep b;
    test::add_cylinder(b, 2, 2, 1, 1);
    const BoundaryMesh mesh = mesh_edges(b, std::vector<int>(b.edge_count(), 8));
    const FaceId bottom = b.solid_faces(SolidId{0})[0].face;
    const CapBoundary boundary = cap_boundary(b, mesh, bottom);
    REQUIRE(boundary.offsets == std::vector<std::size_t>{0, 8, 16});
    for (std::size_t i = 0; i < 16; ++i) {
        CHECK(boundary.points[i] == mesh.nodes[boundary.ids[i]]);
        CHECK((b.face_point(bottom, boundary.uv[i]) - boundary.points[i]).norm() < 1e-12);
        CHECK(boundary.points[i].norm() == Approx(i < 8 ? 2.0 : 1.0));
    }
}

TEST_CASE("mesh_cap_face keeps the boundary nodes and adds the inner ones") {
    test::TestBrep b;
    test::add_prism(b, test::rectangle(1, 1), 0, 1);
    BoundaryMesh mesh = mesh_edges(b, std::vector<int>(b.edge_count(), 4));
    const std::size_t before = mesh.nodes.size();
    mesh_cap_face(b, mesh, FaceId{0}, test::GridCap<test::TestBrep>{&b});
    CHECK(mesh.nodes.size() == before + 9);
    CHECK(mesh.faces[0].quads.size() == 16);
    CHECK_FALSE(mesh.faces[0].structured());
    for (std::size_t i = 0; i < mesh.faces[0].nodes.size(); ++i) {
        CHECK((mesh.nodes[mesh.faces[0].nodes[i]] - b.face_point(FaceId{0}, mesh.faces[0].uv[i])).norm() < 1e-12);
    }
}
