#include "support/catch.hpp"
#include "support/test_brep.hpp"

#include <pavior/part/entity_groups.hpp>

using namespace pavior;
using namespace pavior::test;

TEST_CASE("Groups bear the tags of solids and faces, each face once") {
    TestBrep b;
    const std::vector<SolidId> solids = add_box_row(b, {0, 1, 2});
    const std::vector<MeshGroup> groups = entity_groups(b, solids);
    CHECK(groups.size() == 2 + 11);
    CHECK(groups[0] == MeshGroup{3, b.tag(3, solids[0].index()), "solid_" + std::to_string(b.tag(3, 0))});
    CHECK(groups.back().name == "face_" + std::to_string(groups.back().number));
    for (std::size_t i = 3; i < groups.size(); ++i) {
        CHECK(groups[i - 1].number < groups[i].number);
    }
}

TEST_CASE("A mesh of entities becomes a mesh of groups") {
    SolidsMesh made;
    made.mesh = {std::vector<Vec3>(8, Vec3::Zero()), {{0, 1, 2, 3, 4, 5, 6, 7}}};
    made.hex_solid = {SolidId{1}};
    made.quads = {{0, 1, 2, 3}, {4, 5, 6, 7}};  // the first looks inward
    made.quad_face = {FaceId{2}, FaceId{3}};
    TestBrep b;
    const std::vector<SolidId> solids = add_box_row(b, {0, 1, 2});
    const HexMeshData data = grouped(b, solids, std::move(made));
    CHECK(data.mesh.hexes.size() == 1);
    CHECK(data.hex_groups == std::vector{b.tag(3, 1)});
    CHECK(data.quad_groups == std::vector{b.tag(2, 2), b.tag(2, 3)});
    CHECK(data.quads == std::vector<QuadCorners>{{0, 3, 2, 1}, {4, 5, 6, 7}});
}
