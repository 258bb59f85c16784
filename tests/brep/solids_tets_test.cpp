#include "support/catch.hpp"
#include "support/model_tets.hpp"

#include <pavior/brep/solids_tets.hpp>
#include <pavior/mesh/verify_tets.hpp>

#include <algorithm>

using namespace pavior;
using namespace pavior::test;

TEST_CASE("Tetrahedra of two boxes: faces, edges and vertices of the model by their ids, the wall once") {
    TestBrep b;
    const std::vector<SolidId> row = add_box_row(b, {0, 1, 3});
    const SolidsTets made = box_row_tets(b, {0, 1, 3}, 2);
    CHECK(verify_tets(made.tets.mesh).ok());
    REQUIRE(made.tet_solid.size() == made.tets.mesh.tets.size());
    CHECK(std::count(made.tet_solid.begin(), made.tet_solid.end(), row[1]) == 48);
    const std::int32_t wall = b.solid_faces(row[0])[1].face.value;
    CHECK(std::count_if(made.tets.triangles.begin(), made.tets.triangles.end(),
                        [&](const TaggedTriangle& t) { return t.tag == wall; }) == 8);
    CHECK(made.tets.triangles.size() == 11 * 8);
    CHECK(made.tets.edges.size() == 20 * 2);
    CHECK(made.tets.vertices.size() == 12);
    for (const TaggedTriangle& t : made.tets.triangles) {
        const auto& x = made.tets.mesh.nodes;
        const Vec3 middle = (x[t.nodes[0]] + x[t.nodes[1]] + x[t.nodes[2]]) / 3.0;
        const FaceId f{t.tag};
        CHECK((b.face_point(f, b.closest_on_face(f, middle)) - middle).norm() < 1e-12);
    }
    for (const TaggedNode& v : made.tets.vertices) {
        CHECK((b.vertex_point(VertexId{v.tag}) - made.tets.mesh.nodes[v.node]).norm() < 1e-12);
    }
}
