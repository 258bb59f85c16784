#include "support/archetypes.hpp"
#include "support/catch.hpp"
#include "support/shapes.hpp"
#include "support/test_brep.hpp"

#include <pavior/core/error.hpp>
#include <pavior/core/stop.hpp>
#include <pavior/mesh/boundary_quads.hpp>
#include <pavior/mesh/mesh_check.hpp>
#include <pavior/mesh/outward_quads.hpp>
#include <pavior/part/pillow_solids.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <set>
#include <stop_token>
#include <vector>

using namespace pavior;
using namespace pavior::test;

namespace {

constexpr double pi = std::numbers::pi;

/// A grid of 2 * reach cells a side, levels at heights, bent so that its squares become circles; hexahedra that
/// solid_of (of level and ring) gives no solid are left out.
SolidsMesh round_grid(int reach, const std::vector<double>& heights, const std::function<int(int, int)>& solid_of,
                      double radius = 2) {
    SolidsMesh result;
    const auto n = static_cast<std::size_t>(2 * reach);
    HexMesh grid = shapes::hex_box(n, n, heights.size() - 1);
    for (std::size_t i = 0; i < grid.nodes.size(); ++i) {
        Vec3& x = grid.nodes[i];
        const Vec2 p(2 * x.x() - 1, 2 * x.y() - 1);
        const double size = p.lpNorm<Eigen::Infinity>();
        const Vec2 round = size > 0 ? Vec2(radius * size * p.normalized()) : Vec2(Vec2::Zero());
        x = {round.x(), round.y(), heights[i / ((n + 1) * (n + 1))]};
    }
    std::vector<Index> id(grid.nodes.size(), no_index);
    for (std::size_t h = 0; h < grid.hexes.size(); ++h) {
        const int i = static_cast<int>(h % n) - reach, j = static_cast<int>(h / n % n) - reach;
        const int ring = std::max(i < 0 ? -i : i + 1, j < 0 ? -j : j + 1);
        const int solid = solid_of(static_cast<int>(h / (n * n)), ring);
        if (solid < 0) {
            continue;
        }
        HexCorners c = grid.hexes[h];
        for (Index& node : c) {
            if (id[node] == no_index) {
                id[node] = static_cast<Index>(result.mesh.nodes.size());
                result.mesh.nodes.push_back(grid.nodes[node]);
            }
            node = id[node];
        }
        result.mesh.hexes.push_back(c);
        result.hex_solid.push_back(SolidId{solid});
    }
    return result;
}

/// Lists the quads of the boundary and between solids, each on the face that face_of (of the nodes) names.
void list_quads(SolidsMesh& mesh, const std::function<FaceId(const std::vector<Vec3>&)>& face_of) {
    const FaceTable table(mesh.mesh);
    table.for_each(mesh.mesh, 0, mesh.mesh.nodes.size(), [&](Index, std::span<const FaceTable::Use> uses) {
        if (uses.size() == 1 || mesh.hex_solid[uses[0].hex()] != mesh.hex_solid[uses[1].hex()]) {
            mesh.quads.push_back(hex_face(mesh.mesh.hexes[uses[0].hex()], uses[0].local()));
            std::vector<Vec3> x;
            for (const Index i : mesh.quads.back()) {
                x.push_back(mesh.mesh.nodes[i]);
            }
            mesh.quad_face.push_back(face_of(x));
        }
    });
}

bool all(const std::vector<Vec3>& points, const std::function<bool(const Vec3&)>& holds) {
    return std::all_of(points.begin(), points.end(), holds);
}

std::function<bool(const Vec3&)> at_height(double z) {
    return [z](const Vec3& x) { return std::abs(x.z() - z) < 1e-9; };
}
std::function<bool(const Vec3&)> at_radius(double r) {
    return [r](const Vec3& x) { return std::abs(x.head<2>().norm() - r) < 1e-9; };
}

constexpr int wall = 0, bottom = 1, top = 2;  // faces of add_cylinder()

SolidsMesh cylinder_mesh(int reach = 3) {
    SolidsMesh mesh = round_grid(reach, {0, 1, 2, 3}, [](int, int) { return 0; });
    list_quads(mesh, [](const std::vector<Vec3>& x) {
        return FaceId{all(x, at_height(0)) ? bottom : all(x, at_height(3)) ? top : wall};
    });
    return mesh;
}

std::size_t count(const SolidsMesh& mesh, int face) {
    return static_cast<std::size_t>(std::count(mesh.quad_face.begin(), mesh.quad_face.end(), FaceId{face}));
}

/// Conforming, without inverted hexahedra, and all quads of the boundary listed.
double require_sound(const SolidsMesh& mesh) {
    const MeshCheck check = check_mesh(mesh.mesh);
    INFO(check.verify.text());
    REQUIRE(check.valid());
    REQUIRE(mesh.hex_solid.size() == mesh.mesh.hexes.size());
    REQUIRE(mesh.quad_face.size() == mesh.quads.size());
    std::vector<QuadCorners> outer;
    std::size_t shared = 0;
    const auto faces = faces_under_quads(mesh.mesh, mesh.quads);
    for (std::size_t q = 0; q < mesh.quads.size(); ++q) {
        REQUIRE(faces[q][0].hex != no_index);
        if (faces[q][1].hex == no_index) {
            outer.push_back(from_smallest(hex_face(mesh.mesh.hexes[faces[q][0].hex], faces[q][0].face)));
        } else {
            CHECK(mesh.hex_solid[faces[q][0].hex] != mesh.hex_solid[faces[q][1].hex]);
            ++shared;
        }
    }
    std::vector<QuadCorners> boundary = boundary_quads(mesh.mesh);
    std::sort(outer.begin(), outer.end());
    std::sort(boundary.begin(), boundary.end());
    CHECK(outer == boundary);
    CHECK(shared + outer.size() == mesh.quads.size());
    return check.verify.volume;
}

/// Every quad lies on its face.
void require_on_faces(const SolidsMesh& mesh, const std::vector<std::function<bool(const Vec3&)>>& faces) {
    for (std::size_t q = 0; q < mesh.quads.size(); ++q) {
        for (const Index i : mesh.quads[q]) {
            CHECK(faces[mesh.quad_face[q].index()](mesh.mesh.nodes[i]));
        }
    }
}

}  // namespace

TEST_CASE("A grid on a disc gets a layer under the wall: an O-grid on the cylinder") {
    TestBrep b;
    add_cylinder(b, 2, 2, 3);
    SolidsMesh mesh = cylinder_mesh();
    const SolidsMesh before = mesh;
    const PillowedSolids result = pillow_solids(b, mesh, {.size = 0.7, .enough = 0.45});
    CHECK(result.before < 0.2);
    CHECK(result.after > 0.45);
    REQUIRE(result.taken);
    REQUIRE(result.attempts.size() == 1);
    CHECK(result.attempts[0].faces == std::vector{FaceId{wall}});
    CHECK(result.attempts[0].min_jacobian == result.after);
    CHECK(check_mesh(mesh.mesh).quality.scaled_jacobian.min == Approx(result.after));
    CHECK(mesh.mesh.hexes.size() == 36 * 3 + 24 * 3);
    CHECK(count(mesh, bottom) == 36 + 24);
    CHECK(count(mesh, top) == 36 + 24);
    CHECK(count(mesh, wall) == 24 * 3);
    const double volume = require_sound(mesh);
    CHECK(volume > 0.97 * 12 * pi);
    CHECK(volume < 12 * pi);
    require_on_faces(mesh, {at_radius(2), at_height(0), at_height(3)});
    SolidsMesh again = before;
    const PillowedSolids threads = pillow_solids(b, again, {.size = 0.7, .enough = 0.45, .execution = {4}});
    CHECK(threads.after == result.after);
    CHECK(again.mesh.nodes == mesh.mesh.nodes);
    CHECK(again.quads == mesh.quads);
    const archetype::Brep bare(b);
    again = before;
    CHECK(pillow_solids(bare, again, {.size = 0.7, .enough = 0.45}).after > 0.45);
}

TEST_CASE("A good mesh, and one without time, stay as they are; a stop ends the call") {
    TestBrep b;
    add_cylinder(b, 2, 2, 3);
    SolidsMesh mesh = cylinder_mesh();
    const SolidsMesh before = mesh;
    const auto unchanged = [&] {
        return mesh.mesh.nodes == before.mesh.nodes && mesh.mesh.hexes == before.mesh.hexes &&
               mesh.quads == before.quads;
    };
    const PillowedSolids late = pillow_solids(b, mesh, {.size = 1, .out_of_time = [] { return true; }});
    CHECK_FALSE(late.taken);
    CHECK(late.attempts.empty());
    CHECK(late.after == late.before);
    CHECK(unchanged());
    const PillowedSolids good = pillow_solids(b, mesh, {.size = 1, .enough = 0.5 * late.before});
    CHECK(good.attempts.empty());
    CHECK(unchanged());
    std::stop_source stop;
    stop.request_stop();
    CHECK_THROWS_AS(pillow_solids(b, mesh, {.size = 1, .execution = {1, stop.get_token()}}), Stopped);
    CHECK(unchanged());
    for (const PillowSolidsOptions& bad : {PillowSolidsOptions{}, PillowSolidsOptions{.size = 1, .angle = 180},
                                           PillowSolidsOptions{.size = 1, .enough = 0}}) {
        CHECK_THROWS_AS(pillow_solids(b, mesh, bad), InputError);
    }
    mesh.quad_face.pop_back();
    CHECK_THROWS_AS(pillow_solids(b, mesh, {.size = 1}), InputError);
}

TEST_CASE("Stacked cylinders: the layer goes through the face that they share") {
    TestBrep b;
    const Ring low = add_circle(b, 2, 0), middle = add_circle(b, 2, 1), high = add_circle(b, 2, 3);
    const FaceId bottom = b.flat({{{low.e, true}}}, {0, 0, 1}), shared = b.flat({{{middle.e, true}}}, {0, 0, 1}),
                 top = b.flat({{{high.e, true}}}, {0, 0, 1}), first = add_round_wall(b, low, middle),
                 second = add_round_wall(b, middle, high);
    b.solid({{bottom, false}, {shared, true}, {first, true}});
    b.solid({{shared, false}, {top, true}, {second, true}});
    SolidsMesh mesh = round_grid(3, {0, 1, 2, 3}, [](int level, int) { return level == 0 ? 0 : 1; });
    list_quads(mesh, [&](const std::vector<Vec3>& x) {
        return all(x, at_height(0))      ? bottom
               : all(x, at_height(1))    ? shared
               : all(x, at_height(3))    ? top
               : x[0].z() + x[2].z() < 2 ? first
                                         : second;
    });
    const PillowedSolids result = pillow_solids(b, mesh, {.size = 0.7, .enough = 0.45});
    CHECK(result.after > 0.45);
    REQUIRE(result.taken);
    CHECK(result.attempts[*result.taken].faces == std::vector{first, second});
    CHECK(count(mesh, shared.value) == 36 + 24);
    CHECK(require_sound(mesh) > 0.97 * 12 * pi);
    require_on_faces(mesh, {at_height(0), at_height(1), at_height(3), at_radius(2), at_radius(2)});
}

TEST_CASE("A boss on a disc: its layer goes on under the face that it shares, that of the disc under its own wall") {
    TestBrep b;
    const Ring low = add_circle(b, 2, 0), rim = add_circle(b, 2, 1), foot = add_circle(b, 1, 1),
               high = add_circle(b, 1, 2);
    const FaceId bottom = b.flat({{{low.e, true}}}, {0, 0, 1}),
                 ring = b.flat({{{rim.e, true}}, {{foot.e, false}}}, {0, 0, 1}),
                 shared = b.flat({{{foot.e, true}}}, {0, 0, 1}), top = b.flat({{{high.e, true}}}, {0, 0, 1}),
                 outer = add_round_wall(b, low, rim), inner = add_round_wall(b, foot, high);
    b.solid({{bottom, false}, {ring, true}, {shared, true}, {outer, true}});
    b.solid({{shared, false}, {top, true}, {inner, true}});
    SolidsMesh mesh = round_grid(4, {0, 0.5, 1, 1.5, 2}, [](int level, int r) {
        return level < 2 ? 0 : r <= 2 ? 1 : -1;
    });
    list_quads(mesh, [&](const std::vector<Vec3>& x) {
        return all(x, at_height(0))   ? bottom
               : all(x, at_height(2)) ? top
               : all(x, at_height(1))
                   ? (all(x, [](const Vec3& p) { return p.head<2>().norm() < 1 + 1e-9; }) ? shared : ring)
               : x[0].z() + x[2].z() < 2 ? outer
                                         : inner;
    });
    REQUIRE(count(mesh, ring.value) == 48);
    REQUIRE(count(mesh, inner.value) == 32);
    const PillowedSolids result = pillow_solids(b, mesh, {.size = 0.5, .enough = 0.45});
    CHECK(result.before < 0.2);
    CHECK(result.after > 0.3);
    REQUIRE(result.taken);
    const PillowAttempt& taken = result.attempts[*result.taken];
    CHECK(taken.apart);
    CHECK(std::find(taken.faces.begin(), taken.faces.end(), inner) != taken.faces.end());
    CHECK(std::find(taken.faces.begin(), taken.faces.end(), shared) != taken.faces.end());
    CHECK_FALSE(result.attempts[0].apart);  // through both: flat where the faces lie in one plane
    CHECK(result.attempts[0].min_jacobian < 0);
    CHECK(count(mesh, shared.value) == 16);
    const double volume = require_sound(mesh);
    CHECK(volume > 0.97 * 5 * pi);
    CHECK(volume < 5 * pi);
    require_on_faces(mesh, {at_height(0), at_height(1), at_height(1), at_height(2), at_radius(2), at_radius(1)});
}
