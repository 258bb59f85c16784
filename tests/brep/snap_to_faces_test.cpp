#include <pavior/brep/snap_to_faces.hpp>
#include <pavior/core/error.hpp>

#include "support/catch.hpp"
#include "support/test_brep.hpp"

#include <vector>

using namespace pavior;
using namespace pavior::test;

TEST_CASE("boundary nodes are moved onto all of their faces, unless they would move too far") {
    TestBrep b;
    const SolidId solid = add_cylinder(b, 1, 1, 2);
    FaceId bottom;
    FaceId wall;
    for (const OrientedFace& f : b.solid_faces(solid)) {
        const bool low = b.face_point(f.face, b.closest_on_face(f.face, Vec3(0.1, 0, 0))).norm() < 0.2;
        const bool round = b.face_loops(f.face)[0].size() == 4 || b.face_loops(f.face).size() == 2;
        (round ? wall : low ? bottom : wall) = round || low ? f.face : wall;
    }
    // one quad on the bottom, one on the wall, an edge on the circle between them
    std::vector<Vec3> nodes{{0.1, 0, 0.01},     {0, 0.1, 0},   {1.01, 0, -0.01}, {0, 1.02, 0.005},
                            {1.005, 0.01, 0.5}, {0, 0.5, 0.5}, {7, 7, 7}};
    const std::vector<Vec3> before = nodes;
    const std::vector<QuadCorners> quads{{0, 1, 3, 2}, {2, 3, 5, 4}};
    const std::vector<FaceId> faces{bottom, wall};
    CHECK(snap_to_faces(b, nodes, quads, faces, 0.1) == 1);
    CHECK((nodes[0] - Vec3(0.1, 0, 0)).norm() < 1e-9);
    CHECK((nodes[1] - before[1]).norm() < 1e-12);
    CHECK((nodes[2] - Vec3(1, 0, 0)).norm() < 1e-9);
    CHECK((nodes[3] - Vec3(0, 1, 0)).norm() < 1e-9);
    CHECK(nodes[4].head<2>().norm() == Approx(1).epsilon(1e-12));
    CHECK(nodes[5] == before[5]);  // half a radius inside
    CHECK(nodes[6] == before[6]);  // of no quad
    CHECK_THROWS_AS(snap_to_faces(b, nodes, quads, std::span(faces).first(1), 0.1), InputError);
}
