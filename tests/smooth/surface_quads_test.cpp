#include <pavior/core/error.hpp>
#include <pavior/smooth/surface_quads.hpp>

#include "smooth/meshes.hpp"
#include "support/catch.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <cmath>
#include <utility>

using namespace pavior;
using namespace pavior_test;

namespace {

struct Plane {  // any affine parametrisation
    Vec3 du{1, 0, 0}, dv{0, 1, 0};
    Vec3 point(const Vec2& uv) const { return uv.x() * du + uv.y() * dv; }
    std::pair<Vec3, Vec3> derivatives(const Vec2&) const { return {du, dv}; }
};
struct Cylinder {  // u in radians, v along the axis
    double radius;
    Vec3 point(const Vec2& uv) const { return {radius * std::cos(uv.x()), radius * std::sin(uv.x()), uv.y()}; }
    std::pair<Vec3, Vec3> derivatives(const Vec2& uv) const {
        return {Vec3(-radius * std::sin(uv.x()), radius * std::cos(uv.x()), 0), Vec3(0, 0, 1)};
    }
};
struct Sphere {  // longitude, latitude
    double radius;
    Vec3 point(const Vec2& uv) const {
        return radius *
               Vec3(std::cos(uv.x()) * std::cos(uv.y()), std::sin(uv.x()) * std::cos(uv.y()), std::sin(uv.y()));
    }
    std::pair<Vec3, Vec3> derivatives(const Vec2& uv) const {
        return {radius * Vec3(-std::sin(uv.x()) * std::cos(uv.y()), std::cos(uv.x()) * std::cos(uv.y()), 0),
                radius *
                    Vec3(-std::cos(uv.x()) * std::sin(uv.y()), -std::sin(uv.x()) * std::sin(uv.y()), std::cos(uv.y()))};
    }
};
struct Saddle {  // over a skewed and badly scaled plane
    Vec3 point(const Vec2& uv) const {
        const double x = 1000 * uv.x() + 0.3 * uv.y();
        const double y = 0.1 * uv.y();
        return {x, y, 0.3 * (x * x - y * y)};
    }
    std::pair<Vec3, Vec3> derivatives(const Vec2& uv) const {
        const double x = 1000 * uv.x() + 0.3 * uv.y();
        const double y = 0.1 * uv.y();
        return {Vec3(1000, 0, 600 * x), Vec3(0.3, 0.1, 0.3 * (0.6 * x - 0.2 * y))};
    }
};

template <class S>
std::vector<Vec3> in_space(const S& surface, std::span<const Vec2> uv) {
    std::vector<Vec3> x;
    for (const Vec2& p : uv) {
        x.push_back(surface.point(p));
    }
    return x;
}

// Folded in the plane or in space about the normal in the middle; straight from the definition.
template <class S>
std::size_t count_folded(const S& surface, std::span<const Vec2> uv, std::span<const QuadCorners> quads,
                         bool reversed = false) {
    const std::vector<Vec3> x = in_space(surface, uv);
    std::size_t count = 0;
    for (QuadCorners q : quads) {
        if (reversed) {
            std::swap(q[1], q[3]);
        }
        const auto d = surface.derivatives(0.25 * (uv[q[0]] + uv[q[1]] + uv[q[2]] + uv[q[3]]));
        const Vec3 normal = d.first.cross(d.second);
        bool folded = inverted(uv, q);
        for (std::size_t k = 0; k < 4; ++k) {
            folded = folded || !((x[q[(k + 1) % 4]] - x[q[k]]).cross(x[q[(k + 3) % 4]] - x[q[k]]).dot(normal) > 0.0);
        }
        count += folded ? 1U : 0U;
    }
    return count;
}

// A grid in the parameter box [low, high].
QuadGrid box(Index nx, Index ny, const Vec2& low, const Vec2& high) {
    QuadGrid grid = quad_grid(nx, ny);
    for (Vec2& x : grid.nodes) {
        x = low + x.cwiseQuotient(Vec2(nx, ny)).cwiseProduct(high - low);
    }
    return grid;
}

void tangle(QuadGrid& grid, const Vec2& amount, unsigned seed) {
    Random random(seed);
    for (std::size_t i = 0; i < grid.nodes.size(); ++i) {
        if (grid.fixed[i] == 0) {
            grid.nodes[i] += Vec2(random(-amount.x(), amount.x()), random(-amount.y(), amount.y()));
        }
    }
}

template <class S>
void check_repaired(const S& surface, QuadGrid grid, const Vec2& amount, double wanted_det) {
    for (unsigned seed = 0; seed < 4; ++seed) {
        CAPTURE(seed);
        QuadGrid tangled = grid;
        tangle(tangled, amount, seed);
        const QuadGrid before = tangled;
        const std::size_t folded = count_folded(surface, before.nodes, before.quads);
        REQUIRE(folded > 10);
        const SmoothReport report =
            untangle_surface_quads(surface, std::span<Vec2>(tangled.nodes), tangled.quads, tangled.fixed);
        CHECK(report.inverted_before == folded);
        CHECK(report.status == SmoothStatus::repaired);
        CHECK(count_folded(surface, tangled.nodes, tangled.quads) == 0);
        CHECK(report.min_det_after > wanted_det);
        CHECK(fixed_kept(before, tangled));
    }
}

}  // namespace

TEST_CASE("tangles on a cylinder, however its parameters are scaled", "[surface_quads]") {
    check_repaired(Cylinder{1.0}, box(14, 10, {0, 0}, {1.4, 1.0}), {0.3, 0.3}, 0.05);
    check_repaired(Cylinder{100.0}, box(14, 10, {0, 0}, {0.02, 1.4}), {0.004, 0.3}, 0.05);
    check_repaired(Cylinder{1e-3}, box(14, 10, {0, 0}, {2.8, 0.002}), {0.6, 0.0006}, 0.05);
}

TEST_CASE("tangles on a sphere and on a saddle", "[surface_quads]") {
    check_repaired(Sphere{10.0}, box(12, 12, {0.2, -0.6}, {1.4, 0.8}), {0.3, 0.3}, 0.05);
    check_repaired(Saddle{}, box(12, 12, {-0.001, -10}, {0.001, 10}), {0.0004, 4.0}, 0.02);
}

TEST_CASE("a quad mesh on a surface that is not folded is not touched", "[surface_quads]") {
    QuadGrid grid = box(8, 8, {0.2, -0.6}, {1.4, 0.8});
    tangle(grid, {0.02, 0.02}, 1);
    const QuadGrid before = grid;
    REQUIRE(count_folded(Sphere{2.0}, grid.nodes, grid.quads) == 0);
    const SmoothReport report =
        untangle_surface_quads(Sphere{2.0}, std::span<Vec2>(grid.nodes), grid.quads, grid.fixed);
    CHECK(report.status == SmoothStatus::unchanged);
    CHECK(grid.nodes == before.nodes);
    CHECK(report.min_det_before > 0.5);
}

TEST_CASE("lengths are measured in space: the parametrisation does not matter", "[surface_quads]") {
    // One square in space, parametrised by the identity and by a skewed affine map.
    Plane skewed;
    skewed.du = Vec3(50, 0, 0);
    skewed.dv = Vec3(0.3, 0.01, 0);
    Eigen::Matrix2d A;
    A << 50, 0.3, 0, 0.01;
    QuadGrid plain = quad_grid(10, 10);
    shake(plain, 1.1, 3);
    QuadGrid other = plain;
    for (Vec2& x : other.nodes) {
        x = A.inverse() * x;
    }
    UntangleOptions options;
    options.local = false;
    untangle_surface_quads(Plane{}, std::span<Vec2>(plain.nodes), plain.quads, plain.fixed, options);
    untangle_surface_quads(skewed, std::span<Vec2>(other.nodes), other.quads, other.fixed, options);
    for (std::size_t i = 0; i < plain.nodes.size(); ++i) {
        CHECK((A * other.nodes[i] - plain.nodes[i]).norm() < 0.02);
    }
}

TEST_CASE("reversed quads on a surface", "[surface_quads]") {
    const Cylinder surface{2.0};
    QuadGrid grid = box(10, 10, {0, 0}, {1, 2});
    for (QuadCorners& q : grid.quads) {
        std::swap(q[1], q[3]);
    }
    UntangleOptions options;
    options.reversed = true;
    QuadGrid copy = grid;
    CHECK(untangle_surface_quads(surface, std::span<Vec2>(copy.nodes), copy.quads, copy.fixed, options).status ==
          SmoothStatus::unchanged);
    copy.nodes[60] += Vec2(0.3, 0.5);
    CHECK(untangle_surface_quads(surface, std::span<Vec2>(copy.nodes), copy.quads, copy.fixed, options).status ==
          SmoothStatus::repaired);
    CHECK(count_folded(surface, copy.nodes, copy.quads, true) == 0);
    QuadGrid unaware = grid;
    CHECK(
        untangle_surface_quads(surface, std::span<Vec2>(unaware.nodes), unaware.quads, unaware.fixed).inverted_before ==
        100);
}

TEST_CASE("surface quads take the shape of the reference", "[surface_quads]") {
    // Columns of unequal width: squares would even them out.
    QuadGrid grid = box(12, 6, {0, 0}, {1.2, 0.6});
    for (Vec2& x : grid.nodes) {
        x.x() = 1.2 * (x.x() / 1.2) * (x.x() / 1.2) * 0.7 + 0.3 * x.x();
    }
    const Cylinder surface{1.0};
    const std::vector<Vec3> reference = in_space(surface, grid.nodes);
    QuadGrid tangled = grid;
    tangle(tangled, {0.15, 0.15}, 5);
    UntangleOptions options;
    options.local = false;
    options.sufficient_det = 0.0;
    const SmoothReport report = untangle_surface_quads(surface, std::span<Vec2>(tangled.nodes), tangled.quads,
                                                       tangled.fixed, options, reference);
    CHECK(report.status == SmoothStatus::repaired);
    for (std::size_t i = 0; i < grid.nodes.size(); ++i) {
        CHECK((tangled.nodes[i] - grid.nodes[i]).norm() < 0.01);
    }
}

TEST_CASE("a surface that is singular at a corner of the cap", "[surface_quads]") {
    // The parameter box reaches the pole of the sphere.
    const double pole = std::acos(0.0);
    const Sphere surface{1.0};
    QuadGrid grid = box(8, 8, {0, 0.4}, {1.5, pole - 1e-3});
    tangle(grid, {0.25, 0.2}, 9);
    REQUIRE(count_folded(surface, grid.nodes, grid.quads) > 5);
    const SmoothReport report = untangle_surface_quads(surface, std::span<Vec2>(grid.nodes), grid.quads, grid.fixed);
    CHECK(report.status == SmoothStatus::repaired);
    CHECK(count_folded(surface, grid.nodes, grid.quads) == 0);
}

TEST_CASE("a fold of the boundary is reported on a surface", "[surface_quads]") {
    const Cylinder surface{3.0};
    QuadGrid grid = box(8, 8, {0, 0}, {0.8, 2.4});
    grid.nodes[0] = Vec2(0.09, 0.27);
    const QuadGrid before = grid;
    const SmoothReport report = untangle_surface_quads(surface, std::span<Vec2>(grid.nodes), grid.quads, grid.fixed);
    CHECK(report.status == SmoothStatus::still_inverted);
    CHECK(report.inverted_ids == std::vector<Index>{0});
    CHECK(fixed_kept(before, grid));
}

TEST_CASE("always improves quads on a surface, by the same bytes for any number of threads", "[surface_quads]") {
    const Sphere surface{1.0};
    QuadGrid one = box(40, 40, {0.2, -0.6}, {1.4, 0.8});
    tangle(one, {0.1, 0.1}, 2);
    QuadGrid four = one;
    UntangleOptions options;
    options.always = true;
    const SmoothReport report =
        untangle_surface_quads(surface, std::span<Vec2>(one.nodes), one.quads, one.fixed, options);
    options.execution = Execution{4};
    untangle_surface_quads(surface, std::span<Vec2>(four.nodes), four.quads, four.fixed, options);
    CHECK(report.inverted_after == 0);
    CHECK(report.min_det_after > 0.9);
    CHECK(one.nodes == four.nodes);
}

TEST_CASE("surface quads: callers' mistakes", "[surface_quads]") {
    QuadGrid grid = quad_grid(3, 3);
    const auto code_of = [](QuadGrid given, std::vector<Vec3> reference) {
        try {
            untangle_surface_quads(Plane{}, std::span<Vec2>(given.nodes), given.quads, given.fixed, {}, reference);
        } catch (const InputError& error) {
            return error.code();
        }
        return ErrorCode::unreadable_file;
    };
    CHECK(code_of(grid, std::vector<Vec3>(3, Vec3::Zero())) == ErrorCode::size_mismatch);
    grid.fixed.pop_back();
    CHECK(code_of(grid, {}) == ErrorCode::size_mismatch);
    grid = quad_grid(3, 3);
    grid.quads[0][3] = 99;
    CHECK(code_of(grid, {}) == ErrorCode::bad_index);
    grid = quad_grid(3, 3);
    grid.nodes[4].x() = NAN;
    CHECK(code_of(grid, {}) == ErrorCode::not_finite);
}
