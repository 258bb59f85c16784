#include <pavior/glpk/solve_program.hpp>
#include <pavior/submap/submap_recognition.hpp>

#include "support/catch.hpp"
#include "support/voxel_brep.hpp"

using namespace pavior;
using namespace pavior::test;

TEST_CASE("directions are those of space for axis-parallel solids, whatever the senses of the faces") {
    for (const bool flipped : {false, true}) {
        Voxels voxels(5, 5, 3);
        voxels.fill({0, 0, 0}, {5, 5, 2}, 1);
        voxels.fill({1, 1, 2}, {2, 4, 3}, 1);
        voxels.fill({3, 3, 0}, {4, 4, 2}, 0);
        const VoxelBrep model(voxels, flipped);
        REQUIRE(model.sound());
        const TestBrep& b = model.brep();
        const SubmapModel found = recognise_submaps(b, model.solids(), {}, GlpkSolver{});
        REQUIRE(found.solids.size() == 1);
        CHECK(found.solids[0].deviation < 1e-9);
        int holed = 0;
        for (const LogicalSide& side : found.solids[0].sides) {
            const LogicalFace& face = found.faces[side.face.face.index()];
            holed += static_cast<int>(face.links.size());
            for (const LogicalLoop& loop : face.loops) {
                for (std::size_t i = 0; i < loop.uses.size(); ++i) {
                    const auto ends = b.edge_vertices(loop.uses[i].edge);
                    const Vec3 way =
                        (b.vertex_point(ends[1]) - b.vertex_point(ends[0])) * (loop.uses[i].forward ? 1 : -1);
                    const SignedAxis d = side.direction(loop.heading[i]);
                    CHECK(way[static_cast<Eigen::Index>(d.axis())] * d.sign() == Approx(way.norm()));
                }
            }
            const auto normal = outside_normal(b, side.face,
                                               {b.face_loops(side.face.face)[0][0].edge,
                                                b.face_loops(side.face.face)[0][0].forward == side.face.outward},
                                               0.5);
            CHECK(normal[static_cast<Eigen::Index>(side.outward().axis())] * side.outward().sign() == Approx(1.0));
        }
        CHECK(holed == 3);  // the boss once, the tunnel twice
    }
}

TEST_CASE("links lead from the first loop to the others by positive ways") {
    TestBrep b;
    const std::vector<SolidId> solids{add_boss(b)};
    const SubmapModel found = recognise_submaps(b, solids, {}, GlpkSolver{});
    const FaceId top = b.solid_faces(solids[0])[1].face;
    const LogicalFace& face = found.faces[top.index()];
    REQUIRE(face.links.size() == 1);
    const FlatFace flat = flat_face(b, top, b.face_loops(top));
    const Vec2 s = flat.chord[0][0].normalized(), t(-s.y(), s.x());
    const LoopLink& link = face.links[0];
    CHECK(link.length[0] == Approx((flat.start[1][0] - flat.start[0][link.anchor[0]]).dot(s)));
    CHECK(link.length[1] == Approx((flat.start[1][0] - flat.start[0][link.anchor[1]]).dot(t)));
    CHECK(std::min(link.length[0], link.length[1]) >= 1.0 - 1e-9);
}

TEST_CASE("a void inside is refused: nothing ties its boundary to the outer one") {
    Voxels voxels(3, 3, 3);
    voxels.fill({0, 0, 0}, {3, 3, 3}, 1);
    voxels.fill({1, 1, 1}, {2, 2, 2}, 0);
    const VoxelBrep model(voxels);
    REQUIRE(model.sound());
    try {
        (void)recognise_submaps(model.brep(), model.solids(), {}, GlpkSolver{});
        FAIL("a solid with a void");
    } catch (const UnmeshableError& e) {
        CHECK(e.code() == ErrorCode::not_submappable);
        CHECK(e.ids().size() == 1);
    }
}

TEST_CASE("a loop with nothing opposite to an edge cannot close") {
    TestBrep b;
    LogicalFace face;
    const FaceId f = b.flat_polygon(lift(b, {{0, 0}, {3, 0}, {1, 2}}, 0));
    face.loops.push_back({b.face_loops(f)[0], std::vector<CornerClass>(3, CornerClass::end), {0, 1, 2}});
    CHECK_THROWS_AS(detail::check_loops(b, f, face), UnmeshableError);
    face.loops[0].heading = {0, 2, 2};
    CHECK_NOTHROW(detail::check_loops(b, f, face));
}
