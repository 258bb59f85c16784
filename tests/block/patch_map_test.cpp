#include "support/catch.hpp"

#include <pavior/block/chain_curve.hpp>
#include <pavior/block/detail/mean_value.hpp>
#include <pavior/block/patch_map.hpp>
#include <pavior/core/error.hpp>

#include <random>

using pavior::ErrorCode;
using pavior::Index;
using pavior::InputError;
using pavior::PatchDisc;
using pavior::PatchMap;
using pavior::TriCorners;
using pavior::Vec2;
using pavior::Vec3;

namespace {

/// n x m squares over [0, 1]^2 in two triangles each, placed by f; four sides.
template <class F>
PatchDisc grid(Index n, Index m, const F& f) {
    PatchDisc disc;
    const auto at = [&](Index i, Index j) { return j * (n + 1) + i; };
    for (Index j = 0; j <= m; ++j) {
        for (Index i = 0; i <= n; ++i) {
            disc.points.push_back(f(double(i) / n, double(j) / m));
        }
    }
    for (Index j = 0; j < m; ++j) {
        for (Index i = 0; i < n; ++i) {
            disc.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
            disc.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
        }
    }
    disc.sides.resize(4);
    for (Index i = 0; i <= n; ++i) {
        disc.sides[0].push_back(at(i, 0));
        disc.sides[2].push_back(at(n - i, m));
    }
    for (Index j = 0; j <= m; ++j) {
        disc.sides[1].push_back(at(n, j));
        disc.sides[3].push_back(at(0, m - j));
    }
    return disc;
}

/// Sum over a lattice of triangles of the polygon of how often their images turn the other way than `normal`.
template <class Normal>
int folds(const PatchMap& map, const Normal& normal) {
    const auto corner = [&](std::size_t s) { return map.polygon()[s % map.polygon().size()]; };
    int count = 0;
    constexpr int n = 12;
    for (std::size_t s = 0; s < map.polygon().size(); ++s) {
        const auto at = [&](int i, int j) {
            const double u = double(i) / n;
            const double v = double(j) / n;
            return map.at(map.middle() + u * (corner(s) - map.middle()) + v * (corner(s + 1) - map.middle()));
        };
        for (int i = 0; i < n; ++i) {
            for (int j = 0; i + j < n; ++j) {
                const Vec3 a = at(i, j);
                const Vec3 turn = (at(i + 1, j) - a).cross(at(i, j + 1) - a);
                count += turn.dot(normal(a)) > 0 ? 0 : 1;
            }
        }
    }
    return count;
}

Vec3 up(const Vec3& /*x*/) { return Vec3::UnitZ(); }

}  // namespace

TEST_CASE("a convex plane polygon is its own domain", "[patch_map]") {
    const auto place = [](double u, double v) { return Vec3(3 * u + u * v, 2 * v, 1 + 3 * u + u * v); };
    const PatchMap map(grid(3, 2, place));
    REQUIRE(map.rigid());
    REQUIRE(map.polygon().size() == 4);
    CHECK((map.at(map.polygon()[2]) - place(1, 1)).norm() < 1e-12);
    const Vec3 side = 0.7 * place(1, 0) + 0.3 * place(1, 1);
    CHECK((map.at(map.side(1, 0.3)) - side).norm() < 1e-12);
    CHECK((map.at(map.nearest(map.centroid())) - map.centroid()).norm() < 1e-12);
    CHECK((map.polygon()[1] - map.polygon()[0]).norm() == Approx(3 * std::sqrt(2.0)));
}

TEST_CASE("corners and sides go to corners and sides by arc length", "[patch_map]") {
    const auto place = [](double u, double v) {  // quarter of a ring
        const double a = 1.5 * u;
        return Vec3((2 - v) * std::sin(a), (v - 2) * std::cos(a), 0);
    };
    const PatchMap map(grid(12, 3, place));
    REQUIRE_FALSE(map.rigid());
    for (std::size_t s = 0; s < 4; ++s) {
        const Vec3 corner = place(s == 1 || s == 2 ? 1 : 0, s >= 2 ? 1 : 0);
        CHECK((map.at(map.polygon()[s]) - corner).norm() < 1e-9);
    }
    CHECK((map.at(map.side(0, 0.5)) - place(0.5, 0)).norm() < 1e-9);
    CHECK((map.at(map.side(2, 0.25)) - place(0.75, 1)).norm() < 1e-9);
    CHECK(folds(map, up) == 0);
}

TEST_CASE("coarse triangles with three corners on one side are no obstacle", "[patch_map]") {
    // Half a disc as a fan from one end of its arc: every inner edge joins two points of the arc.
    PatchDisc disc;
    constexpr Index n = 16;
    for (Index i = 0; i <= n; ++i) {
        disc.points.emplace_back(std::cos(M_PI * i / n), std::sin(M_PI * i / n), 0);
    }
    for (Index i = 1; i < n; ++i) {
        disc.triangles.push_back({0, i, i + 1});
    }
    disc.sides.resize(3);
    for (Index i = 0; i <= n; ++i) {
        disc.sides[i < n / 2 ? 0 : 1].push_back(i);
        if (i == n / 2) {
            disc.sides[0].push_back(i);
        }
    }
    disc.sides[2] = {n, 0};
    const PatchMap map(disc);
    CHECK(folds(map, up) == 0);
    CHECK(map.at(map.middle())[1] > 0.1);
}

TEST_CASE("random bumpy discs are mapped one to one", "[patch_map]") {
    std::mt19937 random(GENERATE(1U, 2U, 3U, 4U, 5U, 6U));
    std::uniform_real_distribution<double> noise(-1, 1);
    const auto place = [&](double u, double v) {
        return Vec3(u + 0.02 * noise(random), v + 0.02 * noise(random),
                    0.3 * std::sin(5 * u) * v + 0.02 * noise(random));
    };
    const PatchMap map(grid(7, 9, place));
    CHECK(folds(map, up) == 0);
    for (int i = 0; i < 50; ++i) {
        const Vec2 uv = map.middle() + 0.4 * Vec2(noise(random), noise(random));
        CHECK((map.nearest(map.at(uv)) - uv).norm() < 1e-6);
    }
}

TEST_CASE("points stay on the triangles of the surface", "[patch_map]") {
    const auto place = [](double u, double v) { return Vec3(std::cos(2 * u), std::sin(2 * u), v); };  // prism
    const PatchDisc disc = grid(5, 1, place);
    const PatchMap map(disc);
    for (int i = 0; i <= 40; ++i) {
        for (int j = 0; j <= 10; ++j) {
            const Vec2 low = (1 - i / 40.0) * map.polygon()[0] + i / 40.0 * map.polygon()[1];
            const Vec2 high = (1 - i / 40.0) * map.polygon()[3] + i / 40.0 * map.polygon()[2];
            const Vec2 uv = (1 - j / 10.0) * low + j / 10.0 * high;
            const Vec3 x = map.at(uv);
            const TriCorners& c = disc.triangles[map.triangle_at(uv)];
            const Vec3 normal = (disc.points[c[1]] - disc.points[c[0]]).cross(disc.points[c[2]] - disc.points[c[0]]);
            CHECK(std::abs((x - disc.points[c[0]]).dot(normal.normalized())) < 1e-9);
        }
    }
}

TEST_CASE("the map moves and scales with the patch", "[patch_map]") {
    const auto place = [](double u, double v) { return Vec3(u, v, 0.4 * u * u + 0.3 * v * v); };
    const double scale = GENERATE(1e-9, 1.0, 1e9);
    const Vec3 shift = scale * Vec3(3, -2, 5);
    const PatchMap map(grid(4, 4, place));
    const PatchMap other(grid(4, 4, [&](double u, double v) { return Vec3(scale * place(u, v) + shift); }));
    for (int i = 1; i < 10; ++i) {
        const Vec2 uv = 0.1 * i * map.polygon()[2];
        CHECK((other.at(scale * uv) - shift - scale * map.at(uv)).norm() < 1e-6 * scale);
    }
}

TEST_CASE("what is no disc over its sides is refused", "[patch_map]") {
    const auto flat = [](double u, double v) { return Vec3(u, v, 0); };
    const auto code = [](const PatchDisc& disc) {
        try {
            PatchMap map(disc);
        } catch (const InputError& error) {
            return error.code();
        }
        return ErrorCode::empty_input;
    };
    PatchDisc disc = grid(3, 3, flat);
    CHECK(code(disc) == ErrorCode::empty_input);
    disc.sides[3].push_back(0);  // the side goes on
    CHECK(code(disc) == ErrorCode::invalid_dual);
    disc = grid(3, 3, flat);
    disc.triangles.erase(disc.triangles.begin() + 8, disc.triangles.begin() + 10);  // a hole
    CHECK(code(disc) == ErrorCode::invalid_dual);
    disc = grid(3, 3, flat);
    disc.triangles[0][0] = 99;
    CHECK(code(disc) == ErrorCode::bad_index);
    disc = grid(3, 3, flat);
    disc.sides.pop_back();
    disc.sides.pop_back();
    CHECK(code(disc) == ErrorCode::size_mismatch);
}

TEST_CASE("polygons in a circle have sides of the lengths asked for", "[patch_map]") {
    const auto polygon = pavior::detail::cyclic_polygon({3, 2, 3, 2});
    for (std::size_t s = 0; s < 4; ++s) {
        CHECK((polygon[(s + 1) % 4] - polygon[s]).norm() == Approx(s % 2 == 0 ? 3 : 2));
    }
    CHECK((polygon[2] - polygon[0]).norm() == Approx(std::sqrt(13.0)));
    const auto flat = pavior::detail::cyclic_polygon({1, 1, 1.999, 0, 1e-3});  // no such polygon contains its centre
    double area = 0;
    for (std::size_t s = 0; s < flat.size(); ++s) {
        const Vec2& a = flat[s];
        const Vec2& b = flat[(s + 1) % flat.size()];
        const Vec2& c = flat[(s + 2) % flat.size()];
        area += a[0] * b[1] - a[1] * b[0];
        CHECK((b - a)[0] * (c - b)[1] - (b - a)[1] * (c - b)[0] > 0);  // strictly convex
    }
    CHECK(area > 0.5);
}
