#include "support/catch.hpp"
#include "support/foreign_meshes.hpp"
#include "support/shapes.hpp"

#include <pavior/mesh/verify_quads.hpp>

#include <limits>
#include <vector>

using namespace pavior;

namespace {
// The mesh has this one finding and no other.
void check_only(const QuadReport& report, MeshFault fault, std::size_t count, const Error::Ids& ids, ErrorCode code) {
    INFO(report.text());
    REQUIRE(report.findings().size() == 1);
    CHECK(report.first()->fault == fault);
    CHECK(report.first()->count == count);
    CHECK(report.first()->ids == ids);
    try {
        report.throw_if_bad();
        FAIL("did not throw");
    } catch (const InputError& error) {
        CHECK(error.code() == code);
        CHECK(error.ids() == ids);
    }
}

QuadMesh on_nodes(std::size_t nodes, std::vector<QuadCorners> quads) {
    return {std::vector<Vec3>(nodes, Vec3::Zero()), std::move(quads)};
}
}  // namespace

TEST_CASE("sound meshes") {
    const QuadReport grid = verify_quads(shapes::grid_cap(4, 3));
    CHECK(grid.ok());
    CHECK(grid.components == 1);
    CHECK(grid.boundary_edges == 14);
    CHECK(verify_quads(shapes::square_ring(2)).ok());
    CHECK(verify_quads(shapes::annulus(7, 2)).ok());
    CHECK(verify_quads(shapes::l_shape(3)).ok());
    CHECK(verify_quads(archetype::Quads(shapes::random_cap(5, 5, 0.2, 1))).ok());
    const auto cube = on_nodes(8, {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}});
    CHECK(verify_quads(cube).ok());
    CHECK(verify_quads(cube).boundary_edges == 0);
}

TEST_CASE("no quads") { check_only(verify_quads(QuadMesh{}), MeshFault::empty, 1, {}, ErrorCode::empty_input); }

TEST_CASE("coordinates of quads that are not finite") {
    QuadMesh mesh = shapes::grid_cap(2, 2);
    mesh.nodes[4].y() = std::numeric_limits<double>::quiet_NaN();
    mesh.nodes[7].z() = -std::numeric_limits<double>::infinity();
    check_only(verify_quads(mesh), MeshFault::not_finite, 2, {4, 7}, ErrorCode::not_finite);
}

TEST_CASE("node ids out of range") {
    QuadMesh mesh = shapes::grid_cap(2, 2);
    mesh.quads.push_back({0, 1, 4, 9});
    check_only(verify_quads(mesh), MeshFault::id_out_of_range, 1, {4}, ErrorCode::bad_index);
}

TEST_CASE("a node twice in one quad") {
    for (const QuadCorners& bad : {QuadCorners{0, 0, 1, 4}, QuadCorners{0, 1, 0, 4}, QuadCorners{1, 4, 3, 1}}) {
        QuadMesh mesh = shapes::grid_cap(2, 2);
        mesh.quads.push_back(bad);
        check_only(verify_quads(mesh), MeshFault::repeated_node, 1, {4}, ErrorCode::bad_index);
    }
}

TEST_CASE("a quad twice, in any order of its nodes") {
    for (const QuadCorners& again : {QuadCorners{1, 2, 5, 4}, QuadCorners{5, 4, 1, 2}, QuadCorners{4, 5, 2, 1}}) {
        QuadMesh mesh = shapes::grid_cap(2, 2);
        mesh.quads.push_back(again);
        check_only(verify_quads(mesh), MeshFault::duplicate_cell, 1, {4}, ErrorCode::bad_orientation);
    }
}

TEST_CASE("an edge in the same sense twice") {
    check_only(verify_quads(on_nodes(6, {{0, 1, 2, 3}, {0, 1, 5, 4}})), MeshFault::same_sense, 1, {0, 1},
               ErrorCode::bad_orientation);
    QuadMesh mesh = shapes::grid_cap(3, 3);
    std::swap(mesh.quads[4][1], mesh.quads[4][3]);
    check_only(verify_quads(mesh), MeshFault::same_sense, 4, {5, 6, 5, 9, 6, 10, 9, 10}, ErrorCode::bad_orientation);
}

TEST_CASE("an edge of three quads") {
    check_only(verify_quads(on_nodes(8, {{0, 1, 2, 3}, {1, 0, 4, 5}, {0, 1, 6, 7}})), MeshFault::overused, 1, {0, 1},
               ErrorCode::non_manifold);
}

TEST_CASE("two sheets that touch at a node: on the boundary, inside, and both") {
    check_only(verify_quads(on_nodes(7, {{0, 1, 2, 3}, {2, 4, 5, 6}})), MeshFault::touching_sheets, 1, {2},
               ErrorCode::non_manifold);
    // Two 2 x 2 grids that share their middle node 4.
    QuadMesh mesh = shapes::grid_cap(2, 2);
    for (const QuadCorners& q : shapes::grid_cap(2, 2).quads) {
        QuadCorners c = q;
        for (Index& i : c) {
            i = i == 4 ? 4 : i + 9 - (i > 4 ? 1 : 0);
        }
        mesh.quads.push_back(c);
    }
    mesh.nodes.resize(17, Vec3::Zero());
    check_only(verify_quads(mesh), MeshFault::touching_sheets, 1, {4}, ErrorCode::non_manifold);
    // A grid's middle node and the corner of one quad.
    QuadMesh corner = shapes::grid_cap(2, 2);
    corner.nodes.resize(12, Vec3::Zero());
    corner.quads.push_back({4, 9, 10, 11});
    check_only(verify_quads(corner), MeshFault::touching_sheets, 1, {4}, ErrorCode::non_manifold);
}

TEST_CASE("nodes of no quad") {
    QuadMesh mesh = shapes::grid_cap(2, 2);
    mesh.nodes.emplace_back(5, 5, 5);
    check_only(verify_quads(mesh), MeshFault::unused_node, 1, {9}, ErrorCode::unused_node);
    CHECK(verify_quads(mesh, {.allow_unused_nodes = true}).ok());
}

TEST_CASE("components are counted, and a fault only on request") {
    const QuadMesh two = on_nodes(8, {{4, 5, 6, 7}, {0, 1, 2, 3}});
    CHECK(verify_quads(two).ok());
    CHECK(verify_quads(two).components == 2);
    check_only(verify_quads(two, {.max_components = 1}), MeshFault::disconnected, 2, {0, 1}, ErrorCode::non_manifold);
}

TEST_CASE("all faults are listed; ids are capped, counts exact") {
    QuadMesh mesh = shapes::grid_cap(2, 2);
    mesh.nodes[0].x() = std::numeric_limits<double>::quiet_NaN();
    mesh.quads.push_back({0, 1, 4, 77});
    mesh.quads.push_back({0, 0, 1, 4});
    mesh.quads.push_back({0, 1, 4, 3});
    for (int i = 0; i < 50; ++i) {
        mesh.nodes.emplace_back(i, 5, 5);
    }
    const QuadReport report = verify_quads(mesh, {.cap = 3});
    REQUIRE(report.findings().size() == 5);
    CHECK(report.findings()[0].ids == Error::Ids{0});
    CHECK(report.findings()[1].ids == Error::Ids{4});
    CHECK(report.findings()[2].ids == Error::Ids{5});
    CHECK(report.findings()[3].ids == Error::Ids{6});
    CHECK(report.findings()[4].count == 50);
    CHECK(report.findings()[4].ids == Error::Ids{9, 10, 11});
}
