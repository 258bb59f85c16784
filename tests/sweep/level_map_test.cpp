#include "support/catch.hpp"
#include "support/swept_grid.hpp"

#include <pavior/sweep/level_map.hpp>

#include <cstring>

using namespace pavior;
using namespace pavior::test;

namespace {

double gap(const AffineMap<double, 3>& a, const AffineMap<double, 3>& b) {
    double worst = 0;
    for (const Vec3& x : {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)}) {
        worst = std::max(worst, (a(x) - b(x)).norm());
    }
    return worst;
}

bool same_bits(const AffineMap<double, 3>& a, const AffineMap<double, 3>& b) {
    return a.A == b.A && a.cx == b.cx && a.cy == b.cy;
}

}  // namespace

TEST_CASE("strategies have names") {
    CHECK(to_string(SweepStrategy::direct) == "direct");
    CHECK(to_string(SweepStrategy::front) == "front");
}

TEST_CASE("one layer has no inner levels") { CHECK(make_level_maps(grid_problem(straight(), {.layers = 1})).empty()); }

TEST_CASE("direct maps are the fits from the caps, blended by k / r") {
    const SweepProblem p = grid_problem(warped(), {.layers = 5});
    const std::vector<LevelMap> maps = make_level_maps(p);
    REQUIRE(maps.size() == 4);
    for (std::size_t k = 1; k < 5; ++k) {
        CHECK(maps[k - 1].blending == static_cast<double>(k) / 5);
        CHECK(same_bits(maps[k - 1].from_source, detail::fit_levels(p, 0, k, {}).map));
        CHECK(same_bits(maps[k - 1].from_target, detail::fit_levels(p, 5, k, {}).map));
    }
}

TEST_CASE("residuals are the distances on the loops") {
    const SweepProblem p = grid_problem(warped());
    for (const double scale : {1e-200, 1.0, 1e200}) {
        const SweepProblem q = moved(p, [=](const Vec3& x) { return Vec3(x * scale); });
        const std::vector<LevelMap> maps = make_level_maps(q);
        for (std::size_t k = 1; k < p.layers; ++k) {
            double largest = 0;
            double squares[2] = {0, 0};
            for (std::size_t i = 0; i < p.loops.nodes.size(); ++i) {
                const Vec3 s = (q.level(k)[i] - maps[k - 1].from_source(q.level(0)[i])) / scale;
                const Vec3 t = (q.level(k)[i] - maps[k - 1].from_target(q.level(p.layers)[i])) / scale;
                largest = std::max({largest, s.norm(), t.norm()});
                squares[0] += s.squaredNorm();
                squares[1] += t.squaredNorm();
            }
            const double m = static_cast<double>(p.loops.nodes.size());
            CHECK(maps[k - 1].residual_max / scale == Approx(largest).epsilon(1e-12));
            CHECK(maps[k - 1].residual_rms / scale == Approx(std::sqrt(std::max(squares[0], squares[1]) / m)));
            CHECK_FALSE(maps[k - 1].exact);
        }
    }
    for (const LevelMap& map : make_level_maps(grid_problem(twisted()))) {
        CHECK(map.residual_max < 1e-14);
        CHECK(map.exact);
    }
}

TEST_CASE("front maps compose the steps of each march; planar affine loops: the same as direct") {
    const SweepProblem p = grid_problem(warped(), {.layers = 6});
    LevelMapOptions front;
    front.strategy = SweepStrategy::front;
    const std::vector<LevelMap> maps = make_level_maps(p, front);
    AffineMap<double, 3> march = AffineMap<double, 3>::identity();
    for (std::size_t k = 1; k < 6; ++k) {
        march = compose(detail::fit_levels(p, k - 1, k, {}).map, march);
        CHECK(gap(march, maps[k - 1].from_source) < 1e-13);
    }
    march = AffineMap<double, 3>::identity();
    for (std::size_t k = 5; k > 0; --k) {
        march = compose(detail::fit_levels(p, k + 1, k, {}).map, march);
        CHECK(gap(march, maps[k - 1].from_target) < 1e-13);
    }
    const SweepProblem affine = grid_problem(twisted());
    const std::vector<LevelMap> a = make_level_maps(affine);
    const std::vector<LevelMap> b = make_level_maps(affine, front);
    for (std::size_t k = 0; k < a.size(); ++k) {
        CHECK(gap(a[k].from_source, b[k].from_source) < 1e-13);
        CHECK(gap(a[k].from_target, b[k].from_target) < 1e-13);
    }
}

TEST_CASE("threads do not change a bit, and a level depends on the caps and itself alone") {
    const SweepProblem p = grid_problem(warped(), {.layers = 9});
    for (const auto strategy : {SweepStrategy::direct, SweepStrategy::front}) {
        LevelMapOptions options;
        options.strategy = strategy;
        const std::vector<LevelMap> one = make_level_maps(p, options);
        options.execution = {4};
        const std::vector<LevelMap> four = make_level_maps(p, options);
        for (std::size_t k = 0; k < one.size(); ++k) {
            CHECK(same_bits(one[k].from_source, four[k].from_source));
            CHECK(same_bits(one[k].from_target, four[k].from_target));
        }
    }
    SweepProblem other = p;
    for (std::size_t i = 0; i < p.loops.nodes.size(); ++i) {
        other.boundary_levels[4 * p.loops.nodes.size() + i] += Vec3(0.1, 0.2 * other.level(4)[i][0], 0.3);
    }
    const std::vector<LevelMap> a = make_level_maps(p);
    const std::vector<LevelMap> b = make_level_maps(other);
    for (std::size_t k = 1; k < 9; ++k) {
        CHECK(same_bits(a[k - 1].from_source, b[k - 1].from_source) == (k != 4));
    }
}

TEST_CASE("blending is checked and used") {
    const SweepProblem p = grid_problem(straight(), {.layers = 3});
    LevelMapOptions options;
    options.blending = {0, 0.2, 0.7, 1};
    CHECK(make_level_maps(p, options)[1].blending == 0.7);
    const auto code = [&](std::vector<double> blending) {
        options.blending = std::move(blending);
        try {
            static_cast<void>(make_level_maps(p, options));
        } catch (const InputError& error) {
            return error.code();
        }
        return ErrorCode::cad_failure;
    };
    CHECK(code({0, 0.5, 1}) == ErrorCode::size_mismatch);
    CHECK(code({0.1, 0.2, 0.7, 1}) == ErrorCode::bad_option);
    CHECK(code({0, 0.2, 0.7, 0.9}) == ErrorCode::bad_option);
    CHECK(code({0, 0.7, 0.2, 1}) == ErrorCode::bad_option);
    CHECK(code({0, std::nan(""), 0.7, 1}) == ErrorCode::bad_option);
}

TEST_CASE("loops that cannot be mapped name their level") {
    SweepProblem p = grid_problem(straight());
    const std::size_t m = p.loops.nodes.size();
    // Level 2 winds twice round: perpendicular to every linear function of the source loop.
    for (std::size_t i = 0; i < m; ++i) {
        const double angle = 4 * std::acos(-1.0) * static_cast<double>(i) / static_cast<double>(m);
        p.boundary_levels[2 * m + i] = {std::cos(angle), std::sin(angle), 1};
    }
    // Levels 0 and r are regular polygons of the same nodes, so that the correlation is null exactly.
    for (const std::size_t k : {0U, 1U, 3U, 4U}) {
        for (std::size_t i = 0; i < m; ++i) {
            const double angle = 2 * std::acos(-1.0) * static_cast<double>(i) / static_cast<double>(m);
            p.boundary_levels[k * m + i] = {std::cos(angle), std::sin(angle), 0.5 * static_cast<double>(k)};
        }
    }
    try {
        static_cast<void>(make_level_maps(p));
        FAIL("accepted");
    } catch (const InputError& error) {
        CHECK(error.code() == ErrorCode::unrelated_loops);
    }
}

TEST_CASE("folding gives the weighted sum of both maps") {
    const SweepProblem p = grid_problem(warped());
    const std::vector<LevelMap> maps = make_level_maps(p);
    const Vec3 cs(0.1, 0.2, 0.3);
    const Vec3 ct(1, 2, 3);
    for (const LevelMap& map : maps) {
        const LevelOperator level = fold(map, cs, ct);
        const Vec3 z0(0.3, -0.4, 0.1);
        const Vec3 zr(0.5, -0.1, 2.6);
        const Vec3 want = (1 - map.blending) * map.from_source(z0) + map.blending * map.from_target(zr);
        for (std::size_t c = 0; c < 3; ++c) {
            double sum = level.centre[c];
            for (std::size_t j = 0; j < 3; ++j) {
                const auto axis = static_cast<Eigen::Index>(j);
                sum += level.linear[j][c] * (z0[axis] - cs[axis]) + level.linear[j + 3][c] * (zr[axis] - ct[axis]);
            }
            CHECK(sum == Approx(want[static_cast<Eigen::Index>(c)]).epsilon(1e-14));
        }
    }
}
