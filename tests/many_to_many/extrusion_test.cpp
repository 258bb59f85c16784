#include "support/catch.hpp"
#include "support/test_brep.hpp"

#include <pavior/many_to_many/extrusion.hpp>

using namespace pavior;
using namespace pavior::test;

namespace {
const std::vector<SolidId> first{SolidId{0}};
}

TEST_CASE("a prism is an extrusion along its axis, caps flat, sides sides") {
    TestBrep b;
    add_prism(b, l_shape(), 0, 3);
    const std::vector<Extrusion> all = recognise_extrusions(b, first);
    REQUIRE(!all.empty());
    CHECK(all[0].possible());
    CHECK(all[0].direction == Vec3::UnitZ());
    CHECK(all[0].caps == 2);
    CHECK(all[0].slanted == 0);
    CHECK(all[0].roles[0] == ExtrusionRole::flat);
    CHECK(all[0].roles[2] == ExtrusionRole::side);
    CHECK(all[1].possible());  // also along x and y, with a step
    CHECK(all[1].caps == 3);
}

TEST_CASE("a boss on a box is an extrusion with three levels") {
    TestBrep b;
    add_boss(b);
    CHECK(recognise_extrusions(b, first).at(0).caps == 3);
}

TEST_CASE("a cylinder is an extrusion along its axis only, a cone is none") {
    TestBrep b;
    add_cylinder(b, 1, 1, 2);
    CHECK(extrusion_along(b, first, Vec3::UnitZ()).possible());
    CHECK_FALSE(extrusion_along(b, first, Vec3::UnitX()).possible());
    TestBrep cone;
    add_cylinder(cone, 1, 0.9, 2);
    const std::vector<Extrusion> none = recognise_extrusions(cone, first);
    REQUIRE_FALSE(none.at(0).possible());
    const UnmeshableError error = extrusion_error(cone, none[0]);
    CHECK(error.code() == ErrorCode::not_sweepable);
    CHECK(error.ids() == Error::Ids{1});
    CHECK_THAT(error.what(), Catch::Contains("face 1 leans"));
}

TEST_CASE("caps may slant up to a limit") {
    TestBrep b;
    add_pyramid(b);
    CHECK(extrusion_along(b, first, Vec3::UnitZ()).slanted == 4);
    ExtrusionOptions strict;
    strict.max_slope = 45;
    const Extrusion refused = extrusion_along(b, first, Vec3::UnitZ(), strict);
    CHECK(refused.refusals.size() == 4);
    CHECK(std::min(refused.refusals[0].low, 180 - refused.refusals[0].high) == Approx(63.43).epsilon(1e-3));
}
