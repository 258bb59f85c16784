#include "support/catch.hpp"

#include <pavior/sweep/transfinite.hpp>

#include <pavior/math/point.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <limits>
#include <vector>

using namespace pavior;

namespace {

std::vector<Vec3> points(const nlohmann::json& list) {
    std::vector<Vec3> out;
    for (const auto& p : list) {
        out.emplace_back(p[0].get<double>(), p[1].get<double>(), p[2].get<double>());
    }
    return out;
}

template <class P>
struct OwnedSides {
    std::vector<P> bottom, top, left, right;
    [[nodiscard]] GridSides<P> view() const { return {bottom, top, left, right}; }
};

/// The sides of the image of the unit square, at the given parameters.
template <class P>
OwnedSides<P> sides_of(const std::function<P(double, double)>& f, const std::vector<double>& s,
                       const std::vector<double>& t) {
    OwnedSides<P> sides;
    for (const double x : s) {
        sides.bottom.push_back(f(x, 0.0));
        sides.top.push_back(f(x, 1.0));
    }
    for (const double y : t) {
        sides.left.push_back(f(0.0, y));
        sides.right.push_back(f(1.0, y));
    }
    return sides;
}

std::vector<double> uniform(std::size_t n) {
    std::vector<double> t(n + 1);
    for (std::size_t i = 0; i <= n; ++i) {
        t[i] = static_cast<double>(i) / static_cast<double>(n);
    }
    return t;
}

template <class P>
ErrorCode code_of(const OwnedSides<P>& sides) {
    try {
        static_cast<void>(transfinite(sides.view()));
    } catch (const InputError& error) {
        return error.code();
    }
    FAIL("no error");
    return ErrorCode::overflow;
}

Vec2 ruled(double s, double t) { return {3.0 * s + std::sin(4.0 * s) * (1.0 - t) + t * s * s, 2.0 * t + s * t + s}; }

}  // namespace

TEST_CASE("the linking side of the case file comes out to its tolerance") {
    std::ifstream file(PAVIOR_TEST_DATA "/sweep/h26_tfi.json");
    REQUIRE(file);
    const auto data = nlohmann::json::parse(file);
    const OwnedSides<Vec3> sides{points(data["bottom"]), points(data["top"]), points(data["left"]),
                                 points(data["right"])};
    const StructuredGrid<Vec3> grid = transfinite(sides.view());
    REQUIRE(grid.rows + 1 == data["expected"].size());
    double error = 0.0;
    for (std::size_t k = 0; k <= grid.rows; ++k) {
        const std::vector<Vec3> row = points(data["expected"][k]);
        REQUIRE(grid.columns + 1 == row.size());
        for (std::size_t i = 0; i <= grid.columns; ++i) {
            error = std::max(error, (grid(i, k) - row[i]).cwiseAbs().maxCoeff());
        }
    }
    CHECK(error <= data["tol_abs"].get<double>());
}

TEST_CASE("a ruled patch is reproduced, in the plane and in space") {
    // Affine in t for every s: the Coons patch is the surface itself.
    const std::function<Vec2(double, double)> plane = ruled;
    const std::function<Vec3(double, double)> space = [](double s, double t) {
        return Vec3(ruled(s, t).x(), ruled(s, t).y(), s * s * s * (1.0 + t));
    };
    const auto grid2 = transfinite(sides_of(plane, uniform(9), uniform(5)).view());
    const auto grid3 = transfinite(sides_of(space, uniform(9), uniform(5)).view());
    for (std::size_t k = 0; k <= 5; ++k) {
        for (std::size_t i = 0; i <= 9; ++i) {
            const double s = static_cast<double>(i) / 9.0;
            const double t = static_cast<double>(k) / 5.0;
            CHECK((grid2(i, k) - plane(s, t)).norm() < 1e-14);
            CHECK((grid3(i, k) - space(s, t)).norm() < 1e-14);
        }
    }
}

TEST_CASE("side nodes are copied bit by bit, the smallest grids too") {
    const std::function<Vec2(double, double)> f = [](double s, double t) {
        return Vec2(std::cos(s) + t * t / 3.0, std::sin(2.0 * s * t) + t / 7.0);
    };
    for (const std::size_t m : {1U, 2U, 5U}) {
        for (const std::size_t r : {1U, 3U}) {
            const auto sides = sides_of(f, uniform(m), uniform(r));
            for (const Blending blending : {Blending::uniform, Blending::arc_length}) {
                const auto grid = transfinite(sides.view(), {blending, 1e-8});
                for (std::size_t i = 0; i <= m; ++i) {
                    CHECK(grid(i, 0) == sides.bottom[i]);
                    CHECK(grid(i, r) == sides.top[i]);
                }
                for (std::size_t k = 0; k <= r; ++k) {
                    CHECK(grid(0, k) == sides.left[k]);
                    CHECK(grid(m, k) == sides.right[k]);
                }
            }
        }
    }
}

TEST_CASE("arc-length blending reproduces a graded bilinear patch, uniform blending does not") {
    const std::vector<double> s{0.0, 0.05, 0.15, 0.4, 1.0};
    const std::vector<double> t{0.0, 0.5, 0.8, 0.9, 1.0};
    const std::function<Vec2(double, double)> bilinear = [](double x, double y) {
        return Vec2(2.0 * x + x * y, y + 0.5 * x * y);
    };
    const auto sides = sides_of(bilinear, s, t);
    const auto error = [&](Blending blending) {
        const auto grid = transfinite(sides.view(), {blending, 1e-8});
        double worst = 0.0;
        for (std::size_t k = 0; k < t.size(); ++k) {
            for (std::size_t i = 0; i < s.size(); ++i) {
                worst = std::max(worst, (grid(i, k) - bilinear(s[i], t[k])).norm());
            }
        }
        return worst;
    };
    CHECK(error(Blending::arc_length) < 1e-14);
    CHECK(error(Blending::uniform) > 0.01);
}

TEST_CASE("a side of length 0 makes a triangle") {
    const std::function<Vec2(double, double)> f = [](double s, double t) { return Vec2(s * (1.0 - t), t); };
    for (const Blending blending : {Blending::uniform, Blending::arc_length}) {
        const auto grid = transfinite(sides_of(f, uniform(4), uniform(4)).view(), {blending, 1e-8});
        CHECK((grid(2, 2) - Vec2(0.25, 0.5)).norm() < 1e-15);
        CHECK(grid(3, 4) == Vec2(0.0, 1.0));
    }
}

TEST_CASE("quads of a grid: ids, corners, orientation") {
    const auto quads = structured_quads(3, 2);
    REQUIRE(quads.size() == 6);
    CHECK(quads[0] == QuadCorners{0, 1, 5, 4});
    CHECK(quads[5] == QuadCorners{6, 7, 11, 10});
    CHECK(StructuredGrid<Vec2>(3, 2).nodes.size() == 12);
}

TEST_CASE("sides that do not fit are refused") {
    const std::function<Vec2(double, double)> f = ruled;
    const auto good = sides_of(f, uniform(3), uniform(2));
    auto bad = good;
    bad.top.pop_back();
    CHECK(code_of(bad) == ErrorCode::size_mismatch);
    bad = good;
    bad.left.push_back(bad.left.back());
    CHECK(code_of(bad) == ErrorCode::size_mismatch);
    bad = good;
    bad.bottom.resize(1);
    bad.top.resize(1);
    CHECK(code_of(bad) == ErrorCode::empty_input);
    bad = good;
    bad.right[1].x() = std::numeric_limits<double>::quiet_NaN();
    CHECK(code_of(bad) == ErrorCode::not_finite);
    bad = good;
    bad.right.back() += Vec2(0.1, 0.0);
    bad.left.front() += Vec2(0.1, 0.0);
    try {
        static_cast<void>(transfinite(bad.view()));
        FAIL("no error");
    } catch (const InputError& error) {
        CHECK(error.code() == ErrorCode::inconsistent_boundary);
        CHECK(error.ids() == std::vector<std::int64_t>{0, 2});
    }
    CHECK_NOTHROW(transfinite(bad.view(), {Blending::uniform, 1.0}));
}
