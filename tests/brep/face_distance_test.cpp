#include <pavior/brep/face_distance.hpp>
#include <pavior/core/error.hpp>

#include "support/catch.hpp"
#include "support/test_brep.hpp"

#include <vector>

using namespace pavior;
using namespace pavior::test;

TEST_CASE("The boundary node farthest from its face is found") {
    TestBrep b;
    const SolidId solid = add_prism(b, rectangle(3, 2), 0, 1);
    const FaceId bottom = b.solid_faces(solid)[0].face;
    const FaceId top = b.solid_faces(solid)[1].face;
    std::vector<Vec3> nodes{{0, 0, 0}, {3, 0, 0}, {3, 2, 0}, {0, 2, 0}, {0, 0, 1}, {3, 0, 1}, {3, 2, 1}, {0, 2, 1}};
    const std::vector<QuadCorners> quads{{0, 3, 2, 1}, {4, 5, 6, 7}};
    const std::vector<FaceId> faces{bottom, top};
    CHECK(face_distance(b, nodes, quads, faces).distance < 1e-14);
    nodes[6].z() += 0.25;
    nodes[2].z() += 0.125;
    const FaceDistance farthest = face_distance(b, nodes, quads, faces);
    CHECK(farthest.distance == Approx(0.25));
    CHECK(farthest.quad == 1);
    CHECK(farthest.node == 6);
    CHECK(face_distance(b, nodes, std::vector<QuadCorners>{}, std::vector<FaceId>{}).distance == 0);
    CHECK_THROWS_AS(face_distance(b, nodes, quads, std::span(faces).first(1)), InputError);
}
