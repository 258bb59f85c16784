// The headers of block/detail/, each called as the room calls it.
#include "support/block_cases.hpp"
#include "support/catch.hpp"

#include <pavior/block/block_geometry.hpp>
#include <pavior/block/detail/block_curves.hpp>
#include <pavior/block/detail/block_lattice.hpp>
#include <pavior/block/detail/disc_refinement.hpp>
#include <pavior/block/detail/nearest_weights.hpp>
#include <pavior/block/detail/triangle_locator.hpp>
#include <pavior/block/dualize.hpp>
#include <pavior/block/place_blocks.hpp>
#include <pavior/block/sheet_intervals.hpp>

#include <algorithm>
#include <set>

using namespace pavior;

namespace {

// A unit square in two triangles, its corners numbered as its sides.
detail::Disc square() {
    return {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}},
            {{0, 1, 2}, {0, 2, 3}},
            {0, 1},
            {{0, 0.0}, {1, 0.0}, {2, 0.0}, {3, 0.0}},
            4};
}

}  // namespace

TEST_CASE("the nearest point of a triangle: inside, on an edge, at a corner, and of a flat one") {
    const Vec3 a(0, 0, 0), b(2, 0, 0), c(0, 2, 0);
    CHECK((detail::nearest_weights({0.5, 0.5, 7}, a, b, c) - Eigen::Vector3d(0.5, 0.25, 0.25)).norm() < 1e-15);
    CHECK((detail::nearest_weights({3, 3, 1}, a, b, c) - Eigen::Vector3d(0, 0.5, 0.5)).norm() < 1e-15);
    CHECK(detail::nearest_weights({-1, -2, 0}, a, b, c) == Eigen::Vector3d(1, 0, 0));
    CHECK((detail::nearest_weights({0.5, 1, 0}, a, b, b) - Eigen::Vector3d(0.75, 0.25, 0)).norm() < 1e-15);
}

TEST_CASE("triangles of the plane are found by the points that they hold") {
    std::vector<Vec2> uv;
    std::vector<TriCorners> triangles;
    for (Index j = 0; j <= 4; ++j) {
        for (Index i = 0; i <= 4; ++i) {
            uv.emplace_back(i, j);
            if (i < 4 && j < 4) {
                const Index n = 5 * j + i;
                triangles.push_back({n, n + 1, n + 6});
                triangles.push_back({n, n + 6, n + 5});
            }
        }
    }
    const detail::TriangleLocator locator(uv, triangles);
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        const TriCorners& c = triangles[t];
        const Vec2 inside = 0.5 * uv[c[0]] + 0.3 * uv[c[1]] + 0.2 * uv[c[2]];
        const auto hit = locator.locate(inside);
        CHECK(hit.triangle == t);
        CHECK((hit.weights - Eigen::Vector3d(0.5, 0.3, 0.2)).norm() < 1e-12);
    }
    CHECK(locator.locate({2.0, 2.0}).triangle == 10);  // the lowest of six that share the node
    const auto outside = locator.locate({-1.0, 0.25});
    CHECK(outside.inside < 0.0);
    CHECK(outside.weights.minCoeff() >= 0.0);
    CHECK(outside.weights.sum() == Approx(1.0));
}

TEST_CASE("discs are refined without edges between two nodes of one side") {
    const detail::Disc disc = square();
    CHECK(detail::common_side(disc, 0, 1) == 0);
    CHECK(detail::common_side(disc, 3, 0) == 3);
    CHECK(detail::common_side(disc, 0, 2) == detail::DiscPlace::inside);
    const detail::Disc fine = detail::refine_disc(disc, 30);
    CHECK(fine.triangles.size() >= 30);
    CHECK(fine.points.size() == fine.places.size());
    double area = 0.0;
    std::array<double, 2> of_origin{};
    for (std::size_t t = 0; t < fine.triangles.size(); ++t) {
        const TriCorners& c = fine.triangles[t];
        const Vec3 n = 0.5 * (fine.points[c[1]] - fine.points[c[0]]).cross(fine.points[c[2]] - fine.points[c[0]]);
        CHECK(n.z() > 0.0);
        area += n.z();
        of_origin[fine.origin[t]] += n.z();
    }
    CHECK(area == Approx(1.0));
    CHECK(of_origin[0] == Approx(0.5));
    const detail::DiscEdges edges = detail::disc_edges(fine.triangles);
    for (std::size_t e = 0; e < edges.nodes.size(); ++e) {
        const bool one_side =
            detail::common_side(fine, edges.nodes[e][0], edges.nodes[e][1]) != detail::DiscPlace::inside;
        CHECK(one_side == (edges.boundary[e] != 0));
    }
}

TEST_CASE("the lattice of blocks numbers every node once, whichever block names it") {
    const auto c = block_cases::box({4, 2, 2}, {{0, 2}});
    const BlockMesh blocks = dualize(c.mesh, c.topology, c.classes, c.complex);
    std::vector<SheetIntervals> sheets(1 + *std::max_element(blocks.sheets.begin(), blocks.sheets.end()));
    for (std::size_t s = 0; s < sheets.size(); ++s) {
        sheets[s].intervals = static_cast<std::uint32_t>(2 + s % 3);
    }
    const detail::BlockLattice lattice(blocks, sheets);
    std::set<Index> seen;
    std::size_t cells = 0;
    for (Index h = 0; h < blocks.hexes.size(); ++h) {
        CHECK(lattice.first_hex(h) == cells);
        const auto n = lattice.hex_intervals(h);
        cells += std::size_t{n[0]} * n[1] * n[2];
        CHECK(lattice.hex_node(h, n, 0, 0, 0) == blocks.hexes[h][0]);
        CHECK(lattice.hex_node(h, n, n[0], n[1], n[2]) == blocks.hexes[h][6]);
        std::set<Index> own;
        for (std::uint32_t k = 0; k <= n[2]; ++k) {
            for (std::uint32_t j = 0; j <= n[1]; ++j) {
                for (std::uint32_t i = 0; i <= n[0]; ++i) {
                    own.insert(lattice.hex_node(h, n, i, j, k));
                }
            }
        }
        CHECK(own.size() == std::size_t{n[0] + 1} * (n[1] + 1) * (n[2] + 1));
        seen.insert(own.begin(), own.end());
    }
    CHECK(lattice.hex_count() == cells);
    CHECK(seen.size() == lattice.node_count());
    CHECK(*seen.rbegin() + 1 == lattice.node_count());
}

TEST_CASE("the edges and quads of the blocks of a box run straight between their nodes") {
    const auto c = block_cases::box({2, 2, 2});
    const BlockMesh blocks = dualize(c.mesh, c.topology, c.classes, c.complex);
    const BlockGeometry geometry = block_geometry(c.mesh, c.topology, c.complex);
    const BlockPlacement placement = place_blocks(blocks, geometry);
    const detail::BlockCurves curves(blocks, geometry, placement);
    REQUIRE(blocks.hexes.size() == 8);
    for (Index e = 0; e < blocks.edges.size(); ++e) {
        const Vec3 from = placement.positions[blocks.edges[e][0]];
        const Vec3 to = placement.positions[blocks.edges[e][1]];
        for (const double s : {0.0, 0.25, 1.0}) {
            CHECK((curves.edge_point(e, s) - ((1.0 - s) * from + s * to)).norm() < 1e-9);
        }
        CHECK(curves.edge_length(e) == Approx(0.5));
    }
    const std::array<double, 4> x{0.0, 1.0, 3.0, 2.0};
    CHECK(detail::bilinear(x, 0.5, 0.5) == 1.5);
    CHECK(detail::bilinear(x, 1.0, 0.0) == 1.0);
    CHECK(detail::bilinear(x, 1.0, 1.0) == 3.0);
}
