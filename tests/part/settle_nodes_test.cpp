#include "support/catch.hpp"
#include "support/shapes.hpp"
#include "support/test_brep.hpp"

#include <pavior/core/error.hpp>
#include <pavior/mesh/boundary_quads.hpp>
#include <pavior/mesh/mesh_check.hpp>
#include <pavior/part/settle_nodes.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

using namespace pavior;
using namespace pavior::test;

namespace {

/// A grid of the unit cube, the faces of its quads by their centres.
SolidsMesh grid_mesh(std::size_t nx, std::size_t ny, std::size_t nz, const std::function<int(const Vec3&)>& face_of) {
    SolidsMesh mesh;
    mesh.mesh = shapes::hex_box(nx, ny, nz);
    mesh.hex_solid.assign(mesh.mesh.hexes.size(), SolidId{0});
    for (const QuadCorners& c : boundary_quads(mesh.mesh)) {
        Vec3 centre = Vec3::Zero();
        for (const Index i : c) {
            centre += mesh.mesh.nodes[i] / 4;
        }
        mesh.quads.push_back(c);
        mesh.quad_face.push_back(FaceId{face_of(centre)});
    }
    return mesh;
}

/// The unit cube, with a vertex at (at, 0) in the middle of one side of its outline: the walls 0 and 1 are coplanar.
TestBrep cube_with_halved_wall(double at) {
    TestBrep b;
    add_prism(b, {{0, 0}, {at, 0}, {1, 0}, {1, 1}, {0, 1}}, 0, 1);
    return b;
}

/// The face of the cube with the halved wall that a point lies on, found by its own points.
std::function<int(const Vec3&)> nearest_face(const TestBrep& b, double at) {
    return [&b, at](const Vec3& x) {
        for (std::int32_t f = 0; f < static_cast<std::int32_t>(b.face_count()); ++f) {
            const FaceId face{f};
            if ((b.face_point(face, b.closest_on_face(face, x)) - x).norm() > 1e-9) {
                continue;
            }
            double low = 2, high = -1;  // of the vertices, along x
            for (const EdgeLoop& loop : b.face_loops(face)) {
                for (const OrientedEdge& use : loop) {
                    for (const VertexId v : b.edge_vertices(use.edge)) {
                        low = std::min(low, b.vertex_point(v).x());
                        high = std::max(high, b.vertex_point(v).x());
                    }
                }
            }
            const bool halved = x.y() < 1e-9 && x.z() > 1e-9 && x.z() < 1 - 1e-9;
            if (!halved || (x.x() < at ? low == 0 && high == at : low == at && high == 1)) {
                return static_cast<int>(f);
            }
        }
        return -1;
    };
}

std::size_t nodes_at(const SolidsMesh& mesh, const Vec3& x) {
    return static_cast<std::size_t>(std::count_if(mesh.mesh.nodes.begin(), mesh.mesh.nodes.end(),
                                                  [&](const Vec3& node) { return (node - x).norm() < 1e-12; }));
}

}  // namespace

TEST_CASE("A vertex where edges run straight on gets the node where the mesh changes faces; spacing is kept") {
    const TestBrep b = cube_with_halved_wall(0.4);
    SolidsMesh mesh = grid_mesh(4, 3, 3, nearest_face(b, 0.4));
    REQUIRE(std::none_of(mesh.quad_face.begin(), mesh.quad_face.end(), [](FaceId f) { return f.value < 0; }));
    const std::vector<Vec3> before = mesh.mesh.nodes;
    const SettledNodes settled = settle_nodes(b, mesh, {.size = 0.25});
    CHECK(settled.held == 0);
    CHECK(settled.min_jacobian > 0.5);
    for (const double z : {0.0, 1.0}) {
        for (const double x : {0.2, 0.4, 0.7}) {
            CHECK(nodes_at(mesh, {x, 0, z}) == 1);
        }
        CHECK(nodes_at(mesh, {0.5, 0, z}) == 0);
    }
    CHECK(nodes_at(mesh, {0.5, 0, 1.0 / 3}) == 1);  // the edge between coplanar walls is none for the mesh
    for (std::size_t i = 0; i < before.size(); ++i) {
        const bool on_line = before[i].y() == 0 && (before[i].z() == 0 || before[i].z() == 1);
        CHECK((on_line || mesh.mesh.nodes[i] == before[i]));
        CHECK(settled.of_node[i].id >= 0);
    }
    CHECK(check_mesh(mesh.mesh).valid());
}

TEST_CASE("Nodes of chords go to circles and walls; those too far are held where they are") {
    TestBrep b;
    add_cylinder(b, 2, 2, 3);
    constexpr int wall = 0, bottom = 1, top = 2;
    SolidsMesh mesh = grid_mesh(6, 6, 3, [](const Vec3& x) {
        return x.z() < 1e-9 ? bottom : x.z() > 1 - 1e-9 ? top : wall;
    });
    std::vector<char> outer;
    for (Vec3& x : mesh.mesh.nodes) {
        const Vec2 p(2 * x.x() - 1, 2 * x.y() - 1);
        const double size = p.lpNorm<Eigen::Infinity>();
        const Vec2 round = size > 0 ? Vec2(1.98 * size * p.normalized()) : Vec2(Vec2::Zero());
        outer.push_back(size > 1 - 1e-9 ? 1 : 0);
        x = {round.x(), round.y(), 3 * x.z()};
    }
    const SolidsMesh before = mesh;
    const SettledNodes settled = settle_nodes(b, mesh, {.size = 0.7});
    CHECK(settled.held == 0);
    for (std::size_t i = 0; i < outer.size(); ++i) {
        const Vec3& x = mesh.mesh.nodes[i];
        CHECK(x.z() == Approx(before.mesh.nodes[i].z()).margin(1e-12));
        if (outer[i] != 0) {
            CHECK(x.head<2>().norm() == Approx(2).epsilon(1e-12));
            CHECK(settled.of_node[i].dimension == (x.z() < 1e-9 || x.z() > 3 - 1e-9 ? 1 : 2));
        }
    }
    SolidsMesh far = before;
    const SettledNodes held = settle_nodes(b, far, {.size = 0.7, .near_feature = 0.001, .near = 0.001});
    CHECK(held.held == static_cast<std::size_t>(std::count(outer.begin(), outer.end(), 1)));
    CHECK(far.mesh.nodes == before.mesh.nodes);
}

TEST_CASE("Inner nodes make room; what stays inverted keeps its place") {
    const TestBrep b = cube_with_halved_wall(0.5);
    SolidsMesh mesh = grid_mesh(4, 4, 4, nearest_face(b, 0.5));
    const auto under_top = [](const Vec3& x) { return std::abs(x.z() - 0.75) < 1e-9; };
    for (Vec3& x : mesh.mesh.nodes) {
        const bool inside = x.x() > 0.1 && x.x() < 0.9 && x.y() > 0.1 && x.y() < 0.9;
        if (inside && x.z() == 1) {
            x.z() = 1.02;  // above its face, and the nodes below it nearly there
        } else if (inside && under_top(x)) {
            x.z() = 1.005;
        }
    }
    const SettledNodes settled = settle_nodes(b, mesh, {.size = 0.25});
    CHECK(settled.held == 0);
    CHECK(settled.min_jacobian > 0.1);
    CHECK(check_mesh(mesh.mesh).valid());

    SolidsMesh thin = grid_mesh(4, 4, 1, nearest_face(b, 0.5));  // no inner nodes, the top folds over
    for (Vec3& x : thin.mesh.nodes) {
        x.x() = x.z() == 1 && x.x() == 0.5 && x.y() == 0.5 ? 0.74 : x.x();
    }
    const double least = settle_nodes(b, thin, {.size = 0.25}).min_jacobian;
    CHECK(least > 0);
}

TEST_CASE("settle_nodes() refuses sizes and distances that are none") {
    const TestBrep b = cube_with_halved_wall(0.5);
    SolidsMesh mesh = grid_mesh(2, 2, 2, nearest_face(b, 0.5));
    CHECK_THROWS_AS(settle_nodes(b, mesh, {}), InputError);
    CHECK_THROWS_AS(settle_nodes(b, mesh, {.size = 1, .near = -1}), InputError);
}
