#include <pavior/glpk/solve_program.hpp>
#include <pavior/submap/submap_classes.hpp>

#include "support/catch.hpp"
#include "support/voxel_brep.hpp"

using namespace pavior;
using namespace pavior::test;

namespace {

std::vector<SolidClasses> classify(const TestBrep& b, std::span<const SolidBoundary> solids, double deviation = 60.0) {
    SubmapOptions options;
    options.corners.max_deviation = deviation;
    return classify_solids(b, solids, options, GlpkSolver{});
}

Error::Ids refused(const TestBrep& b, SolidId solid, std::string& text) {
    const std::vector<SolidBoundary> boundary{solid_boundary(b, solid)};
    try {
        (void)classify(b, boundary);
    } catch (const UnmeshableError& e) {
        CHECK(e.code() == ErrorCode::not_submappable);
        text = e.what();
        return e.ids();
    }
    return {};
}

}  // namespace

TEST_CASE("right angles take their own classes, and the deviation is none") {
    TestBrep b;
    const std::vector<SolidBoundary> solids{solid_boundary(b, add_boss(b))};
    const SolidClasses classes = classify(b, solids).at(0);
    CHECK(classes.deviation < 1e-9);
    std::array<int, 5> corners{}, dihedrals{};
    for (std::size_t h = 0; h < classes.corner.size(); ++h) {
        ++corners[static_cast<std::size_t>(classes.corner[h])];
        ++dihedrals[classes.dihedral[h]];
        CHECK(90.0 * static_cast<double>(classes.corner[h]) == Approx(solids[0].half_edges[h].angle));
        CHECK(classes.dihedral[h] == classes.dihedral[solids[0].half_edges[h].twin]);
    }
    CHECK(corners == std::array<int, 5>{0, 44, 0, 4, 0});
    CHECK(dihedrals == std::array<int, 5>{0, 40, 0, 8, 0});
}

TEST_CASE("a corner of 135 degrees becomes what the whole solid needs, the same in both caps") {
    TestBrep b;  // a box with one edge cut off
    const std::vector<SolidBoundary> solids{
        solid_boundary(b, add_prism(b, {{0, 0}, {3, 0}, {3, 2}, {2, 3}, {0, 3}}, 0, 1))};
    const SolidClasses classes = classify(b, solids).at(0);
    CHECK(classes.deviation == Approx(45.0));
    for (const std::size_t cap : {0U, 1U}) {
        int turns = 0;
        for (std::size_t h = solids[0].faces[cap].begin; h < solids[0].faces[cap].end; ++h) {
            turns += quarter_turns(classes.corner[h]);
        }
        CHECK(turns == 4);
    }
    CHECK_THROWS_AS(classify(b, solids, 40.0), UnmeshableError);
}

TEST_CASE("reasons name faces") {
    std::string text;
    TestBrep round;
    const SolidId cylinder = add_cylinder(round, 1, 1, 2);
    CHECK(!refused(round, cylinder, text).empty());
    CHECK(text.find("not those of a union of rectangles") != std::string::npos);
    TestBrep wedge;
    const SolidId prism = add_prism(wedge, {{0, 0}, {4, 0}, {4, 0.5}}, 0, 1);
    CHECK(!refused(wedge, prism, text).empty());
    CHECK(text.find("not near a multiple of 90 degrees") != std::string::npos);
    TestBrep hexagon;
    const SolidId triangle = add_prism(hexagon, {{0, 0}, {4, 0}, {2, 3}}, 0, 1);
    CHECK(!refused(hexagon, triangle, text).empty());
}

TEST_CASE("solids that share a face agree on its corners") {
    TestBrep b;  // a pentagonal wall between two prisms: 135 degrees twice
    const Polygon cut{{0, 0}, {3, 0}, {3, 2}, {2, 3}, {0, 3}};
    const auto low = lift(b, cut, 0), mid = lift(b, cut, 1), high = lift(b, cut, 2);
    const FaceId wall = b.flat_polygon(mid);
    std::vector<OrientedFace> lower{{b.flat_polygon(low), false}, {wall, true}};
    std::vector<OrientedFace> upper{{wall, false}, {b.flat_polygon(high), true}};
    add_sides(b, low, mid, lower);
    add_sides(b, mid, high, upper);
    const std::vector<SolidBoundary> solids{solid_boundary(b, b.solid(lower)), solid_boundary(b, b.solid(upper))};
    const std::vector<SolidClasses> classes = classify(b, solids);
    for (std::size_t i = 0; i < 5; ++i) {  // the wall is face 1 of the first, face 0 of the second, seen from behind
        const std::size_t h = solids[0].faces[1].begin + i;
        const std::size_t g = solids[1].faces[0].begin + (5 - i) % 5;
        CHECK(solids[0].half_edges[h].start == solids[1].half_edges[g].start);
        CHECK(classes[0].corner[h] == classes[1].corner[g]);
    }
}
