#include "support/catch.hpp"
#include "support/tet_meshes.hpp"

#include <pavior/contributions/contributions.hpp>

using namespace pavior;

static_assert(sizeof(TetContributions) == 8);

TEST_CASE("28 candidates in 56 bits") {
    TetContributions c;
    CHECK(c.empty());
    for (std::size_t i = 0; i < candidate_count; ++i) {
        c.add(i, static_cast<Contribution>(i % 3));
        CHECK(c.has_hard() == (i >= 2));
        CHECK(c.has_hard_vertex() == (i >= 17));
    }
    for (std::size_t i = 0; i < candidate_count; ++i) {
        CHECK(c[i] == static_cast<Contribution>(i % 3));
    }
}

TEST_CASE("the tetrahedron alone in the world") {
    // All its faces are layers, its edges stacks, its nodes hexahedra: all candidates are hard.
    ReferenceMesh mesh;
    mesh.nodes = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)};
    mesh.tets = {{0, 1, 2, 3}};
    mesh = make_reference_mesh(mesh);
    const TetTopology topology = tet_topology(mesh);
    const auto all = add_contributions(mesh, topology, classify(mesh, topology));
    REQUIRE(all.size() == 1);
    for (std::size_t i = 0; i < candidate_count; ++i) {
        CHECK(all[0][i] == Contribution::hard);
    }
}

TEST_CASE("every candidate follows the rules, on any mesh and any number of threads") {
    const ReferenceMesh mesh = tet_meshes::reference(
        tet_meshes::voxels({3, 3, 2}, [](Index i, Index j, Index k) { return i == 0 || j == 1 || k == 0; }), 3);
    const TetTopology topology = tet_topology(mesh);
    const EntityClasses classes = classify(mesh, topology);
    for (const VertexRule rule : {VertexRule::repaired, VertexRule::printed}) {
        const auto all = add_contributions(mesh, topology, classes, rule);
        CHECK(all == add_contributions(archetype::Tets(mesh), topology, classes, rule, Execution{2}));
        std::size_t empty = 0;
        for (Index t = 0; t < all.size(); ++t) {
            empty += all[t].empty() ? 1 : 0;
            for (std::size_t i = 0; i < candidate_count; ++i) {
                const Candidate& c = tet_candidates[i];
                Contribution wanted = Contribution::none;
                if (c.kind == CandidateKind::face) {
                    wanted = match_face(classes.face[topology.tet_faces[t][c.entity]]);
                } else if (c.kind == CandidateKind::edge) {
                    wanted = match_edge(classes.edge[topology.tet_edges[t][c.entity]], all[t][c.other]);
                } else {
                    wanted = match_vertex(
                        classes.node[mesh.tets[t][c.entity]], classes.edge[topology.tet_edges[t][c.other]],
                        all[t][edge_candidates + 2u * c.other], all[t][edge_candidates + 2u * c.other + 1], rule);
                }
                REQUIRE(all[t][i] == wanted);
            }
        }
        CHECK(empty > 0);
    }
}
