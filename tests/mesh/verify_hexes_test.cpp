#include "support/catch.hpp"
#include "support/foreign_meshes.hpp"
#include "support/shapes.hpp"

#include <pavior/mesh/edge_table.hpp>
#include <pavior/mesh/eigen_access.hpp>
#include <pavior/mesh/verify_hexes.hpp>

#include <chrono>
#include <limits>
#include <random>

using namespace pavior;

namespace {
// The mesh has this one finding and no other.
void check_only(const HexReport& report, MeshFault fault, std::size_t count, const Error::Ids& ids, ErrorCode code) {
    INFO(report.text());
    REQUIRE(report.findings().size() == 1);
    CHECK(report.first()->fault == fault);
    CHECK(report.first()->count == count);
    CHECK(report.first()->ids == ids);
    CHECK_THROWS_AS(report.throw_if_bad(), InputError);
    CHECK(error_code(report.first()->fault) == code);
}

HexMesh shaken_box(std::size_t n) {
    HexMesh mesh = shapes::hex_box(n, n, n);
    std::mt19937 generator(11);
    for (Vec3& x : mesh.nodes) {
        for (int axis = 0; axis < 3; ++axis) {
            x[axis] += 0.2 / static_cast<double>(n) * (2.0 * static_cast<double>(generator()) / 4294967295.0 - 1.0);
        }
    }
    return mesh;
}
}  // namespace

TEST_CASE("sound meshes: box, ring, L") {
    const HexReport box = verify_hexes(shapes::hex_box(3, 4, 5, Vec3(1, 2, 3)));
    INFO(box.text());
    CHECK(box.ok());
    CHECK(box.boundary_quads == 94);
    CHECK(box.inner_quads == 133);
    CHECK(box.crossed_edges == 0);
    CHECK(box.volume == Approx(6.0).epsilon(1e-14));
    CHECK(box.boundary_flux == Approx(6.0).epsilon(1e-14));
    CHECK(box.min_det == Approx(0.1).epsilon(1e-12));
    CHECK(verify_hexes(shapes::extrusion(shapes::square_ring(1), 3, 2.0)).volume == Approx(6.0));
    CHECK(verify_hexes(shapes::extrusion(shapes::l_shape(2), 2)).ok());
    CHECK(verify_hexes(shaken_box(6)).ok());
}

TEST_CASE("foreign meshes give the same report") {
    const HexMesh box = shaken_box(4);
    Eigen::MatrixXd v(box.nodes.size(), 3);
    Eigen::Matrix<long, Eigen::Dynamic, 8> h(box.hexes.size(), 8);
    for (std::size_t i = 0; i < box.nodes.size(); ++i) {
        v.row(static_cast<Eigen::Index>(i)) = box.nodes[i].transpose();
    }
    for (std::size_t c = 0; c < box.hexes.size(); ++c) {
        for (std::size_t k = 0; k < 8; ++k) {
            h(static_cast<Eigen::Index>(c), static_cast<Eigen::Index>(k)) = box.hexes[c][k];
        }
    }
    CHECK(verify_hexes(EigenHexMesh(v, h)).volume == verify_hexes(box).volume);
    const HexReport rounded = verify_hexes(archetype::Hexes(box));
    CHECK(rounded.ok());
    CHECK(rounded.volume == Approx(verify_hexes(box).volume).epsilon(1e-6));
}

TEST_CASE("no hexahedra") { check_only(verify_hexes(HexMesh{}), MeshFault::empty, 1, {}, ErrorCode::empty_input); }

TEST_CASE("coordinates that are not finite") {
    HexMesh mesh = shapes::hex_box(2, 2, 2);
    mesh.nodes[13].x() = std::numeric_limits<double>::quiet_NaN();
    const HexReport report = verify_hexes(mesh);
    CHECK(report.first()->fault == MeshFault::not_finite);
    CHECK(report.first()->ids == Error::Ids{13});
    CHECK(report.count(MeshFault::inverted) == 8);
    CHECK(std::isnan(report.min_det));
}

TEST_CASE("ids out of range, and twice in one hexahedron") {
    HexMesh mesh = shapes::hex_box(2, 2, 2);
    mesh.hexes.push_back({0, 1, 2, 3, 4, 5, 6, 27});
    check_only(verify_hexes(mesh), MeshFault::id_out_of_range, 1, {8}, ErrorCode::bad_index);
    mesh.hexes.back() = {0, 1, 2, 3, 4, 5, 6, 0};
    check_only(verify_hexes(mesh), MeshFault::repeated_node, 1, {8}, ErrorCode::bad_index);
}

TEST_CASE("a quad of three hexahedra leaves the boundary open") {
    HexMesh mesh = shapes::hex_box(2, 1, 1);
    for (const Vec3& x : {Vec3(1, -1, 0.1), Vec3(1, 0.5, 0.2), Vec3(1, -1, 1.1), Vec3(1, 0.5, 1.2)}) {
        mesh.nodes.push_back(x);
    }
    mesh.hexes.push_back({1, 12, 13, 4, 7, 14, 15, 10});
    const HexReport report = verify_hexes(mesh);
    CHECK(report.first()->fault == MeshFault::overused);
    CHECK(report.first()->ids == Error::Ids{1, 4, 10, 7});
    CHECK(report.count(MeshFault::open_boundary) == 4);
    CHECK(report.find(MeshFault::open_boundary)->ids == Error::Ids{1, 4, 1, 7, 4, 10, 7, 10});
}

TEST_CASE("two hexahedra that see their quad from one side, or in another order") {
    HexMesh mesh = shapes::hex_box(2, 1, 1);
    const HexCorners c = mesh.hexes[1];
    mesh.hexes[1] = {c[4], c[5], c[6], c[7], c[0], c[1], c[2], c[3]};
    HexReport report = verify_hexes(mesh);
    CHECK(report.first()->fault == MeshFault::same_sense);
    CHECK(report.first()->ids == Error::Ids{1, 4, 10, 7});
    CHECK(report.count(MeshFault::inverted) == 1);
    // The same four nodes, two of them swapped.
    mesh = shapes::hex_box(2, 1, 1);
    std::swap(mesh.hexes[1][0], mesh.hexes[1][4]);
    report = verify_hexes(mesh);
    CHECK(report.first()->fault == MeshFault::same_sense);
    // A hexahedron twice.
    mesh = shapes::hex_box(2, 1, 1);
    mesh.hexes.push_back(mesh.hexes[1]);
    report = verify_hexes(mesh);
    CHECK(report.first()->fault == MeshFault::overused);
    CHECK(report.count(MeshFault::same_sense) == 5);
}

TEST_CASE("unused and duplicate nodes") {
    HexMesh mesh = shapes::hex_box(2, 2, 2);
    mesh.nodes.emplace_back(0.25, 0.25, 0.25);
    check_only(verify_hexes(mesh), MeshFault::unused_node, 1, {27}, ErrorCode::unused_node);
    CHECK(verify_hexes(mesh, {.allow_unused_nodes = true}).ok());

    // Two boxes side by side that do not share the nodes of their common side.
    mesh = shapes::hex_box(1, 1, 1);
    for (const Vec3& x : shapes::hex_box(1, 1, 1).nodes) {
        mesh.nodes.push_back(x + Vec3(1.0 + 1e-11, 0, 0));
    }
    HexCorners second = mesh.hexes[0];
    for (Index& i : second) {
        i += 8;
    }
    mesh.hexes.push_back(second);
    check_only(verify_hexes(mesh), MeshFault::duplicate_node, 4, {8, 1, 10, 3, 12, 5, 14, 7},
               ErrorCode::duplicate_node);
    CHECK(verify_hexes(mesh, {.node_tolerance = 1e-12}).ok());
    CHECK(verify_hexes(mesh, {.node_tolerance = -1.0}).ok());
}

TEST_CASE("inverted hexahedra, at the corners and inside") {
    HexMesh mesh = shapes::hex_box(3, 3, 3);
    mesh.nodes[21] += Vec3(0.5, 0, 0);  // inner node (1, 1, 1), past its neighbour
    const HexReport report = verify_hexes(mesh, {.cap = 2});
    REQUIRE(report.findings().size() == 1);
    CHECK(report.first()->fault == MeshFault::inverted);
    CHECK(report.count(MeshFault::inverted) == 4);
    CHECK(report.first()->ids == Error::Ids{1, 4});
    CHECK(report.min_det < 0.0);
    CHECK(report.volume == Approx(1.0));

    HexMesh twisted = shapes::hex_box(1, 1, 1, Vec3(2, 2, 1));  // top turned by 135 degrees
    for (std::size_t i = 4; i < 8; ++i) {
        const Vec3 c = twisted.nodes[i] - Vec3(1, 1, 0);
        const double h = std::sqrt(0.5);
        twisted.nodes[i] = Vec3(1 + h * (-c.x() - c.y()), 1 + h * (c.x() - c.y()), c.z());
    }
    CHECK(verify_hexes(twisted).ok());
    CHECK(verify_hexes(twisted, {.samples = 4}).ok());  // det J = 2 (1 + cos) > 0 on the axis
    twisted.nodes[4] += Vec3(0.9, 0.9, 0);
    CHECK(verify_hexes(twisted, {.samples = 4}).min_det < verify_hexes(twisted).min_det);
    CHECK_THROWS_AS(verify_hexes(twisted, {.samples = 0}), InputError);
}

TEST_CASE("the boundary is the given one") {
    const HexMesh mesh = shapes::hex_box(2, 2, 2);
    std::vector<QuadCorners> quads = boundary_quads(mesh);
    CHECK(verify_hexes(mesh, quads).ok());
    std::reverse(quads.begin(), quads.end());
    for (QuadCorners& q : quads) {
        std::rotate(q.begin(), q.begin() + 2, q.end());
    }
    CHECK(verify_hexes(mesh, quads).ok());
    const QuadCorners last = quads.back();
    quads.pop_back();
    const Error::Ids ids{0, 3, 4, 1};
    CHECK(from_smallest(last) == QuadCorners{0, 3, 4, 1});
    check_only(verify_hexes(mesh, quads), MeshFault::boundary_extra, 1, ids, ErrorCode::inconsistent_boundary);
    quads.push_back(last);
    quads.push_back(last);
    check_only(verify_hexes(mesh, quads), MeshFault::boundary_missing, 1, ids, ErrorCode::inconsistent_boundary);
    quads.pop_back();
    std::reverse(quads.back().begin(), quads.back().end());
    const HexReport reversed = verify_hexes(mesh, quads);
    CHECK(reversed.count(MeshFault::boundary_missing) == 1);
    CHECK(reversed.count(MeshFault::boundary_extra) == 1);
    CHECK(verify_hexes(mesh, std::vector<QuadCorners>{}).count(MeshFault::boundary_extra) == 24);
}

TEST_CASE("two boxes that share one edge: closed, and the edge is counted") {
    HexMesh mesh = shapes::hex_box(2, 2, 1);
    mesh.hexes = {mesh.hexes[0], mesh.hexes[3]};
    const HexReport report = verify_hexes(mesh, {.allow_unused_nodes = true});
    CHECK(report.ok());
    CHECK(report.crossed_edges == 1);
}

TEST_CASE("scale and place do not matter") {
    for (const double scale : {1e-200, 1e-6, 1e6, 1e150}) {
        HexMesh mesh = shaken_box(3);
        for (Vec3& x : mesh.nodes) {
            x = scale * (x + Vec3(100, 0, 0));
        }
        const HexReport report = verify_hexes(mesh);
        INFO(scale << " " << report.text());
        CHECK(report.ok());
    }
}

TEST_CASE("the report is the same for any number of threads, and a big mesh is quick") {
    HexMesh mesh = shaken_box(50);
    mesh.nodes[70000] += Vec3(0.3, 0.3, 0.3);
    mesh.nodes[5000] += Vec3(0.3, 0.3, 0.3);
    const auto start = std::chrono::steady_clock::now();
    const HexReport one = verify_hexes(mesh);
    CHECK(std::chrono::steady_clock::now() - start < std::chrono::seconds(5));
    CHECK(one.count(MeshFault::inverted) > 0);
    for (const unsigned threads : {2U, 3U, 7U}) {
        const HexReport many = verify_hexes(mesh, {.execution = {threads}});
        CHECK(many.findings() == one.findings());
        CHECK(many.volume == one.volume);
        CHECK(many.boundary_flux == one.boundary_flux);
        CHECK(many.min_det == one.min_det);
    }
}
