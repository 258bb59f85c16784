#include <pavior/lattice/submap_face.hpp>

#include "support/catch.hpp"
#include "support/test_brep.hpp"

#include <pavior/mesh/span_mesh.hpp>
#include <pavior/mesh/verify_quads.hpp>
#include <pavior/submap/submap_recognition.hpp>

using namespace pavior;
using namespace pavior::test;

namespace {

/// The logical shape of a face on its own.
LogicalFace shape(const TestBrep& b, FaceId f) {
    LogicalFace face;
    for (const EdgeLoop& loop : b.face_loops(f)) {
        std::vector<double> angles;
        for (std::size_t i = 0; i < loop.size(); ++i) {
            angles.push_back(corner_angle(b, {f, true}, loop[(i + loop.size() - 1) % loop.size()], loop[i]));
        }
        const auto classes = classify_loop(angles, face.loops.empty() ? 4 : -4);
        REQUIRE(classes);
        face.loops.push_back({loop, classes->classes, {}});
    }
    detail::orient_loops(b, f, face);
    return face;
}

QuadReport verified(const BoundaryMesh& mesh, FaceId f) {
    const FaceMesh& face = mesh.faces[f.index()];
    QuadMesh quads{{}, face.quads};
    for (const Index n : face.nodes) {
        quads.nodes.push_back(mesh.nodes[n]);
    }
    return verify_quads(quads);
}

}  // namespace

TEST_CASE("an L with a hole: structured, on the face, about its normal") {
    for (const double sense : {1.0, -1.0}) {
        TestBrep b;
        auto outer = lift(b, {{0, 0}, {6, 0}, {6, 3}, {3, 3}, {3, 5}, {0, 5}}, 1);
        auto hole = lift(b, {{1, 1}, {1, 2}, {2, 2}, {2, 1}}, 1);
        if (sense < 0) {
            std::reverse(outer.begin(), outer.end());
            std::reverse(hole.begin(), hole.end());
        }
        const FaceId f = b.flat_polygon(outer, {hole});
        const LogicalFace face = shape(b, f);
        SubmapNumbers numbers;
        for (std::size_t e = 0; e < b.edge_count(); ++e) {
            numbers.edges.push_back(static_cast<int>(std::lround(b.edge_length(EdgeId{static_cast<std::int32_t>(e)}))));
        }
        const LoopLink& link = face.links.at(0);
        numbers.links = {
            {{static_cast<int>(std::lround(link.length[0])), static_cast<int>(std::lround(link.length[1]))}}};
        BoundaryMesh mesh = mesh_edges(b, numbers.edges);
        const SubmapFace done = mesh_submap_face(b, mesh, f, face, numbers);
        const QuadReport report = verified(mesh, f);
        INFO(report.text());
        CHECK(report.ok());
        const FaceMesh& result = mesh.faces[f.index()];
        CHECK(result.quads.size() == 18 + 6 - 1);
        CHECK_FALSE(result.structured());
        CHECK(done.folded.empty());
        CHECK(done.folded_harmonic == 0);
        for (std::size_t n = 0; n < result.nodes.size(); ++n) {
            const Vec3& x = mesh.nodes[result.nodes[n]];
            CHECK((x - Vec3(std::round(x[0]), std::round(x[1]), 1.0)).norm() < 1e-9);  // back on the unit lattice
            CHECK((b.face_point(f, result.uv[n]) - x).norm() < 1e-9);
        }
        const QuadCorners& q = result.quads[0];
        const Vec3 a = mesh.nodes[result.nodes[q[1]]] - mesh.nodes[result.nodes[q[0]]];
        const Vec3 c = mesh.nodes[result.nodes[q[3]]] - mesh.nodes[result.nodes[q[0]]];
        CHECK(a.cross(c)[2] * sense > 0.9);
    }
}

TEST_CASE("a rectangle is structured as a linking side is") {
    TestBrep b;
    const FaceId f = b.flat_polygon(lift(b, rectangle(3, 2), 0));
    SubmapNumbers numbers{{3, 2, 3, 2}, {{}}};
    BoundaryMesh mesh = mesh_edges(b, numbers.edges);
    (void)mesh_submap_face(b, mesh, f, shape(b, f), numbers);
    const FaceMesh& face = mesh.faces[f.index()];
    CHECK(face.columns == 3);
    CHECK(face.rows == 2);
    for (std::size_t n = 0; n < 12; ++n) {
        CHECK((mesh.nodes[face.nodes[n]] - Vec3(static_cast<double>(n % 4), static_cast<double>(n / 4), 0)).norm() <
              1e-12);
    }
}

TEST_CASE("inner nodes of a curved wall lie on it") {
    TestBrep b;
    const VertexId a = b.vertex({2, 0, 0}), c = b.vertex({0, 2, 0}), d = b.vertex({3, 0, 3}), e = b.vertex({0, 3, 3});
    const EdgeId low = b.arc(a, c, {0, 0, 0}, {0, 0, 1}), high = b.arc(d, e, {0, 0, 3}, {0, 0, 1});
    const OrientedEdge right = b.joint(c, e), left = b.joint(d, a);
    const FaceId f = b.wall(low, high, {{{low, true}, right, {high, false}, left}});
    SubmapNumbers numbers{{6, 6, 4, 4}, {{}}};
    BoundaryMesh mesh = mesh_edges(b, numbers.edges);
    const SubmapFace done = mesh_submap_face(b, mesh, f, shape(b, f), numbers);
    CHECK(done.folded.empty());
    CHECK(verified(mesh, f).ok());
    for (const Index n : mesh.faces[f.index()].nodes) {
        const Vec3& x = mesh.nodes[n];
        CHECK(std::hypot(x[0], x[1]) == Approx(2.0 + x[2] / 3.0).epsilon(1e-9));
    }
}

TEST_CASE("numbers that fold the face back on itself are refused") {
    TestBrep b;  // a U; its slot is deeper than the U is high
    const FaceId f = b.flat_polygon(lift(b, {{0, 0}, {3, 0}, {3, 3}, {2, 3}, {2, 1}, {1, 1}, {1, 3}, {0, 3}}, 0));
    SubmapNumbers numbers{{3, 3, 1, 4, 1, 4, 1, 3}, {{}}};
    BoundaryMesh mesh = mesh_edges(b, numbers.edges);
    const LogicalFace face = shape(b, f);
    CHECK_THROWS_AS(mesh_submap_face(b, mesh, f, face, numbers), InputError);
}
