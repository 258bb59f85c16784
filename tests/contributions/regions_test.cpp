#include "support/catch.hpp"
#include "support/tet_meshes.hpp"

#include <pavior/contributions/regions.hpp>
#include <pavior/dual/cell_complex.hpp>

#include <map>
#include <numeric>

using namespace pavior;

namespace {
// Union-find over all 15 T pieces, the slow way: pieces of two tetrahedra meet on a common face.
std::vector<std::size_t> pieces_by_the_book(const ReferenceMesh& mesh, const TetTopology& topology,
                                            const std::vector<TetContributions>& contributions) {
    std::vector<std::size_t> parent(15 * mesh.tets.size());
    std::iota(parent.begin(), parent.end(), std::size_t{0});
    const auto root = [&](std::size_t i) {
        while (parent[i] != i) {
            i = parent[i] = parent[parent[i]];
        }
        return i;
    };
    const auto unite = [&](std::size_t i, std::size_t j) { parent[root(i)] = root(j); };
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
        for (std::size_t i = 0; i < candidate_count; ++i) {
            if (contributions[t][i] != Contribution::none) {
                continue;
            }
            const Candidate& c = tet_candidates[i];
            const std::size_t base = 15 * t;
            if (c.kind == CandidateKind::face) {
                unite(base + 10 + c.entity, base + 14);
            } else if (c.kind == CandidateKind::edge) {
                unite(base + 4 + c.entity, base + 10 + c.other);
            } else {
                unite(base + c.entity, base + 4 + c.other);
            }
        }
    }
    for (std::size_t f = 0; f < topology.faces.size(); ++f) {
        const Index t = topology.face_tets[f][0];
        const Index u = topology.face_tets[f][1];
        for (std::size_t i = 0; u != no_index && i < 16; ++i) {
            for (std::size_t j = 0; j < 16; ++j) {
                const auto meets = [&](std::size_t a, std::size_t b) {  // pieces of one node, edge or face of f
                    if (a < 4 && b < 4) {
                        const auto& c = topology.faces[f];
                        return mesh.tets[t][a] == mesh.tets[u][b] &&
                               std::find(c.begin(), c.end(), mesh.tets[t][a]) != c.end();
                    }
                    if (a >= 4 && a < 10 && b >= 4 && b < 10) {
                        const auto& e = topology.face_edges[f];
                        return topology.tet_edges[t][a - 4] == topology.tet_edges[u][b - 4] &&
                               std::find(e.begin(), e.end(), topology.tet_edges[t][a - 4]) != e.end();
                    }
                    return a >= 10 && a < 14 && b >= 10 && b < 14 && topology.tet_faces[t][a - 10] == f &&
                           topology.tet_faces[u][b - 10] == f;
                };
                if (meets(i, j)) {
                    unite(15 * t + i, 15 * u + j);
                }
            }
        }
    }
    for (std::size_t i = 0; i < parent.size(); ++i) {
        parent[i] = root(i);
    }
    return parent;
}

void check_same_partition(const ReferenceMesh& mesh, const TetTopology& topology, const Regions& regions,
                          const std::vector<std::size_t>& wanted) {
    std::map<std::size_t, Index> name;
    std::map<Index, std::size_t> back;
    bool same = true;
    for (std::size_t i = 0; i < wanted.size(); ++i) {
        const std::size_t t = i / 15;
        const std::size_t piece = i % 15;
        const Index region = piece < 4    ? regions.node[mesh.tets[t][piece]]
                             : piece < 10 ? regions.edge[topology.tet_edges[t][piece - 4]]
                             : piece < 14 ? regions.face[topology.tet_faces[t][piece - 10]]
                                          : regions.tet[t];
        same = same && name.emplace(wanted[i], region).first->second == region &&
               back.emplace(region, wanted[i]).first->second == wanted[i];
    }
    CHECK(same);
    CHECK(name.size() == regions.count());
}
}  // namespace

TEST_CASE("regions are those of the 15 pieces, whatever was marked, under both rules") {
    std::mt19937 random(5);
    for (int n = 0; n < 60; ++n) {
        ReferenceMesh mesh = tet_meshes::reference(tet_meshes::random_solid({3, 2, 2}, random),
                                                   1 + static_cast<Index>(n % 2), n % 3 == 0);
        const TetTopology topology = tet_topology(mesh);
        for (Index f = 0; f < topology.faces.size() && n % 3 == 1; ++f) {
            if (random() % 4 == 0) {
                mesh.layers.push_back(topology.faces[f]);
            }
        }
        const EntityClasses classes = classify(mesh, topology);
        for (const VertexRule rule : {VertexRule::repaired, VertexRule::printed}) {
            const auto contributions = add_contributions(mesh, topology, classes, rule);
            const Regions result = regions(mesh, topology, contributions);
            check_same_partition(mesh, topology, result, pieces_by_the_book(mesh, topology, contributions));
            CHECK(result == regions(archetype::Tets(mesh), topology, contributions, Execution{2}));
            CHECK(result.representative.size() == result.count());
        }
    }
}

TEST_CASE("regions are the cells of the complex in its order") {
    std::mt19937 random(8);
    for (int n = 0; n < 20; ++n) {
        const ReferenceMesh mesh =
            tet_meshes::reference(tet_meshes::random_solid({3, 3, 2}, random), 1 + static_cast<Index>(n % 2));
        const TetTopology topology = tet_topology(mesh);
        const EntityClasses classes = classify(mesh, topology);
        const CellComplex complex = cell_complex(mesh, topology, classes);
        const Regions result = regions(mesh, topology, add_contributions(mesh, topology, classes));
        REQUIRE(result.count() == complex.cell_count());
        CHECK(result.tet == complex.tet_cell);
        CHECK(result.begin[1] == complex.cells.size());
        CHECK(result.begin[2] - result.begin[1] == complex.patches.size());
        CHECK(result.begin[3] - result.begin[2] == complex.chains.size());
        for (Index i = 0; i < complex.vertices.size(); ++i) {
            CHECK(result.node[complex.vertices[i]] == result.begin[3] + i);
            CHECK(result.representative[result.begin[3] + i] == complex.vertices[i]);
            CHECK(result.dimension(result.begin[3] + i) == 0);
        }
        for (Index f = 0; f < topology.faces.size(); ++f) {
            if (complex.face_patch[f] != no_index) {
                CHECK(result.face[f] == result.begin[1] + complex.face_patch[f]);
            }
        }
        for (Index e = 0; e < topology.edges.size(); ++e) {
            if (complex.edge_chain[e] != no_index) {
                CHECK(result.edge[e] == result.begin[2] + complex.edge_chain[e]);
            }
        }
    }
}

TEST_CASE("nodes of no tetrahedron have no region") {
    ReferenceMesh mesh = tet_meshes::reference(tet_meshes::box(1, 1, 1));
    mesh.nodes.push_back(Vec3(7, 7, 7));
    const TetTopology topology = tet_topology(mesh);
    const Regions result = regions(mesh, topology, add_contributions(mesh, topology, classify(mesh, topology)));
    CHECK(result.count() == 27);
    CHECK(result.node.back() == no_index);
}
