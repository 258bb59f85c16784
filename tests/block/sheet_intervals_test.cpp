#include "support/block_cases.hpp"
#include "support/catch.hpp"

#include <pavior/block/dualize.hpp>
#include <pavior/block/place_blocks.hpp>
#include <pavior/block/sheet_intervals.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

using block_cases::Case;
using pavior::InputError;
using pavior::Vec3;

namespace {
std::vector<pavior::SheetIntervals> intervals(const Case& c, const pavior::BlockLengths& lengths) {
    const auto blocks = pavior::dualize(c.mesh, c.topology, c.classes, c.complex);
    const auto geometry = pavior::block_geometry(c.mesh, c.topology, c.complex);
    return pavior::sheet_intervals(blocks, geometry, pavior::place_blocks(blocks, geometry), lengths);
}

std::vector<pavior::SheetIntervals> intervals(const Case& c, double size, double max_angle = 30) {
    return intervals(c, pavior::BlockLengths{size, max_angle, {}, {}});
}

std::vector<std::uint32_t> numbers(const std::vector<pavior::SheetIntervals>& sheets) {
    std::vector<std::uint32_t> result;
    for (const auto& sheet : sheets) {
        result.push_back(sheet.intervals);
    }
    std::sort(result.begin(), result.end());
    return result;
}
}  // namespace

TEST_CASE("the intervals of a sheet are its mean length by the size", "[sheet_intervals]") {
    const Case c = block_cases::grid({2, 2, 2}, {}, [](const Vec3& x) { return Vec3(4 * x[0], 2 * x[1], x[2]); });
    const auto sheets = intervals(c, 0.25);
    REQUIRE(sheets.size() == 6);
    for (const auto& sheet : sheets) {
        CHECK(sheet.edges == 9);
        CHECK(sheet.shortest == Approx(sheet.longest));
        CHECK(sheet.mean == Approx(0.25 * sheet.intervals));
    }
    CHECK(numbers(sheets) == std::vector<std::uint32_t>{2, 2, 4, 4, 8, 8});
}

TEST_CASE("lengths run along the geometry", "[sheet_intervals]") {
    const Case c = block_cases::grid({40, 2, 2}, {}, [](const Vec3& x) {
        return Vec3((1 + x[1]) * std::sin(2 * x[0]), (1 + x[1]) * std::cos(2 * x[0]), x[2]);
    });
    double longest = 0;
    for (const auto& sheet : intervals(c, 0.1)) {
        CHECK(sheet.shortest <= sheet.mean);
        CHECK(sheet.mean <= sheet.longest);
        longest = std::max(longest, sheet.longest);
    }
    CHECK(longest == Approx(2.0).epsilon(1e-2));  // half of an arc of radius 2 and angle 2
}

TEST_CASE("edges that turn get intervals that do not turn by more than the angle", "[sheet_intervals]") {
    const Case c = block_cases::grid({40, 2, 2}, {}, [](const Vec3& x) {
        return Vec3((1 + x[1]) * std::sin(2 * x[0]), (1 + x[1]) * std::cos(2 * x[0]), x[2]);
    });
    for (const double angle : {10.0, 30.0, 90.0}) {
        for (const auto& sheet : intervals(c, 1e3, angle)) {
            const double half = sheet.turning > 1 ? 57.3 : 0;  // of an arc of angle 2
            CHECK(sheet.turning == Approx(half).epsilon(0.05).margin(1));
            CHECK(sheet.intervals == std::max(1.0, std::ceil(half / angle - 0.1)));
        }
    }
    CHECK_THROWS_AS(intervals(c, 1, 0), InputError);
}

TEST_CASE("a bend in one part of a chain gets chords that follow it, none shorter than half the size for it",
          "[sheet_intervals]") {
    // 6 straight on, then a quarter of a circle of radius 1
    const auto bent = [](const Vec3& x) {
        const double s = x[0] * (6 + std::numbers::pi / 2);
        const double r = 1 + 0.5 * x[1], turn = s - 6;
        return s < 6 ? Vec3(s, r, x[2]) : Vec3(6 + r * std::sin(turn), r * std::cos(turn), x[2]);
    };
    const Case c = block_cases::grid({80, 2, 2}, {}, bent);
    const auto most = [&](double size) {
        const auto sheets = numbers(intervals(c, size));
        return sheets.back();
    };
    CHECK(most(0.5) >= 8);                      // the size alone follows the bend
    CHECK(most(1.5) > std::lround(3.9 / 1.5));  // here it does not
    CHECK(most(1.5) <= std::lround(2 * 4.1 / 1.5));
    const Case straight = block_cases::grid({80, 2, 2}, {}, [](const Vec3& x) { return Vec3(7.5 * x[0], x[1], x[2]); });
    CHECK(numbers(intervals(straight, 1.5)).back() == std::lround(3.75 / 1.5));
}

TEST_CASE("without a size there are two intervals, with a great one a single one", "[sheet_intervals]") {
    const Case c = block_cases::read("ref_pyramid_table58");
    for (const auto& sheet : intervals(c, 0)) {
        CHECK(sheet.intervals == 2);
    }
    for (const auto& sheet : intervals(c, 1e9)) {
        CHECK(sheet.intervals == 1);
    }
    const auto sheets = intervals(c, 0.1);
    CHECK(std::accumulate(sheets.begin(), sheets.end(), std::size_t{0}, [](std::size_t n, const auto& s) {
              return n + s.edges;
          }) == pavior::dualize(c.mesh, c.topology, c.classes, c.complex).edges.size());
    CHECK_THROWS_AS(intervals(c, std::nan("")), InputError);
    CHECK_THROWS_AS(intervals(c, 1e-12), InputError);
}

TEST_CASE("curves and patches may have lengths of their own", "[sheet_intervals]") {
    const Case c = block_cases::grid({2, 2, 2}, {}, [](const Vec3& x) { return Vec3(4 * x[0], 2 * x[1], x[2]); });
    const auto tag_at = [&](const auto& on) {  // of the curve of which all nodes are
        for (const auto& edge : c.mesh.curves) {
            if (on(c.mesh.nodes[edge.nodes[0]]) && on(c.mesh.nodes[edge.nodes[1]])) {
                return edge.curve;
            }
        }
        return -1;
    };
    const std::int32_t along = tag_at([](const Vec3& x) { return x[1] == 0 && x[2] == 0; });
    REQUIRE(along >= 0);
    const pavior::BlockLengths curve{1, 30, {{along, 0.125}}, {}};
    CHECK(numbers(intervals(c, curve)) == std::vector<std::uint32_t>{1, 1, 1, 1, 16, 16});

    const auto blocks = pavior::dualize(c.mesh, c.topology, c.classes, c.complex);
    std::int32_t top = -1;  // the patch on z = 1
    for (std::size_t i = blocks.first[2]; i < blocks.first[3]; ++i) {
        const auto geometry = pavior::block_geometry(c.mesh, c.topology, c.complex);
        const Vec3 x = pavior::place_blocks(blocks, geometry).positions[i];
        top = x[2] == 1 ? blocks.nodes[i].geometry.tag : top;
    }
    REQUIRE(top >= 0);
    const pavior::BlockLengths patch{1, 30, {}, {{top, 0.25}}};
    CHECK(numbers(intervals(c, patch)) == std::vector<std::uint32_t>{1, 1, 4, 4, 8, 8});
    const pavior::BlockLengths both{1, 30, {{along, 0.125}}, {{top, 0.25}}};  // the curve goes before the patch
    CHECK(numbers(intervals(c, both)) == std::vector<std::uint32_t>{1, 1, 4, 4, 16, 16});
    CHECK_THROWS_AS(intervals(c, pavior::BlockLengths{1, 30, {{along, 0}}, {}}), InputError);
    CHECK_THROWS_AS(intervals(c, pavior::BlockLengths{1, 30, {}, {{top, std::nan("")}}}), InputError);
}
