#include <pavior/brep/detail/face_joiner.hpp>
#include <pavior/brep/joined_faces.hpp>

#include "support/catch.hpp"
#include "support/occ_solids.hpp"

#include <pavior/cad/gmsh_brep.hpp>

#include <numbers>

using namespace pavior;
using namespace pavior::test;

namespace {

std::size_t faces_of_first(const auto& model) { return model.solid_faces(SolidId{0}).size(); }

/// The joined faces of a model.
std::vector<FaceId> joined_of(const JoinedFaces<GmshBrep>& joined) {
    std::vector<FaceId> result;
    for (std::int32_t f = 0; f < static_cast<std::int32_t>(joined.face_count()); ++f) {
        if (!joined.parts(FaceId{f}).empty()) {
            result.push_back(FaceId{f});
        }
    }
    return result;
}

/// A solid with lines drawn on its faces, which split them.
void with_lines(int solid, const std::vector<std::array<Vec3, 2>>& lines) {
    gmsh::vectorpair tools{{3, solid}};
    for (const auto& [a, c] : lines) {
        tools.emplace_back(1, occ::addLine(occ::addPoint(a[0], a[1], a[2]), occ::addPoint(c[0], c[1], c[2])));
    }
    share_faces(tools);
}

}  // namespace

TEST_CASE("a face split by a line is one, with its holes, its tags and its parts") {
    const GmshBrep model = GmshBrep::build([] {
        with_lines(cut(occ::addBox(0, 0, 0, 6, 4, 2), {{3, occ::addCylinder(4, 2, -1, 0, 0, 4, 1)}}),
                   {{Vec3(2, 0, 2), Vec3(2, 4, 2)}});
    });
    REQUIRE(faces_of_first(model) == 8);
    const JoinedFaces<GmshBrep> joined(model);
    CHECK(joined.any());
    CHECK(faces_of_first(joined) == 7);
    const std::vector<FaceId> whole = joined_of(joined);
    REQUIRE(whole.size() == 1);
    const FaceId f = whole[0];
    CHECK(joined.face_loops(f).size() == 2);
    CHECK(joined.face_loops(f)[0].size() == 6);  // two edges lost their common end's edge, the ends stay
    CHECK(joined.parts(f).size() == 2);
    CHECK(all_tags(joined, 2, f.index()).size() == 3);
    const FaceId low = joined.part_at(f, {1, 1, 2}), high = joined.part_at(f, {3, 3.5, 2});
    CHECK(low != high);
    CHECK((model.face_loops(low).size() == 1 && model.face_loops(high).size() == 2));
    for (const EdgeLoop& loop : joined.face_loops(f)) {
        for (const OrientedEdge& use : loop) {  // all edges have parameters on it
            const Vec2 uv = joined.edge_on_face(use.edge, joined.edge_range(use.edge)[0], f, use.forward);
            const Vec3 x = joined.edge_point(use.edge, joined.edge_range(use.edge)[0]);
            CHECK((joined.face_point(f, uv) - x).norm() < 1e-9);
        }
    }
}

TEST_CASE("a sector of a pipe across the seam of its cylinders has six faces") {
    const GmshBrep model = GmshBrep::build([] {
        const int pipe = cut(occ::addCylinder(0, 0, 0, 0, 0, 2, 3), {{3, occ::addCylinder(0, 0, 0, 0, 0, 2, 2)}});
        gmsh::vectorpair result;
        std::vector<gmsh::vectorpair> map;
        occ::intersect({{3, pipe}}, {{3, occ::addBox(1, -1.5, 0, 4, 3, 2)}}, result, map);
        occ::synchronize();
    });
    REQUIRE(faces_of_first(model) == 8);
    const JoinedFaces<GmshBrep> joined(model);
    CHECK(faces_of_first(joined) == 6);
    for (const FaceId f : joined_of(joined)) {
        CHECK(joined.face_loops(f).size() == 1);
        CHECK(joined.part_at(f, {2, 1, 1}) != joined.part_at(f, {2, -1, 1}));
    }
}

TEST_CASE("faces that close round, that meet at an angle, or whose edge a neighbour needs stay apart") {
    const GmshBrep whole = GmshBrep::build([] {  // a cylinder in two halves
        with_lines(occ::addCylinder(0, 0, 0, 0, 0, 2, 1), {{Vec3(-1, 0, 0), Vec3(-1, 0, 2)}});
    });
    CHECK_FALSE(JoinedFaces<GmshBrep>(whole).any());
    const GmshBrep box = GmshBrep::build([] { occ::addBox(0, 0, 0, 1, 2, 3); });
    CHECK_FALSE(JoinedFaces<GmshBrep>(box).any());
    const GmshBrep stands = GmshBrep::build([] {
        share_faces({{3, occ::addBox(0, 0, 0, 2, 2, 1)}, {3, occ::addBox(0, 0, 1, 1, 2, 1)}});
    });
    REQUIRE(stands.solid_count() == 2);
    CHECK_FALSE(JoinedFaces<GmshBrep>(stands).any());
}

TEST_CASE("faces go on in each other or not, and whoever asks is answered the same") {
    const GmshBrep model = GmshBrep::build([] {
        with_lines(occ::addBox(0, 0, 0, 6, 4, 2), {{Vec3(2, 0, 2), Vec3(2, 4, 2)}});
    });
    const detail::FaceJoiner<GmshBrep> joiner(model);
    std::size_t joints = 0;
    const std::span<const OrientedFace> faces = model.solid_faces(SolidId{0});
    for (const OrientedFace& f : faces) {
        for (const OrientedFace& g : faces) {
            const detail::Joint joint = joiner.joint(f.face, g.face);
            CHECK(joint == joiner.joint(g.face, f.face));
            joints += f.face != g.face && joint != detail::Joint::none ? 1U : 0U;
        }
    }
    CHECK(joints == 2);
}
