#include "support/catch.hpp"
#include "support/tet_meshes.hpp"

#include <pavior/dual/reference_mesh.hpp>

using namespace pavior;

static_assert(tet_mesh<ReferenceMesh> && classified_tet_mesh<ReferenceMesh>);
static_assert(classified_tet_mesh<archetype::Tets>);
static_assert(tet_mesh<TetMesh> && !classified_tet_mesh<TetMesh>);

TEST_CASE("a reference mesh reads as what it holds") {
    const ReferenceMesh mesh = tet_meshes::reference(tet_meshes::box(2, 1, 1));
    CHECK(node_count(mesh) == 12);
    CHECK(tet_count(mesh) == 12);
    CHECK(node(mesh, 3) == mesh.nodes[3]);
    CHECK(tet(mesh, 5) == mesh.tets[5]);
    CHECK(&feature_access<ReferenceMesh>::layers(mesh) == &mesh.layers);
    CHECK(&feature_access<ReferenceMesh>::patches(mesh) == &mesh.patches);
    CHECK(&feature_access<ReferenceMesh>::curves(mesh) == &mesh.curves);
    CHECK(&feature_access<ReferenceMesh>::vertices(mesh) == &mesh.vertices);
    CHECK(mesh.layers.size() == 2);
}

TEST_CASE("tags compare by id, then tag") {
    CHECK(TagOf{1, 5} < TagOf{2, 0});
    CHECK(TagOf{1, 5} < TagOf{1, 6});
    CHECK(TagOf{1, 5} == TagOf{1, 5});
}
