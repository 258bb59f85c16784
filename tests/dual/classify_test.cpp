#include "support/catch.hpp"
#include "support/tet_meshes.hpp"

#include <pavior/dual/classify.hpp>

#include <algorithm>

using namespace pavior;

namespace {
std::array<std::ptrdiff_t, 4> counts(const std::vector<EntityClass>& classes) {
    std::array<std::ptrdiff_t, 4> n{};
    for (std::size_t k = 0; k < 4; ++k) {
        n[k] = std::count(classes.begin(), classes.end(), static_cast<EntityClass>(k));
    }
    return n;
}
using Counts = std::array<std::ptrdiff_t, 4>;
}  // namespace

TEST_CASE("a box: free inside, layers on faces, stacks on edges, hexahedra at corners") {
    const ReferenceMesh mesh = tet_meshes::reference(tet_meshes::box(1, 1, 1), 3, false);
    const EntityClasses classes = classify(mesh, tet_topology(mesh));
    CHECK(counts(classes.node) == Counts{8, 24, 24, 8});
    CHECK(counts(classes.edge)[2] == 36);
    CHECK(counts(classes.face) == Counts{270, 108, 0, 0});
    CHECK(counts(classes.edge)[1] == 162 - 36);
}

TEST_CASE("a cut makes stacks and hexahedra where it meets others") {
    const auto tets = tet_meshes::tetrahedra(tet_meshes::box(2, 2, 2));
    ReferenceMesh mesh = make_reference_mesh(tets.mesh);
    const TetTopology topology = tet_topology(mesh);
    CHECK(counts(classify(mesh, topology).node) == Counts{1, 6, 12, 8});
    tet_meshes::add_plane(tets, topology, 0, 1, mesh);
    // The rim of the cut has eight nodes: four on edges of the box, four in the middle of its sides.
    CHECK(counts(classify(mesh, topology).node) == Counts{0, 3, 12, 12});
    tet_meshes::add_plane(tets, topology, 1, 1, mesh);
    tet_meshes::add_plane(tets, topology, 2, 1, mesh);
    CHECK(counts(classify(mesh, topology).node) == Counts{0, 0, 0, 27});
}

TEST_CASE("smooth curves are no features; feature vertices are hexahedra whatever is round them") {
    ReferenceMesh mesh = tet_meshes::reference(tet_meshes::box(1, 1, 1), 2, false);
    const TetTopology topology = tet_topology(mesh);
    for (FeatureEdge& edge : mesh.curves) {
        edge.kind = CurveKind::smooth;
    }
    CHECK(counts(classify(mesh, topology).edge)[2] == 0);
    CHECK(counts(classify(mesh, topology).node) == Counts{1, 18, 0, 8});
    mesh.vertices.clear();
    CHECK(counts(classify(mesh, topology).node) == Counts{1, 26, 0, 0});
}

TEST_CASE("foreign mesh, threads, layers twice and on the boundary") {
    ReferenceMesh mesh = tet_meshes::reference(tet_meshes::box(3, 2, 2));
    const TetTopology topology = tet_topology(mesh);
    const EntityClasses classes = classify(mesh, topology);
    CHECK(classes == classify(archetype::Tets(mesh), topology));
    CHECK(classes == classify(mesh, topology, Execution{3}));
    mesh.layers.push_back(mesh.layers.front());
    mesh.layers.push_back(mesh.patches.front().nodes);
    CHECK(classes == classify(mesh, topology));
}

TEST_CASE("entities that the mesh does not have") {
    const ReferenceMesh good = tet_meshes::reference(tet_meshes::box(1, 1, 1));
    const TetTopology topology = tet_topology(good);
    ReferenceMesh mesh = good;
    mesh.layers.push_back({0, 1, 99});
    CHECK_THROWS_AS(classify(mesh, topology), InputError);
    mesh = good;
    mesh.vertices.push_back({8, 0});
    CHECK_THROWS_AS(classify(mesh, topology), InputError);
    mesh = good;
    mesh.curves.push_back({{0, 0}, 0, CurveKind::end});
    CHECK_THROWS_AS(classify(mesh, topology), InputError);
}
