#include "support/catch.hpp"

#include <pavior/mesh/tagged_mesh.hpp>

using namespace pavior;

TEST_CASE("tagged entities compare by nodes and tag") {
    CHECK(TaggedEdge{{1, 2}, 3} == TaggedEdge{{1, 2}, 3});
    CHECK_FALSE(TaggedEdge{{1, 2}, 3} == TaggedEdge{{1, 2}, 4});
    CHECK_FALSE(TaggedTriangle{{1, 2, 3}, 0} == TaggedTriangle{{2, 3, 1}, 0});
    CHECK(TaggedNode{4, 7} == TaggedNode{4, 7});
}

TEST_CASE("without tags the lists are empty") {
    const TaggedSurface surface;
    CHECK(surface.face_tags.empty());
    CHECK(surface.edges.empty());
    const TaggedTetMesh tets;
    CHECK(tets.triangles.empty());
    CHECK(node_count(tets.mesh) == 0);
    CHECK(tet_count(tets.mesh) == 0);
}
