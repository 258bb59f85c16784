#include <pavior/glpk/solve_program.hpp>
#include <pavior/lattice/submap_lattice.hpp>

#include "support/catch.hpp"
#include "support/voxel_brep.hpp"

#include <pavior/submap/submap_recognition.hpp>

using namespace pavior;
using namespace pavior::test;

namespace {

/// A face with four edges 0 .. 3 of a rectangle and a hole of edges 4 .. 7.
LogicalFace framed() {
    LogicalFace face;
    for (int l = 0; l < 2; ++l) {
        LogicalLoop loop;
        for (int i = 0; i < 4; ++i) {
            loop.uses.push_back({EdgeId{4 * l + i}, true});
            loop.corner.push_back(l == 0 ? CornerClass::end : CornerClass::corner);
            loop.heading.push_back(l == 0 ? i : (5 - i) % 4);
        }
        face.loops.push_back(loop);
    }
    face.links.push_back({{0, 0}, {1.0, 1.0}});
    return face;
}

}  // namespace

TEST_CASE("a face with a hole on its lattice") {
    const LogicalFace face = framed();
    const std::vector<int> edges{5, 4, 5, 4, 2, 3, 2, 3};
    const std::vector<std::array<int, 2>> links{{1, 1}};
    const FaceTrace trace = trace_face(face, edges, links);
    CHECK(trace[0] == std::vector<LatticePoint<2>>{{0, 0}, {5, 0}, {5, 4}, {0, 4}});
    CHECK(trace[1] == std::vector<LatticePoint<2>>{{1, 1}, {1, 3}, {4, 3}, {4, 1}});
    const LogicalGrid<2> grid(trace_facets(face, trace, edges));
    CHECK(grid.ok());
    CHECK(grid.cell_count() == 14);
    CHECK_THROWS_AS(trace_face(face, std::vector<int>{5, 4, 5, 3, 2, 3, 2, 3}, links), InputError);
}

TEST_CASE("a side maps its lattice to that of the solid, facets look outward") {
    const SidePlace place{{{FaceId{0}, true}, SignedAxis{2}, SignedAxis{-1}}, {10, 20, 30}};
    CHECK(place({1, 2}) == LatticePoint<3>{8, 21, 30});
    const LatticeFacet<3> facet = place.facet({1, 2}, 5);
    CHECK(facet.low == LatticePoint<3>{7, 21, 30});
    CHECK(facet.axis == 2);
    CHECK(facet.outward == 1);  // j x -i = k
    CHECK(facet.entity == 5);
}

TEST_CASE("the vertices of a solid lie where their coordinates say") {
    Voxels voxels(4, 3, 3);
    voxels.fill({0, 0, 0}, {4, 3, 2}, 1);
    voxels.fill({1, 0, 2}, {2, 3, 3}, 1);
    voxels.fill({2, 1, 1}, {3, 2, 2}, 0);
    const VoxelBrep model(voxels, true);
    REQUIRE(model.sound());
    const TestBrep& b = model.brep();
    const SubmapModel submaps = recognise_submaps(b, model.solids(), {}, GlpkSolver{});
    SubmapNumbers numbers;
    for (std::size_t e = 0; e < b.edge_count(); ++e) {
        numbers.edges.push_back(static_cast<int>(std::lround(b.edge_length(EdgeId{static_cast<std::int32_t>(e)}))));
    }
    for (const LogicalFace& face : submaps.faces) {
        numbers.links.emplace_back();
        for (const LoopLink& link : face.links) {
            numbers.links.back().push_back(
                {static_cast<int>(std::lround(link.length[0])), static_cast<int>(std::lround(link.length[1]))});
        }
    }
    const SolidLattice lattice = solid_lattice(b, submaps, submaps.solids[0], numbers);
    REQUIRE(lattice.vertices.size() == b.vertex_count());
    const auto& [v0, p0] = *lattice.vertices.begin();
    for (const auto& [v, p] : lattice.vertices) {
        const Vec3 way = b.vertex_point(v) - b.vertex_point(v0);
        CHECK((way - Vec3(p[0] - p0[0], p[1] - p0[1], p[2] - p0[2])).norm() < 1e-9);
    }
    ++numbers.edges[0];
    CHECK_THROWS_AS(solid_lattice(b, submaps, submaps.solids[0], numbers), InputError);
}
