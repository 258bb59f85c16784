#include "support/catch.hpp"

#include <pavior/cad/region_quads.hpp>
#include <pavior/core/error.hpp>
#include <pavior/mesh/boundary_loops.hpp>
#include <pavior/mesh/span_mesh.hpp>
#include <pavior/mesh/verify_quads.hpp>

#include <limits>

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
