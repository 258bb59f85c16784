#include <pavior/brep/touching_solids.hpp>

#include "support/catch.hpp"
#include "support/test_brep.hpp"

using namespace pavior;

namespace {

/// A tetrahedron, faces shared with others of the model.
SolidId add_tetrahedron(test::TestBrep& b, const std::array<VertexId, 4>& v) {
    std::vector<OrientedFace> faces;
    for (const auto& f : {std::array{0, 2, 1}, std::array{0, 1, 3}, std::array{1, 2, 3}, std::array{0, 3, 2}}) {
        faces.push_back({b.flat_polygon({v[f[0]], v[f[1]], v[f[2]]}), true});
    }
    return b.solid(faces);
}

}  // namespace

TEST_CASE("solids that share a vertex hang together, directly or not") {
    test::TestBrep b;
    std::vector<VertexId> v;
    for (int i = 0; i < 13; ++i) {
        v.push_back(b.vertex({i % 3 + 0.1 * i * i, i % 2 + 0.3 * i, 0.2 * i * (i % 4)}));
    }
    const SolidId a = add_tetrahedron(b, {v[0], v[1], v[2], v[3]});
    const SolidId c = add_tetrahedron(b, {v[4], v[5], v[6], v[7]});
    const SolidId d = add_tetrahedron(b, {v[3], v[8], v[9], v[10]});    // shares a vertex with a
    const SolidId e = add_tetrahedron(b, {v[10], v[9], v[11], v[12]});  // shares an edge with d
    using Groups = std::vector<std::vector<SolidId>>;
    CHECK(touching_solids(b, std::vector{a, c, d, e}) == Groups{{a, d, e}, {c}});
    CHECK(touching_solids(b, std::vector{e, c, a}) == Groups{{e}, {c}, {a}});  // d is not asked for
    CHECK(touching_solids(b, std::vector{e, c, a, d}) == Groups{{e, a, d}, {c}});
    CHECK(touching_solids(b, std::vector<SolidId>{}).empty());
}
