#include "support/catch.hpp"
#include "support/test_brep.hpp"

#include <pavior/brep/boundary_mesh.hpp>
#include <pavior/brep/edge_chain.hpp>

using namespace pavior;

TEST_CASE("edges share the nodes of their vertices, and only edges with intervals are meshed") {
    test::TestBrep b;
    test::add_prism(b, test::rectangle(2, 1), 0, 1);
    std::vector<int> intervals(b.edge_count(), 3);
    intervals[0] = 0;
    const BoundaryMesh mesh = mesh_edges(b, intervals);
    CHECK(mesh.edges[0].nodes.empty());
    CHECK(mesh.nodes.size() == 8 + 11 * 2);
    for (std::size_t e = 1; e < b.edge_count(); ++e) {
        const EdgeId id{static_cast<std::int32_t>(e)};
        REQUIRE(mesh.edges[e].nodes.size() == 4);
        CHECK(mesh.edges[e].nodes.front() == mesh.vertices[b.edge_vertices(id)[0].index()]);
        CHECK(mesh.edges[e].nodes.back() == mesh.vertices[b.edge_vertices(id)[1].index()]);
        CHECK((mesh.nodes[mesh.edges[e].nodes[1]] - b.edge_point(id, 1.0 / 3)).norm() < 1e-14);
    }
}

TEST_CASE("given parameters place the nodes of an edge") {
    test::TestBrep b;
    const EdgeId e = b.line(b.vertex({0, 0, 0}), b.vertex({4, 0, 0}));
    const std::vector<std::vector<double>> parameters{{0, 0.25, 1}};
    const BoundaryMesh mesh = mesh_edges(b, std::vector<int>{2}, parameters);
    CHECK(mesh.nodes[mesh.edges[e.index()].nodes[1]][0] == Approx(1.0));
}

TEST_CASE("edges and vertices that are meshed already stay") {
    test::TestBrep b;
    test::add_prism(b, test::rectangle(2, 1), 0, 1);
    BoundaryMesh given = mesh_edges(b, std::vector<int>{5});
    const EdgeNodes first = given.edges[0];
    const BoundaryMesh mesh = mesh_edges(b, std::vector<int>(b.edge_count(), 3), {}, std::move(given));
    CHECK(mesh.edges[0].nodes == first.nodes);
    CHECK(mesh.nodes.size() == 8 + 4 + 11 * 2);
    for (std::size_t e = 0; e < b.edge_count(); ++e) {
        const auto ends = b.edge_vertices(EdgeId{static_cast<std::int32_t>(e)});
        CHECK(mesh.edges[e].nodes.front() == mesh.vertices[ends[0].index()]);
        CHECK(mesh.edges[e].nodes.back() == mesh.vertices[ends[1].index()]);
    }
}

TEST_CASE("chains are read in their own sense; a seam has two sides") {
    test::TestBrep b;
    test::add_cylinder(b, 1, 1, 2);
    const BoundaryMesh mesh = mesh_edges(b, std::vector<int>(b.edge_count(), 4));
    const FaceId wall{0};
    const EdgeLoop& loop = b.face_loops(wall)[0];
    const ChainNodes all = chain_nodes(b, mesh, loop, wall, true);
    REQUIRE(all.nodes.size() == 17);
    CHECK(all.nodes.front() == all.nodes.back());
    CHECK(all.uv[6][0] == 1.0);   // up the seam, at the end of the bottom circle
    CHECK(all.uv[14][0] == 0.0);  // and down on its other side
    CHECK(all.nodes[6] == all.nodes[14]);
    const EdgeChain back = reversed(std::span(loop).subspan(1, 1));
    const ChainNodes seam = chain_nodes(b, mesh, back, wall, false);
    CHECK(seam.nodes.front() == all.nodes[8]);
    CHECK(seam.uv.front()[0] == 1.0);
}
