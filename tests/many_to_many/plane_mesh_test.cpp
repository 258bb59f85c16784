#include "support/catch.hpp"
#include "support/extruded_cases.hpp"

#include <pavior/cad/region_quads.hpp>
#include <pavior/many_to_many/plane_mesh.hpp>
#include <pavior/mesh/span_mesh.hpp>
#include <pavior/mesh/verify_quads.hpp>

using namespace pavior;
using namespace pavior::test;

namespace {
const auto stay = [](Index, const Vec2& x) { return x; };
const auto rethrow = [](Index, const Error& error) { throw error; };

QuadMesh lifted(const PlaneMesh& mesh) {
    QuadMesh result;
    for (const Vec2& x : mesh.nodes) {
        result.nodes.emplace_back(x[0], x[1], 0);
    }
    result.quads = mesh.quads;
    return result;
}
}  // namespace

TEST_CASE("cells conform along their edges") {
    const PlaneArrangement plane =
        arranged(PolygonBody({bottom(0, {box(0, 0, 4, 2)}), top(1, {box(1, 0, 3, 1)}), top(1, {disc(2, 1.5, 0.2)})}));
    std::vector<int> intervals;
    for (const PlaneEdge& edge : plane.edges) {
        intervals.push_back(edge.points.size() > 9 ? 8 : 4);
    }
    const std::vector<char> wanted(plane.cells.size(), 1);
    const PlaneMesh mesh = mesh_plane(plane, intervals, wanted, stay, GmshRegionMesher{}, rethrow);
    CHECK(verify_quads(lifted(mesh)).ok());
    CHECK(mesh.cell_count() == plane.cells.size());
    CHECK(mesh.cell_quads.back() == mesh.quads.size());
    for (std::size_t e = 0; e < plane.edges.size(); ++e) {
        CHECK(mesh.edges[e].size() == static_cast<std::size_t>(intervals[e]) + 1);
        for (const Index p : mesh.edges[e]) {
            CHECK(p < mesh.edge_nodes);
        }
    }
}

TEST_CASE("a cell whose boundary passes a vertex twice is filled") {
    // Two triangular holes that touch in one point.
    const PlaneArrangement plane =
        arranged(PolygonBody({bottom(0, {box(0, 0, 8, 4), {{2, 1}, {4, 2}, {2, 3}}, {{6, 1}, {6, 3}, {4, 2}}})}));
    std::vector<int> intervals(plane.edges.size(), 4);
    std::vector<char> wanted;
    for (const PlaneCell& cell : plane.cells) {
        wanted.push_back(cell.loops.size() == 2);
    }
    REQUIRE(std::count(wanted.begin(), wanted.end(), 1) == 1);
    const PlaneMesh mesh = mesh_plane(plane, intervals, wanted, stay, GmshRegionMesher{}, rethrow);
    double area = 0;
    for (const QuadCorners& q : mesh.quads) {
        const Vec2 a = mesh.nodes[q[2]] - mesh.nodes[q[0]];
        const Vec2 b = mesh.nodes[q[3]] - mesh.nodes[q[1]];
        area += 0.5 * (a[0] * b[1] - a[1] * b[0]);
    }
    CHECK(area == Approx(28));
}

TEST_CASE("a cell that admits no quads is reported, and the others are filled") {
    const PlaneArrangement plane = arranged(PolygonBody(steps()));
    const std::vector<int> intervals(plane.edges.size(), 2);
    const std::vector<char> wanted(2, 1);
    std::vector<Index> failed;
    int calls = 0;
    const auto moody = [&](const PlaneRegion& region) {
        if (calls++ == 0) {
            throw Error(ErrorCode::cad_failure, "no");
        }
        return mesh_region(region);
    };
    const PlaneMesh mesh =
        mesh_plane(plane, intervals, wanted, stay, moody, [&](Index cell, const Error&) { failed.push_back(cell); });
    CHECK(failed == std::vector<Index>{0});
    CHECK(mesh.cell_quads == std::vector<std::size_t>{0, 0, 4});
}

TEST_CASE("quads that are flat at a corner count as none") {
    // One quad in a triangle whose long side has two intervals.
    const PlaneArrangement plane = arranged(PolygonBody({bottom(0, {{{0, 0}, {2, 0}, {1, 1}}})}));
    std::vector<int> intervals;
    for (const PlaneEdge& edge : plane.edges) {
        intervals.push_back((edge.points.front() - edge.points.back()).norm() > 1.9 ? 2 : 1);
    }
    const std::vector<char> wanted(1, 1);
    const auto one = [](const PlaneRegion& region) { return PlaneQuadMesh{region.points, {{0, 1, 2, 3}}}; };
    std::size_t failures = 0;
    const PlaneMesh mesh = mesh_plane(plane, intervals, wanted, stay, one, [&](Index, const Error&) { ++failures; });
    CHECK(failures == 1);
    CHECK(mesh.quads.empty());
    // The mesher itself does not hand out such a quad.
    const auto honest = [](const PlaneRegion& region) {
        const PlaneQuadMesh quads = mesh_region(region);
        CHECK(quads.quads.size() > 1);
        return quads;
    };
    (void)mesh_plane(plane, intervals, wanted, stay, honest, [](Index, const Error&) {});
}
