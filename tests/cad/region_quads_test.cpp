#include "support/catch.hpp"

#include <pavior/cad/region_quads.hpp>
#include <pavior/core/error.hpp>
#include <pavior/mesh/boundary_loops.hpp>
#include <pavior/mesh/span_mesh.hpp>
#include <pavior/mesh/verify_quads.hpp>

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

using namespace pavior;

namespace {

/// Appends a rectangle with n intervals a side, clockwise if asked for.
void add_rectangle(PlaneRegion& region, const Vec2& low, const Vec2& high, std::size_t n, bool hole) {
    std::vector<Vec2> corners{low, {high[0], low[1]}, high, {low[0], high[1]}};
    if (hole) {
        std::swap(corners[1], corners[3]);
    }
    for (std::size_t k = 0; k < 4; ++k) {
        for (std::size_t i = 0; i < n; ++i) {
            const double t = static_cast<double>(i) / static_cast<double>(n);
            region.points.emplace_back((1 - t) * corners[k] + t * corners[(k + 1) % 4]);
        }
    }
    region.offsets.push_back(region.points.size());
}

void verify(const PlaneRegion& region, const PlaneQuadMesh& mesh, double area) {
    QuadMesh quads{{}, mesh.quads};
    for (const Vec2& x : mesh.nodes) {
        quads.nodes.emplace_back(x[0], x[1], 0);
    }
    CHECK(verify_quads(quads).ok());
    CHECK(boundary_loops(quads).nodes.size() == region.points.size());
    for (std::size_t i = 0; i < region.points.size(); ++i) {
        CHECK(mesh.nodes[i] == region.points[i]);
    }
    double sum = 0;
    for (const QuadCorners& q : mesh.quads) {
        const Vec2 a = mesh.nodes[q[2]] - mesh.nodes[q[0]];
        const Vec2 b = mesh.nodes[q[3]] - mesh.nodes[q[1]];
        sum += 0.5 * (a[0] * b[1] - a[1] * b[0]);
    }
    CHECK(sum == Approx(area));
}

/// The least sine of a corner angle.
double least_corner(const PlaneQuadMesh& mesh) {
    double least = 1;
    for (const QuadCorners& q : mesh.quads) {
        for (std::size_t k = 0; k < 4; ++k) {
            const Vec2 a = (mesh.nodes[q[(k + 1) % 4]] - mesh.nodes[q[k]]).normalized();
            const Vec2 b = (mesh.nodes[q[(k + 3) % 4]] - mesh.nodes[q[k]]).normalized();
            least = std::min(least, a[0] * b[1] - a[1] * b[0]);
        }
    }
    return least;
}

}  // namespace

TEST_CASE("a rectangle becomes a grid") {
    PlaneRegion region;
    add_rectangle(region, {100, 200}, {103, 201}, 5, false);
    const PlaneQuadMesh mesh = mesh_region(region);
    CHECK(mesh.quads.size() == 25);
    verify(region, mesh, 3);
}

TEST_CASE("a region with a hole is filled between its nodes") {
    PlaneRegion region;
    add_rectangle(region, {0, 0}, {10, 10}, 8, false);
    add_rectangle(region, {3, 3}, {6, 5}, 3, true);
    const PlaneQuadMesh mesh = mesh_region(region);
    verify(region, mesh, 94);
    RegionOptions fine;
    fine.size = 0.5;
    CHECK(mesh_region(region, fine).quads.size() > mesh.quads.size());
}

TEST_CASE("triangles with unlike numbers of intervals are filled") {
    const std::vector<std::array<std::size_t, 3>> numbers{{1, 4, 1}, {2, 7, 3}, {1, 1, 10}, {3, 12, 1}, {2, 2, 20}};
    for (const auto& n : numbers) {
        CAPTURE(n[0], n[1], n[2]);
        const std::array<Vec2, 3> corners{Vec2(5, 3), Vec2(6, 3), Vec2(5.2, 4)};
        PlaneRegion region;
        for (std::size_t k = 0; k < 3; ++k) {
            for (std::size_t i = 0; i < n[k]; ++i) {
                const double t = static_cast<double>(i) / static_cast<double>(n[k]);
                region.points.emplace_back((1 - t) * corners[k] + t * corners[(k + 1) % 3]);
            }
        }
        region.offsets.push_back(region.points.size());
        const PlaneQuadMesh mesh = mesh_region(region);
        verify(region, mesh, 0.5);
        CHECK(least_corner(mesh) > 0.05);
    }
}

TEST_CASE("regions that are none are refused") {
    PlaneRegion region;
    add_rectangle(region, {0, 0}, {1, 1}, 1, true);
    CHECK_THROWS_WITH(mesh_region(region), Catch::Contains("counter-clockwise"));
    region = {};
    add_rectangle(region, {0, 0}, {1, 1}, 1, false);
    region.points.emplace_back(-1, 0.5);
    CHECK_THROWS_AS(mesh_region(region), InputError);
    region.offsets.back() = 5;
    CHECK_THROWS_AS(mesh_region(region), InputError);  // odd
    region.points.back()[0] = std::numeric_limits<double>::infinity();
    CHECK_THROWS_AS(mesh_region(region), InputError);
}
