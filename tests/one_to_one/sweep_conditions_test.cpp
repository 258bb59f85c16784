#include <pavior/one_to_one/sweep_conditions.hpp>

#include "support/catch.hpp"
#include "support/test_brep.hpp"

#include <string>

using namespace pavior;
using namespace pavior::test;

TEST_CASE("Conditions bear the numerals of the text") {
    CHECK(std::string(numeral(SweepCondition::equal_caps)) == "(i)");
    CHECK(std::string(numeral(SweepCondition::one_axis)) == "(iv)");
}

TEST_CASE("Caps fit if they are apart, without seam and have equally many loops") {
    TestBrep b;
    const SolidBoundary box = solid_boundary(b, add_prism(b, rectangle(1, 1), 0, 1));
    CHECK(detail::caps_fit(box, 0, 1));
    CHECK_FALSE(detail::caps_fit(box, 0, 2));
    const SolidBoundary pipe = solid_boundary(b, add_cylinder(b, 2, 2, 1, 1));
    CHECK(detail::caps_fit(pipe, 0, 1));
    CHECK_FALSE(detail::caps_fit(pipe, 2, 3));
    const SolidBoundary boss = solid_boundary(b, add_boss(b));
    CHECK_FALSE(detail::caps_fit(boss, 0, 1));
    CHECK(detail::caps_fit(boss, 0, 2));
}

TEST_CASE("Contacts are counted as chains") {
    TestBrep b;
    const SolidBoundary tower = solid_boundary(b, add_prism(b, l_shape(), 0, 1));
    CHECK(detail::chains_along(tower, 2, 0) == 1);
    CHECK(detail::chains_along(tower, 2, 4) == 0);
    CHECK(detail::chains_along(tower, 2, 3) == 1);
    const SolidBoundary bar = solid_boundary(b, add_cylinder(b, 1, 1, 1));
    CHECK(detail::chains_along(bar, 0, 2) == 1);  // the whole loop
    CHECK(detail::chains_along(bar, 2, 2) == 2);  // the seam, from both sides
}

TEST_CASE("Each kind of obstacle is named") {
    TestBrep b;
    const SolidBoundary pyramid = solid_boundary(b, add_pyramid(b));
    CHECK_THAT(explain_refusal(pyramid, 0, 1).text,
               Catch::Contains("face 2: an edge in common with the source") && Catch::Contains("(condition (iii))"));
    CHECK_THAT(explain_refusal(pyramid, 1, 3).text, Catch::Contains("a vertex in common with the source"));

    const SolidBoundary pipe = solid_boundary(b, add_cylinder(b, 2, 2, 1, 1));
    const SweepRefusal walls = explain_refusal(pipe, 2, 3);
    REQUIRE(walls.obstacles.size() == 4);
    CHECK(walls.obstacles[0].condition == SweepCondition::equal_caps);
    CHECK(walls.obstacles[0].tag == b.tag(2, walls.obstacles[0].face.index()));
    CHECK_THAT(walls.text, Catch::Contains("closed in itself by a seam edge, cannot be a cap (condition (i))") &&
                               Catch::Contains("2 boundary loops where a linking side has one (condition (ii))"));

    const SolidBoundary triangle = solid_boundary(b, add_square_to_triangle(b));
    CHECK_THAT(explain_refusal(triangle, 0, 1).text,
               Catch::Contains("three logical sides, only a vertex on the target"));

    const SolidBoundary boss = solid_boundary(b, add_boss(b));
    const SweepRefusal up = explain_refusal(boss, 0, 2);
    CHECK_THAT(up.text, Catch::Contains("no edge on the target (condition (iii))") &&
                            Catch::Contains("no edge on the source (condition (iii))"));
    CHECK(up.obstacles.size() == 9);

    const SolidBoundary box = solid_boundary(b, add_prism(b, rectangle(1, 1), 0, 1, {}, 3));
    CHECK_THAT(explain_refusal(box, 0, 1).text, Catch::Contains("no contact with source or target"));
}

TEST_CASE("A face that meets a cap twice is no linking side") {
    TestBrep b;  // a box 3 x 2 x 2 with a notch 1 x 1 x 1 in the middle of its lower front edge
    const auto floor = lift(b, {{0, 0}, {1, 0}, {1, 1}, {2, 1}, {2, 0}, {3, 0}, {3, 2}, {0, 2}}, 0);
    const auto roof = lift(b, {{1, 0}, {1, 1}, {2, 1}, {2, 0}}, 1);
    const auto top = lift(b, rectangle(3, 2), 2);
    const auto outward = [&](const std::vector<VertexId>& v) { return OrientedFace{b.flat_polygon(v), true}; };
    const SolidId id = b.solid({{b.flat_polygon(floor), false},
                                outward(top),
                                outward({floor[0], floor[1], roof[0], roof[3], floor[4], floor[5], top[1], top[0]}),
                                outward({floor[5], floor[6], top[2], top[1]}),
                                outward({floor[6], floor[7], top[3], top[2]}),
                                outward({floor[7], floor[0], top[0], top[3]}),
                                outward({floor[1], floor[2], roof[1], roof[0]}),
                                outward({floor[2], floor[3], roof[2], roof[1]}),
                                outward({floor[3], floor[4], roof[3], roof[2]}),
                                outward({roof[0], roof[1], roof[2], roof[3]})});
    const SweepRefusal refusal = explain_refusal(solid_boundary(b, id), 0, 1);
    CHECK_THAT(refusal.text,
               Catch::Contains("face 3: contact with the source along 2 separate chains (condition (ii))") &&
                   Catch::Contains("faces 7, 8, 9: no edge on the target (condition (iii))") &&
                   Catch::Contains("face 10: no contact with source or target, would be a further cap"));
    CHECK(refusal.obstacles.size() == 5);
}

TEST_CASE("The closest pair is the one with the fewest obstacles") {
    TestBrep b;
    const SolidBoundary triangle = solid_boundary(b, add_square_to_triangle(b));
    const auto pairs = detail::closest_pairs(triangle, 2);
    REQUIRE(pairs.size() == 2);
    CHECK(pairs[0] == std::pair<std::size_t, std::size_t>{0, 1});
    CHECK(detail::closest_pairs(triangle, 100).size() == 15);
    const UnmeshableError error =
        detail::not_sweepable_error(triangle, {explain_refusal(triangle, 0, 1), explain_refusal(triangle, 0, 1)});
    CHECK(error.code() == ErrorCode::not_sweepable);
    CHECK(error.ids().size() == 1);
}
