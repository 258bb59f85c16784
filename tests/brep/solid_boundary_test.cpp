#include <pavior/brep/solid_boundary.hpp>

#include "support/catch.hpp"
#include "support/test_brep.hpp"

using namespace pavior;
using namespace pavior::test;

namespace {

void verify(const TestBrep& b, const SolidBoundary& solid) {
    for (std::size_t h = 0; h < solid.half_edges.size(); ++h) {
        const SolidBoundary::HalfEdge& edge = solid.half_edges[h];
        const SolidBoundary::HalfEdge& twin = solid.half_edges[edge.twin];
        CHECK(twin.twin == h);
        CHECK(twin.use.edge == edge.use.edge);
        CHECK(twin.use.forward != edge.use.forward);
        CHECK(solid.half_edges[edge.next].face == edge.face);
        CHECK(solid.half_edges[edge.next].start == b.edge_vertices(edge.use.edge)[edge.use.forward ? 1 : 0]);
        CHECK(solid.half_edges[edge.next].start == twin.start);
    }
}

}  // namespace

TEST_CASE("Half-edges of a prism with a hole") {
    TestBrep b;
    const SolidId id = add_prism(b, rectangle(3, 3), 0, 2, {{{1, 1}, {1, 2}, {2, 2}, {2, 1}}});
    const SolidBoundary solid = solid_boundary(b, id);
    verify(b, solid);
    CHECK(solid.tag == 1);
    CHECK(solid.faces.size() == 10);
    CHECK(solid.half_edges.size() == 2 * b.edge_count());
    CHECK(solid.faces[0].loops.size() == 2);
    CHECK(solid.loop_from(solid.faces[0].loops[1]).size() == 4);
    for (const std::size_t h : solid.loop_from(solid.faces[0].loops[0])) {
        CHECK(solid.half_edges[h].angle == Approx(90));
        CHECK(solid.twin_face(h) >= 2);
    }
    for (const std::size_t h : solid.loop_from(solid.faces[1].loops[1])) {
        CHECK(solid.half_edges[h].angle == Approx(270));
    }
}

TEST_CASE("A seam pairs two half-edges of one face") {
    TestBrep b;
    const SolidBoundary solid = solid_boundary(b, add_cylinder(b, 1, 1, 2));
    verify(b, solid);
    CHECK_FALSE(solid.faces[0].seam);
    CHECK(solid.faces[2].seam);
    CHECK(solid.half_edges.size() == 6);
}

TEST_CASE("Edges without length are left out") {
    TestBrep b;
    const auto low = lift(b, rectangle(1, 1), 0), high = lift(b, rectangle(1, 1), 1);
    const OrientedEdge pole{b.line(low[0], low[0]), true};
    std::vector<OrientedFace> faces{{b.flat_polygon(low), false}, {b.flat_polygon(high), true}};
    add_sides(b, low, high, faces);
    EdgeLoop loop = b.face_loops(faces[2].face)[0];
    loop.insert(loop.begin(), pole);
    faces[2].face = b.flat({loop}, {0, -1, 0});
    const SolidBoundary solid = solid_boundary(b, b.solid(faces));
    verify(b, solid);
    CHECK(solid.half_edges.size() == 24);
}

TEST_CASE("A solid that is not closed, or turned inside out in part, is refused with an edge") {
    TestBrep b;
    const SolidId box = add_prism(b, rectangle(1, 1), 0, 1);
    std::vector<OrientedFace> faces(b.solid_faces(box).begin(), b.solid_faces(box).end());
    SECTION("a face missing") { faces.pop_back(); }
    SECTION("a face twice") { faces.push_back(faces.back()); }
    SECTION("a face turned round") { faces[3].outward = !faces[3].outward; }
    try {
        (void)solid_boundary(b, b.solid(faces));
        FAIL("accepted");
    } catch (const InputError& e) {
        CHECK(e.code() == ErrorCode::non_manifold);
        CHECK(e.ids().size() == 1);
    }
}
