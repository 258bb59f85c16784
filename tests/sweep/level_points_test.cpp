#include "support/catch.hpp"

#include <pavior/sweep/level_points.hpp>

#include <array>
#include <deque>
#include <string>
#include <vector>

using namespace pavior;

namespace {
// Levels that are computed, not stored.
struct Prism {
    std::size_t layers = 0;
};
}  // namespace

template <>
struct pavior::level_access<Prism> {
    static std::size_t level_count(const Prism& p) { return p.layers + 1; }
    static std::size_t point_count(const Prism&, std::size_t) { return 3; }
    static std::array<double, 3> point(const Prism&, std::size_t k, std::size_t i) {
        return {i == 1 ? 1.0 : 0.0, i == 2 ? 1.0 : 0.0, static_cast<double>(k)};
    }
};

static_assert(level_points<Prism>);
static_assert(level_points<std::vector<std::vector<Vec3>>>);
static_assert(level_points<std::vector<std::span<const Vec3>>>);
static_assert(level_points<std::array<std::vector<std::array<float, 3>>, 4>>);
static_assert(level_points<std::deque<std::vector<std::vector<double>>>>);
static_assert(level_points<LevelArray<>>);
static_assert(level_points<LevelArray<std::array<double, 3>>>);
static_assert(!level_points<std::vector<double>>);
static_assert(!level_points<std::vector<std::string>>);
static_assert(!level_points<int>);

TEST_CASE("nested ranges give their points") {
    const std::vector<std::vector<Vec3>> levels{{{1, 2, 3}, {4, 5, 6}}, {{7, 8, 9}}};
    using access = level_access<std::vector<std::vector<Vec3>>>;
    CHECK(access::level_count(levels) == 2);
    CHECK(access::point_count(levels, 0) == 2);
    CHECK(access::point_count(levels, 1) == 1);
    CHECK(access::point(levels, 0, 1) == Vec3(4, 5, 6));
    CHECK(&access::point(levels, 0, 1) == &levels[0][1]);
}

TEST_CASE("a flat array is cut into levels; a rest is a short level") {
    const std::vector<Vec3> points{{1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {4, 0, 0}, {5, 0, 0}};
    const LevelArray<> levels{points, 2};
    using access = level_access<LevelArray<>>;
    CHECK(access::level_count(levels) == 3);
    CHECK(access::point_count(levels, 1) == 2);
    CHECK(access::point_count(levels, 2) == 1);
    CHECK(access::point(levels, 1, 1) == Vec3(4, 0, 0));
    CHECK(access::level_count(LevelArray<>{points, 0}) == 0);
}
