#include "support/catch.hpp"
#include "support/test_brep.hpp"

#include <pavior/many_to_many/brep_body.hpp>
#include <pavior/many_to_many/local_sizes.hpp>

#include <algorithm>
#include <vector>

using namespace pavior;
using namespace pavior::test;

TEST_CASE("an edge takes its own size, else that of its faces, else of its solids") {
    TestBrep b;
    add_pyramid(b);
    const std::vector<SolidId> first{SolidId{0}};
    LocalSizes sizes;
    sizes.face[2] = 0.25;
    sizes.solid[1] = 0.5;
    sizes.edge[1] = 0.125;
    const BrepBody<TestBrep> body(b, first, extrusion_along(b, first, Vec3::UnitZ()), 1e-3, 10, sizes);
    CHECK(body.body().curves[0].size == 0.125);
    CHECK(std::count_if(body.body().curves.begin(), body.body().curves.end(),
                        [](const ExtrudedCurve& c) { return c.size == 0.25; }) == 2);
    CHECK(std::count_if(body.body().curves.begin(), body.body().curves.end(),
                        [](const ExtrudedCurve& c) { return c.size == 0.5; }) == 5);
}
