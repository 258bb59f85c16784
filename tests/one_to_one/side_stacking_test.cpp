#include <pavior/one_to_one/side_stacking.hpp>

#include "support/catch.hpp"
#include "support/test_brep.hpp"

using namespace pavior;
using namespace pavior::test;

namespace {

std::optional<SweepTopology> stacked(const SolidBoundary& solid, std::size_t source, std::size_t target,
                                     const StackingOptions& options) {
    std::size_t tests_left = options.max_tests;
    return detail::find_stacked_sweep(solid, detail::RolePatterns(solid, options), source, target, tests_left);
}

/// A bar of square section along the x axis, bent upwards by an angle (degrees) in the middle: six faces but that the
/// outer and inner sides are in two pieces; the plane sides have six edges.
SolidId add_bent_bar(TestBrep& b, double bend) {
    const double half = bend * std::numbers::pi / 360;
    const Vec3 along(std::cos(2 * half), 0, std::sin(2 * half)), up(-std::sin(2 * half), 0, std::cos(2 * half));
    const auto section = [&](const Vec3& p, const Vec3& across) {
        return std::vector{b.vertex(p), b.vertex(p + Vec3(0, 1, 0)), b.vertex(p + across + Vec3(0, 1, 0)),
                           b.vertex(p + across)};
    };
    const Vec3 mitre = Vec3(-std::tan(half), 0, 1);
    const auto start = section({0, 0, 0}, {0, 0, 1}), middle = section({3, 0, 0}, mitre),
               stop = section(Vec3(3, 0, 0) + 3 * along, up);
    std::vector<OrientedFace> faces{{b.flat_polygon(start), false}, {b.flat_polygon(stop), true}};
    const std::size_t floor[] = {0, 2};
    for (const std::size_t i : floor) {
        const std::size_t j = i + 1;
        faces.push_back({b.flat_polygon({start[i], start[j], middle[j], middle[i]}), true});
        faces.push_back({b.flat_polygon({middle[i], middle[j], stop[j], stop[i]}), true});
    }
    faces.push_back({b.flat_polygon({start[1], start[2], middle[2], stop[2], stop[1], middle[1]}), true});
    faces.push_back({b.flat_polygon({start[3], start[0], middle[0], stop[0], stop[3], middle[3]}), true});
    return b.solid(std::move(faces));
}

}  // namespace

TEST_CASE("Storeys are stacked between the caps, and between no other faces") {
    TestBrep b;
    const SolidBoundary solid = solid_boundary(b, add_prism(b, rectangle(1, 1), 0, 2, {}, 2));
    const auto sweep = stacked(solid, 0, 1, {});
    REQUIRE(sweep);
    CHECK(sweep->stacked);
    CHECK(sweep->loops[0].size() == 8);
    for (std::size_t i = 2; i < solid.faces.size(); ++i) {
        CHECK_FALSE(stacked(solid, 0, i, {}));
    }
}

TEST_CASE("Round storeys with seams are stacked") {
    TestBrep b;
    const Ring low = add_circle(b, 2, 0), middle = add_circle(b, 1.5, 1), high = add_circle(b, 1.5, 3);
    const SolidId id = b.solid({{b.flat({{{low.e, true}}}, {0, 0, 1}), false},
                                {b.flat({{{high.e, true}}}, {0, 0, 1}), true},
                                {add_round_wall(b, low, middle), true},
                                {add_round_wall(b, middle, high), true}});
    const auto sweep = stacked(solid_boundary(b, id), 0, 1, {});
    REQUIRE(sweep);
    CHECK(sweep->loops[0].size() == 2);
    CHECK(sweep->loops[0][0].closed());
    const auto placed = place_sides(*sweep, std::vector<int>(b.edge_count(), 8));
    CHECK(placed[0][1] == SidePlacement{0, 8, 8, 8});
}

TEST_CASE("A bend is followed up to the tolerated kink") {
    for (const double bend : {10.0, 30.0, 45.0, 60.0, 90.0}) {
        TestBrep b;
        const SolidBoundary solid = solid_boundary(b, add_bent_bar(b, bend));
        CHECK(stacked(solid, 0, 1, {}).has_value() == (bend < 50));
        StackingOptions generous;
        generous.kink_tolerance = 100;
        CHECK(stacked(solid, 0, 1, generous).has_value());
    }
}

TEST_CASE("A search without tests finds nothing") {
    TestBrep b;
    const SolidBoundary solid = solid_boundary(b, add_prism(b, rectangle(1, 1), 0, 2, {}, 2));
    StackingOptions none;
    none.max_tests = 0;
    CHECK_FALSE(stacked(solid, 0, 1, none));
}

TEST_CASE("a side that runs round a corner of 270 degrees is seen only where that is asked for") {
    TestBrep b;  // from the mitre (face 2) up to the end of a branch that is narrower than its run
    const SolidId id = add_prism(b, {{0, 0}, {1, 1}, {0.5, 1}, {0.5, 3}, {0, 3}}, 0, 1);
    const SolidBoundary solid = solid_boundary(b, id);
    const std::size_t mitre = 2, end = 5;
    CHECK_FALSE(stacked(solid, mitre, end, {}));
    StackingOptions flat;
    flat.flat_notches = true;
    const auto sweep = stacked(solid, mitre, end, flat);
    REQUIRE(sweep);
    CHECK(sweep->stacked);
    CHECK(sweep->loops[0].size() == 5);
    // what fits without it comes first
    TestBrep storeys;
    const SolidBoundary prism = solid_boundary(storeys, add_prism(storeys, rectangle(1, 1), 0, 2, {}, 2));
    const auto plain = stacked(prism, 0, 1, {}), other = stacked(prism, 0, 1, flat);
    REQUIRE((plain && other));
    for (std::size_t i = 0; i < plain->loops[0].size(); ++i) {
        CHECK(plain->loops[0][i].face == other->loops[0][i].face);
    }
}
