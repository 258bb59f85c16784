// What works on models, with one that has nothing but what the brep concept asks for.
#include "support/archetypes.hpp"
#include "support/catch.hpp"
#include "support/test_brep.hpp"

#include <pavior/brep/boundary_mesh.hpp>
#include <pavior/brep/chord_volume.hpp>
#include <pavior/brep/face_distance.hpp>
#include <pavior/brep/face_surface.hpp>
#include <pavior/brep/flat_face.hpp>
#include <pavior/brep/snap_to_faces.hpp>
#include <pavior/brep/solid_boundary.hpp>
#include <pavior/brep/touching_solids.hpp>

#include <vector>

using namespace pavior;
using namespace pavior::test;

static_assert(brep<archetype::Brep<TestBrep>>);

TEST_CASE("distances, volumes and closest points need nothing but the brep concept") {
    TestBrep b;
    const SolidId solid = add_prism(b, rectangle(3, 2), 0, 1);
    const archetype::Brep model(b);
    const std::vector<FaceId> faces{b.solid_faces(solid)[0].face, b.solid_faces(solid)[1].face};
    std::vector<Vec3> nodes{{0, 0, 0}, {3, 0, 0}, {3, 2, 0}, {0, 2, 0}, {0, 0, 1}, {3, 0, 1}, {3, 2, 1.25}, {0, 2, 1}};
    const std::vector<QuadCorners> quads{{0, 3, 2, 1}, {4, 5, 6, 7}};
    CHECK(face_distance(model, nodes, quads, faces).distance == Approx(0.25));
    CHECK(chord_volume(model, nodes, quads, faces) == chord_volume(b, nodes, quads, faces));
    CHECK(snap_to_faces(model, nodes, quads, faces, 0.5) == 0);
    CHECK(nodes[6].z() == Approx(1));
    const FaceSurface<archetype::Brep<TestBrep>> top{&model, faces[1]};
    CHECK((top.point(top.closest({1, 1, 7})) - Vec3(1, 1, 1)).norm() < 1e-12);
}

TEST_CASE("the topology of solids needs nothing but the brep concept") {
    TestBrep b;
    const std::vector<SolidId> solids = add_box_row(b, {0, 1, 3});
    const archetype::Brep model(b);
    CHECK(touching_solids(model, solids).size() == 1);
    CHECK(solid_boundary(model, solids[0]).half_edges.size() == 24);
    CHECK(flat_face(model, FaceId{0}, b.face_loops(FaceId{0})).start.at(0).size() == 4);
    CHECK(mesh_edges(model, std::vector<int>(b.edge_count(), 2)).nodes.size() == b.vertex_count() + b.edge_count());
}
