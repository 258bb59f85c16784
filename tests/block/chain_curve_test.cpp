#include "support/catch.hpp"

#include <pavior/block/chain_curve.hpp>
#include <pavior/core/error.hpp>

using pavior::ChainCurve;
using pavior::InputError;
using pavior::Vec3;

TEST_CASE("a polyline is run through by arc length", "[chain_curve]") {
    const ChainCurve line({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 0, 0), Vec3(1, 3, 0)});
    CHECK(line.length() == Approx(4));
    CHECK(line.fraction(0) == 0.0);
    CHECK(line.fraction(1) == Approx(0.25));
    CHECK(line.fraction(2) == Approx(0.25));
    CHECK(line.fraction(3) == 1.0);
    CHECK((line.at(0.125) - Vec3(0.5, 0, 0)).norm() < 1e-15);
    CHECK((line.at(0.5) - Vec3(1, 1, 0)).norm() < 1e-15);
    CHECK(line.at(0.0) == Vec3(0, 0, 0));
    CHECK(line.at(1.0) == Vec3(1, 3, 0));
    CHECK(line.at(-1.0) == Vec3(0, 0, 0));
    CHECK(line.at(2.0) == Vec3(1, 3, 0));
}

TEST_CASE("the point at a node's fraction is the node", "[chain_curve]") {
    std::vector<Vec3> points;
    for (int i = 0; i <= 20; ++i) {
        points.emplace_back(std::cos(0.1 * i), std::sin(0.1 * i), 0.01 * i * i);
    }
    const ChainCurve line(points);
    for (std::size_t i = 0; i < points.size(); ++i) {
        CHECK((line.at(line.fraction(i)) - points[i]).norm() < 1e-12);
    }
}

TEST_CASE("sag measures how far a polyline is from straight", "[chain_curve]") {
    CHECK(ChainCurve({Vec3(0, 0, 0), Vec3(1, 1, 1), Vec3(2, 2, 2)}).sag() < 1e-15);
    CHECK(ChainCurve({Vec3(0, 0, 0), Vec3(1, 0.5, 0), Vec3(2, 0, 0)}).sag() == Approx(0.5));
    CHECK(ChainCurve({Vec3(0, 0, 0), Vec3(0, 2, 0), Vec3(0, 0, 0)}).sag() == Approx(2));
}

TEST_CASE("a polyline without length is its first point, and one without points an error", "[chain_curve]") {
    const ChainCurve point({Vec3(1, 2, 3), Vec3(1, 2, 3), Vec3(1, 2, 3)});
    CHECK(point.length() == 0.0);
    CHECK(point.at(0.7) == Vec3(1, 2, 3));
    CHECK(point.fraction(1) == Approx(0.5));
    CHECK_THROWS_AS(ChainCurve({Vec3(0, 0, 0)}), InputError);
}
