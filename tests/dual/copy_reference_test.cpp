#include "support/catch.hpp"
#include "support/tet_meshes.hpp"

#include <pavior/dual/copy_reference.hpp>

using namespace pavior;

TEST_CASE("any classified mesh becomes the same plain arrays") {
    const ReferenceMesh want = tet_meshes::reference(tet_meshes::box(2, 1, 1));
    REQUIRE_FALSE(want.layers.empty());
    const archetype::Tets foreign(want);
    for (const ReferenceMesh& got : {detail::copy_reference(foreign), detail::copy_reference(want)}) {
        CHECK(got.nodes == want.nodes);
        CHECK(got.tets == want.tets);
        CHECK(got.patches == want.patches);
        CHECK(got.curves == want.curves);
        CHECK(got.vertices == want.vertices);
        CHECK(got.layers == want.layers);
    }
}
