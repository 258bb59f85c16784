#include <pavior/core/error.hpp>

#include "support/catch.hpp"
#include "support/extruded_cases.hpp"

#include <limits>

using namespace pavior;
using namespace pavior::test;

TEST_CASE("corners part a loop into curves, a smooth loop is one") {
    const PolygonBody body({bottom(0, {box(0, 0, 4, 4), disc(2, 2, 1)}), top(1, {box(0, 0, 4, 4), disc(2, 2, 1)})});
    CHECK(body.body().curves.size() == 10);
    CHECK(body.body().vertices.size() == 10);
    CHECK(body.body().plane[4].size() == 65);
    CHECK(body.body().curves[4].vertices[0] == body.body().curves[4].vertices[1]);
    CHECK(body.body().caps[1].curves == std::vector<Index>{5, 6, 7, 8, 9});
    PolygonBodyOptions all;
    all.corner_angle = 0;
    CHECK(PolygonBody({bottom(0, {disc(0, 0, 1)})}, all).body().curves.size() == 64);
}

TEST_CASE("heights follow the slope of the cap") {
    const PolygonBody body({{{box(0, 0, 2, 2)}, 3, {0.5, -1}, no_index, 0}});
    CHECK(body.cap_height(0, {2, 1}) == Approx(3));
    const Vec3 at = body.curve_point(0, {1, -7});
    CHECK(at[0] == Approx(1));
    CHECK(at[1] == Approx(0).margin(1e-15));
    CHECK(at[2] == Approx(3.5));
}

TEST_CASE("caps without area and points that are not finite are named") {
    CHECK_THROWS_WITH(PolygonBody({bottom(0, {})}), Catch::Contains("cap 0"));
    CHECK_THROWS_AS(PolygonBody({bottom(0, {{{0, 0}, {1, 0}}})}), InputError);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    CHECK_THROWS_AS(PolygonBody({bottom(0, {{{0, 0}, {1, nan}, {1, 1}}})}), InputError);
}

TEST_CASE("a point given twice in a row is named") {
    const auto ids_of = [](const std::vector<std::vector<Vec2>>& loops) {
        try {
            (void)PolygonBody({bottom(0, {box(0, 0, 4, 4)}), top(1, loops)});
        } catch (const InputError& error) {
            CHECK(error.code() == ErrorCode::duplicate_node);
            return error.ids();
        }
        return Error::Ids{};
    };
    CHECK(ids_of({{{0, 0}, {4, 0}, {4, 0}, {4, 4}, {0, 4}}}) == Error::Ids{1, 0, 2});
    CHECK(ids_of({box(0, 0, 4, 4), {{1, 1}, {1, 2}, {2, 2}, {1, 1}}}) ==
          Error::Ids{1, 1, 0});  // closed by its first point
    CHECK(ids_of({{{0.1, 0}, {4.1, 0}, {4.1 + 1e-15, 0}, {4.1, 4}, {0, 4}}}) == Error::Ids{1, 0, 2});
    CHECK(ids_of({{{0, 0}, {4, 0}, {4, 1e-9}, {4, 4}, {0, 4}}}).empty());
    CHECK(ids_of({{{0, 0}, {1, 1}, {2, 0}, {2, 2}, {1, 1}, {0, 2}}}).empty());  // it touches itself
}
