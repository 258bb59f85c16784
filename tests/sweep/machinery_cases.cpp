// The headers of sweep/detail/, each called as the room calls it.
#include "support/catch.hpp"

#include <pavior/sweep/detail/cap_array.hpp>
#include <pavior/sweep/detail/cap_data.hpp>
#include <pavior/sweep/detail/monotone_matching.hpp>
#include <pavior/sweep/detail/verify_loops.hpp>

#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

using namespace pavior;

namespace {

// Two unit quads side by side; node 6 lies nowhere.
const std::vector<QuadCorners> two_quads{{0, 1, 4, 3}, {1, 2, 5, 4}};
const Loops round_both{{0, 1, 2, 5, 4, 3}, {0, 6}};

}  // namespace

TEST_CASE("a cap array holds both caps about their centres in aligned rows") {
    std::vector<Vec3> source, target;
    for (int i = 0; i < 13; ++i) {
        source.emplace_back(i, 2 * i, 3 * i);
        target.emplace_back(-i, 100 + i, 0);
    }
    const detail::CapArray caps(source, target, {1, 2, 3}, {0, 100, 0});
    const detail::CapArray copy = caps;
    for (std::size_t s = 0; s < 6; ++s) {
        CHECK(reinterpret_cast<std::uintptr_t>(caps.rows().row[s]) % 64 == 0);
        CHECK(copy.rows().row[s] == caps.rows().row[s]);
    }
    for (std::size_t i = 0; i < 13; ++i) {
        for (std::size_t c = 0; c < 3; ++c) {
            const auto axis = static_cast<Eigen::Index>(c);
            CHECK(caps.rows().row[c][i] == source[i][axis] - Vec3(1, 2, 3)[axis]);
            CHECK(caps.rows().row[c + 3][i] == target[i][axis] - Vec3(0, 100, 0)[axis]);
        }
    }
}

TEST_CASE("mark_boundary marks the nodes of the loops and refuses what does not exist") {
    CHECK(detail::mark_boundary(7, two_quads, round_both) == std::vector<std::uint8_t>{1, 1, 1, 1, 1, 1, 0});
    CHECK_THROWS_AS(detail::mark_boundary(5, two_quads, round_both), InputError);
    CHECK_THROWS_AS(detail::mark_boundary(7, two_quads, Loops{{0, 1, 0}, {0, 3}}), InputError);
    CHECK_THROWS_AS(detail::mark_boundary(7, two_quads, Loops{}), InputError);
    CHECK_THROWS_AS(detail::mark_boundary(7, std::vector<QuadCorners>{{0, 1, 7, 3}}, round_both), InputError);
}

TEST_CASE("areas of quads and of the loops round them agree") {
    const std::vector<Vec2> uv{{0, 0}, {1, 0}, {2, 0.5}, {0, 1}, {1, 1}, {2, 1}};
    const std::vector<Vec2> rim = detail::pick(std::span<const Vec2>(uv), std::span<const Index>(round_both.nodes));
    CHECK(rim[3] == uv[5]);
    CHECK(detail::quads_area(uv, two_quads) == Approx(1.75));
    CHECK(detail::loops_area(rim, round_both.offsets) == Approx(1.75));
    CHECK(detail::columns(std::span<const Vec2>(uv)).col(2) == uv[2]);
}

TEST_CASE("residuals fall off with the squared distance, and a loop node in the same place takes all") {
    const std::vector<Vec2> at{{0, 0}, {3, 0}, {1, 0}, {3, 0}};
    const std::vector<std::uint8_t> boundary{1, 1, 0, 0};
    const std::vector<Index> loop{0, 1};
    const std::vector<Vec3> residuals{{1, 0, 0}, {0, 1, 0}};
    std::vector<Vec3> images(4, Vec3::Zero());
    detail::add_residuals<Vec2, Vec3>(at, boundary, loop, residuals, images);
    CHECK(images[0] == Vec3::Zero());
    CHECK((images[2] - Vec3(0.8, 0.2, 0)).norm() < 1e-15);  // weights 1 and 1 / 4
    CHECK(images[3] == Vec3(0, 1, 0));
    images[1][0] = std::numeric_limits<double>::quiet_NaN();
    CHECK_THROWS_AS(detail::require_finite(std::span<const Vec3>(images), "an image"), InputError);
    CHECK_THROWS_AS(detail::require_size(3, 4, "residuals"), InputError);
    CHECK_NOTHROW(detail::require_size(4, 4, "residuals"));
}

TEST_CASE("a resampled rib has equal steps, and tables are inverted") {
    std::vector<Vec3> points;
    std::vector<double> parameters;
    for (int i = 0; i <= 200; ++i) {  // a quarter circle whose parameter is not its length
        const double t = i / 200.0;
        points.emplace_back(std::cos(0.5 * std::numbers::pi * t * t), std::sin(0.5 * std::numbers::pi * t * t), 0);
        parameters.push_back(t);
    }
    const detail::SampledRib rib = detail::resample(points, parameters, 10, 0);
    for (std::size_t k = 0; k <= 10; ++k) {
        const double angle = 0.05 * std::numbers::pi * static_cast<double>(k);
        CHECK((rib.points[k] - Vec3(std::cos(angle), std::sin(angle), 0)).norm() < 1e-3);
        CHECK(rib.parameters[k] == Approx(std::sqrt(0.1 * static_cast<double>(k))).margin(2e-3));
    }
    CHECK((rib.point(0.35) - 0.5 * (rib.points[3] + rib.points[4])).norm() < 1e-12);
    CHECK_THROWS_AS(detail::resample(std::vector<Vec3>(3, Vec3(1, 1, 1)), std::vector<double>{0, 1, 2}, 4, 7),
                    InputError);
    const std::vector<double> table{0.0, 0.1, 0.7, 1.0};
    for (const double x : {0.0, 0.2, 0.5, 0.9, 1.0}) {
        CHECK(detail::invert_table(table, detail::at_table(std::span<const double>(table), x)) ==
              Approx(x).margin(1e-15));
    }
    const std::vector<double> mean = detail::moving_mean(table, 1);
    CHECK(mean.front() == 0.0);
    CHECK(mean[1] == Approx(0.8 / 3.0));
    CHECK(mean.back() == 1.0);
}

TEST_CASE("a curve is matched with itself along the diagonal, and with one that stands still by steps of one side") {
    const std::vector<Vec3> line{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}};
    const detail::MatchPath same = detail::match_path(line, line);
    REQUIRE(same.size() == 4);
    for (std::size_t k = 0; k < 4; ++k) {
        CHECK(same[k] == std::pair{k, k});
    }
    const std::vector<Vec3> waits{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}};
    const detail::MatchPath path = detail::match_path(line, waits);
    CHECK(path.front() == std::pair<std::size_t, std::size_t>{0, 0});
    CHECK(path.back() == std::pair<std::size_t, std::size_t>{3, 5});
    for (const auto& [i, j] : path) {
        CHECK(line[i] == waits[j]);
    }
}

TEST_CASE("loops match the boundary of a mesh whatever their first node and sense") {
    CHECK(detail::match_loops(round_both, round_both, 7).message.empty());
    const detail::LoopMatch turned = detail::match_loops({{4, 3, 0, 1, 2, 5}, {0, 6}}, round_both, 7);
    CHECK(turned.message.empty());
    CHECK_FALSE(turned.reversed);
    CHECK(detail::match_loops({{3, 4, 5, 2, 1, 0}, {0, 6}}, round_both, 7).reversed);
    CHECK(detail::match_loops({{0, 1, 2, 5, 4, 4}, {0, 6}}, round_both, 7).ids == Error::Ids{4});
    CHECK(detail::match_loops({{0, 1, 5, 2, 4, 3}, {0, 6}}, round_both, 7).ids == Error::Ids{1, 5});
    CHECK(detail::match_loops({{0, 1, 2, 5, 4, 6}, {0, 6}}, round_both, 7).ids == Error::Ids{6});
    CHECK(detail::match_loops({{0, 1, 2, 5, 4}, {0, 5}}, round_both, 7).ids == Error::Ids{3});
    CHECK_FALSE(detail::unreached_node(6, two_quads, round_both.nodes).has_value());
    CHECK(detail::unreached_node(10, std::vector<QuadCorners>{{0, 1, 4, 3}, {6, 7, 8, 9}}, round_both.nodes) ==
          Index{6});
}
