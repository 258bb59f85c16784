#include "support/catch.hpp"
#include "support/tet_meshes.hpp"

#include <pavior/dual/tet_topology.hpp>
#include <pavior/mesh/eigen_access.hpp>

#include <algorithm>
#include <map>
#include <random>
#include <set>

using namespace pavior;

namespace {
// Everything the topology says, against sets and maps made the slow way.
void check_against_maps(const TetMesh& mesh, const TetTopology& topology) {
    std::set<std::array<Index, 2>> edges;
    std::map<TriCorners, std::vector<Index>> faces;
    for (Index t = 0; t < mesh.tets.size(); ++t) {
        TetCorners c = mesh.tets[t];
        for (std::size_t e = 0; e < 6; ++e) {
            std::array<Index, 2> nodes{c[static_cast<std::size_t>(tet_edges[e][0])],
                                       c[static_cast<std::size_t>(tet_edges[e][1])]};
            std::sort(nodes.begin(), nodes.end());
            edges.insert(nodes);
            REQUIRE(topology.edges[topology.tet_edges[t][e]] == nodes);
        }
        for (std::size_t f = 0; f < 4; ++f) {
            TriCorners nodes = detail::tet_face(c, f);
            std::sort(nodes.begin(), nodes.end());
            faces[nodes].push_back(t);
            REQUIRE(topology.faces[topology.tet_faces[t][f]] == nodes);
        }
    }
    REQUIRE(topology.edges.size() == edges.size());
    REQUIRE(topology.faces.size() == faces.size());
    for (Index f = 0; f < faces.size(); ++f) {
        const TriCorners& c = topology.faces[f];
        const std::vector<Index>& tets = faces.at(c);
        REQUIRE(topology.face_tets[f][0] == tets[0]);
        REQUIRE(topology.face_tets[f][1] == (tets.size() == 2 ? tets[1] : no_index));
        REQUIRE(topology.boundary(f) == (tets.size() == 1));
        REQUIRE(topology.across(f, tets[0]) == topology.face_tets[f][1]);
        REQUIRE(topology.face({c[2], c[0], c[1]}) == f);
        for (std::size_t k = 0; k < 3; ++k) {
            const auto& ends = topology.edges[topology.face_edges[f][k]];
            REQUIRE(std::find(ends.begin(), ends.end(), c[k]) == ends.end());
            REQUIRE(std::includes(c.begin(), c.end(), ends.begin(), ends.end()));
        }
    }
    for (Index e = 0; e < edges.size(); ++e) {
        REQUIRE(topology.edge(topology.edges[e][1], topology.edges[e][0]) == e);
    }
}

TetMesh shuffled(TetMesh mesh, unsigned seed) {
    std::mt19937 random(seed);
    std::shuffle(mesh.tets.begin(), mesh.tets.end(), random);
    std::vector<Index> name(mesh.nodes.size());
    for (Index i = 0; i < name.size(); ++i) {
        name[i] = i;
    }
    std::shuffle(name.begin(), name.end(), random);
    TetMesh out{std::vector<Vec3>(name.size()), {}};
    for (Index i = 0; i < name.size(); ++i) {
        out.nodes[name[i]] = mesh.nodes[i];
    }
    for (const TetCorners& c : mesh.tets) {
        out.tets.push_back({name[c[0]], name[c[1]], name[c[2]], name[c[3]]});
    }
    return out;
}
}  // namespace

TEST_CASE("one tetrahedron") {
    const TetMesh mesh{{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)}, {{0, 1, 2, 3}}};
    const TetTopology topology = tet_topology(mesh);
    CHECK(topology.edges == std::vector<std::array<Index, 2>>{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}});
    CHECK(topology.faces == std::vector<TriCorners>{{0, 1, 2}, {0, 1, 3}, {0, 2, 3}, {1, 2, 3}});
    CHECK(topology.tet_faces[0] == std::array<Index, 4>{3, 2, 1, 0});
    CHECK(topology.face_edges[0] == std::array<Index, 3>{3, 1, 0});
    check_against_maps(mesh, topology);
}

TEST_CASE("boxes, in order and shuffled") {
    const TetMesh mesh = tet_meshes::tetrahedra(tet_meshes::box(3, 2, 4)).mesh;
    check_against_maps(mesh, tet_topology(mesh));
    for (const unsigned seed : {1U, 2U, 3U}) {
        const TetMesh other = shuffled(mesh, seed);
        check_against_maps(other, tet_topology(other));
    }
}

TEST_CASE("a fan of many tetrahedra round one edge, nodes of high degree") {
    TetMesh mesh{{Vec3(0, 0, 0), Vec3(0, 0, 1)}, {}};
    constexpr Index n = 200;
    for (Index i = 0; i < n; ++i) {
        const double a = 2.0 * 3.14159265358979 * i / n;
        mesh.nodes.push_back(Vec3(std::cos(a), std::sin(a), 0.5));
    }
    for (Index i = 0; i < n; ++i) {
        mesh.tets.push_back({0, 2 + i, 2 + (i + 1) % n, 1});
    }
    const TetTopology topology = tet_topology(mesh);
    check_against_maps(mesh, topology);
    CHECK(topology.edges.size() == 3 * n + 1);
    CHECK(topology.faces.size() == 3 * n);
}

TEST_CASE("the same bytes for any number of threads") {
    const TetMesh mesh = shuffled(tet_meshes::tetrahedra(tet_meshes::box(14, 14, 14)).mesh, 7);
    const TetTopology one = tet_topology(mesh);
    CHECK(one == tet_topology(mesh, Execution{2}));
    CHECK(one == tet_topology(mesh, Execution{3}));
}

TEST_CASE("numbering follows the tetrahedra, not the numbers of the nodes") {
    TetMesh mesh = tet_meshes::tetrahedra(tet_meshes::box(3, 3, 3)).mesh;
    const TetTopology before = tet_topology(mesh);
    for (TetCorners& c : mesh.tets) {
        for (Index& i : c) {
            i = static_cast<Index>(mesh.nodes.size()) - 1 - i;
        }
    }
    std::reverse(mesh.nodes.begin(), mesh.nodes.end());
    const TetTopology after = tet_topology(mesh);
    CHECK(before.tet_edges == after.tet_edges);
    CHECK(before.tet_faces == after.tet_faces);
    CHECK(before.face_tets == after.face_tets);
}

TEST_CASE("foreign meshes") {
    const ReferenceMesh mesh = tet_meshes::reference(tet_meshes::box(2, 2, 1));
    const TetTopology topology = tet_topology(mesh);
    CHECK(topology == tet_topology(archetype::Tets(mesh)));
    Eigen::MatrixXd v(static_cast<Eigen::Index>(mesh.nodes.size()), 3);
    Eigen::MatrixXi t(static_cast<Eigen::Index>(mesh.tets.size()), 4);
    for (Eigen::Index i = 0; i < v.rows(); ++i) {
        v.row(i) = mesh.nodes[static_cast<std::size_t>(i)].transpose();
    }
    for (Eigen::Index i = 0; i < t.rows(); ++i) {
        for (Eigen::Index k = 0; k < 4; ++k) {
            t(i, k) = static_cast<int>(mesh.tets[static_cast<std::size_t>(i)][static_cast<std::size_t>(k)]);
        }
    }
    CHECK(topology == tet_topology(EigenTetMesh(v, t)));
}

TEST_CASE("unknown edges and faces; nodes of no tetrahedron; no tetrahedra") {
    TetMesh mesh = tet_meshes::tetrahedra(tet_meshes::box(2, 1, 1)).mesh;
    mesh.nodes.push_back(Vec3(9, 9, 9));
    const auto lonely = static_cast<Index>(mesh.nodes.size() - 1);
    const TetTopology topology = tet_topology(mesh);
    check_against_maps(mesh, topology);
    CHECK(topology.edge(0, lonely) == no_index);
    CHECK(topology.edge(lonely, lonely) == no_index);
    CHECK(topology.edge(0, no_index) == no_index);
    CHECK(topology.face({0, 1, lonely}) == no_index);
    CHECK(topology.face({0, 0, 0}) == no_index);
    const TetTopology empty = tet_topology(TetMesh{});
    CHECK(empty.edges.empty());
    CHECK(empty.edge(0, 1) == no_index);
}

TEST_CASE("bad tetrahedra are named") {
    TetMesh mesh = tet_meshes::tetrahedra(tet_meshes::box(1, 1, 1)).mesh;
    const auto thrown = [&](ErrorCode code, const Error::Ids& ids) {
        try {
            std::ignore = tet_topology(mesh);
        } catch (const InputError& error) {
            return error.code() == code && error.ids() == ids;
        }
        return false;
    };
    mesh.tets.push_back({0, 1, 2, 8});
    CHECK(thrown(ErrorCode::bad_index, {6}));
    mesh.tets.back() = {0, 1, 2, 1};
    CHECK(thrown(ErrorCode::bad_index, {6}));
    mesh.tets.back() = mesh.tets[2];
    mesh.tets.push_back(mesh.tets[2]);
    CHECK_THROWS_AS(tet_topology(mesh), InputError);
    mesh.nodes.push_back(Vec3(5, 5, 5));
    mesh.tets.resize(6);
    mesh.tets.push_back({mesh.tets[0][0], mesh.tets[0][1], mesh.tets[0][2], 8});
    mesh.nodes.push_back(Vec3(6, 5, 5));
    mesh.tets.push_back({mesh.tets[0][0], mesh.tets[0][1], mesh.tets[0][2], 9});
    CHECK_THROWS_AS(tet_topology(mesh), InputError);
}
