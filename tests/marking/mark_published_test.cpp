#include "support/catch.hpp"
#include "support/tet_meshes.hpp"

#include <pavior/marking/mark_published.hpp>

using namespace pavior;

TEST_CASE("Algorithm 5.12 follows the faces of a mesh that has them along its cuts") {
    const auto solid = tet_meshes::voxels({2, 2, 1}, [](Index i, Index j, Index) { return i == 0 || j == 0; });
    for (const Index fine : {1U, 2U}) {
        const MarkedMesh marked = mark_published(tet_meshes::reference(solid, fine, false));
        CHECK(marked.report.valid);
        CHECK(marked.report.blocks == 24);
        CHECK(marked.report.nodes == 63);
        CHECK(marked.reference.layers.size() == 4 * fine * fine);
        CHECK(marked.report.sheets.back().kind == SheetKind::published);
    }
}

TEST_CASE("without re-entrant curves nothing is marked, and given layers stay") {
    const MarkedMesh plain = mark_published(tet_meshes::reference(tet_meshes::box(2, 1, 1), 1, false));
    CHECK(plain.reference.layers.empty());
    CHECK(plain.report.blocks == 8);
    const ReferenceMesh cut = tet_meshes::reference(tet_meshes::box(2, 1, 1));
    CHECK(mark_published(cut).reference.layers == cut.layers);
}

TEST_CASE("the published marking reads an archetype") {
    const auto solid = tet_meshes::voxels({2, 2, 1}, [](Index i, Index j, Index) { return i == 0 || j == 0; });
    const ReferenceMesh mesh = tet_meshes::reference(solid, 1, false);
    CHECK(mark_published(archetype::Tets(mesh)).reference.layers == mark_published(mesh).reference.layers);
}
