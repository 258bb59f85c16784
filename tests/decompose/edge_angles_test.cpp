#include "support/archetypes.hpp"
#include "support/catch.hpp"
#include "support/test_brep.hpp"
#include "support/voxel_brep.hpp"

#include <pavior/decompose/edge_angles.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <set>
#include <vector>

using namespace pavior;
using namespace pavior::test;

namespace {

/// How many edges have an angle, in degrees; the angle must be the same all along them.
template <brep B>
std::size_t edges_at(const B& b, const std::vector<EdgeAngle>& angles, double degrees) {
    std::size_t count = 0;
    for (const EdgeAngle& angle : angles) {
        CAPTURE(b.tag(1, angle.edge.index()), angle.least, angle.most);
        CHECK(angle.most - angle.least < 1e-6);
        count += std::abs(angle.least - degrees) < 1e-6 ? 1 : 0;
    }
    return count;
}

std::size_t concave(const std::vector<EdgeAngle>& angles) {
    return static_cast<std::size_t>(
        std::count_if(angles.begin(), angles.end(), [](const EdgeAngle& angle) { return angle.concave(); }));
}

std::size_t smooth(const std::vector<EdgeAngle>& angles) {
    return static_cast<std::size_t>(
        std::count_if(angles.begin(), angles.end(), [](const EdgeAngle& angle) { return angle.smooth(); }));
}

/// A prism over a profile of two lines and a quarter circle between them, which bulges or is hollow: a square of side 2
/// whose corner at (2, 2) is rounded with radius 1, or an L of arms of width 1 with a fillet of radius 1.
SolidId add_round_profile(TestBrep& b, bool bulges) {
    std::vector<std::vector<VertexId>> ring;
    std::vector<std::vector<OrientedEdge>> edges;
    for (const double z : {0.0, 1.0}) {
        const std::vector<Vec2> at = bulges ? std::vector<Vec2>{{0, 0}, {2, 0}, {2, 1}, {1, 2}, {0, 2}}
                                            : std::vector<Vec2>{{0, 0}, {3, 0}, {3, 1}, {2, 1}, {1, 2}, {1, 3}, {0, 3}};
        ring.push_back(lift(b, at, z));
        const std::vector<VertexId>& v = ring.back();
        const std::size_t from = bulges ? 2 : 3;
        std::vector<OrientedEdge> loop;
        for (std::size_t i = 0; i < v.size(); ++i) {
            const std::size_t j = (i + 1) % v.size();
            if (i != from) {
                loop.push_back(b.joint(v[i], v[j]));
            } else if (bulges) {
                loop.push_back({b.arc(v[i], v[j], {1, 1, z}, {0, 0, 1}), true});
            } else {
                loop.push_back({b.arc(v[i], v[j], {2, 2, z}, {0, 0, -1}), true});
            }
        }
        edges.push_back(loop);
    }
    std::vector<OrientedFace> faces{{b.flat({edges[0]}, {0, 0, 1}), false}, {b.flat({edges[1]}, {0, 0, 1}), true}};
    const std::size_t n = ring[0].size();
    for (std::size_t i = 0; i < n; ++i) {
        const std::size_t j = (i + 1) % n;
        const OrientedEdge right = b.joint(ring[0][j], ring[1][j]);
        const OrientedEdge left = b.joint(ring[1][i], ring[0][i]);
        const EdgeLoop loop{edges[0][i], right, {edges[1][i].edge, !edges[1][i].forward}, left};
        if (i == (bulges ? 2U : 3U)) {
            faces.push_back({b.wall(edges[0][i].edge, edges[1][i].edge, {loop}), true});
        } else {
            faces.push_back({b.flat_polygon({ring[0][i], ring[0][j], ring[1][j], ring[1][i]}), true});
        }
    }
    return b.solid(std::move(faces));
}

}  // namespace

TEST_CASE("All edges of a box have 90 degrees, whichever way the normals of its faces point") {
    Voxels voxels(1, 1, 1);
    voxels.fill({0, 0, 0}, {1, 1, 1}, 1);
    for (const bool flipped : {false, true}) {
        const VoxelBrep box(voxels, flipped);
        const std::vector<EdgeAngle> angles = edge_angles(box.brep(), SolidId{0});
        CHECK(angles.size() == 12);
        CHECK(edges_at(box.brep(), angles, 90) == 12);
        CHECK(concave(angles) == 0);
        CHECK(smooth(angles) == 0);
    }
}

TEST_CASE("Edges come once each, with the two faces that meet there") {
    TestBrep b;
    const SolidId solid = add_prism(b, l_shape(), 0, 1);
    const archetype::Brep model(b);
    std::set<EdgeId> seen;
    for (const EdgeAngle& angle : edge_angles(model, solid)) {
        CHECK(seen.insert(angle.edge).second);
        CHECK(angle.faces[0].face != angle.faces[1].face);
        for (const OrientedFace& face : angle.faces) {
            const auto all = b.solid_faces(solid);
            CHECK(std::find(all.begin(), all.end(), face) != all.end());
            bool bounds = false;
            for (const EdgeLoop& loop : b.face_loops(face.face)) {
                for (const OrientedEdge& use : loop) {
                    bounds = bounds || use.edge == angle.edge;
                }
            }
            CHECK(bounds);
        }
    }
    CHECK(seen.size() == b.edge_count());
}

TEST_CASE("Notches have 270 degrees, and are concave") {
    for (const bool flipped : {false, true}) {
        Voxels voxels(3, 2, 2);
        voxels.fill({0, 0, 0}, {3, 2, 2}, 1);
        voxels.fill({1, 0, 1}, {2, 2, 2}, 0);  // a slot
        const VoxelBrep slot(voxels, flipped);
        const std::vector<EdgeAngle> angles = edge_angles(slot.brep(), SolidId{0});
        CHECK(angles.size() == 24);
        CHECK(edges_at(slot.brep(), angles, 270) == 2);
        CHECK(edges_at(slot.brep(), angles, 90) == 22);
        CHECK(concave(angles) == 2);
        voxels.fill({1, 0, 1}, {2, 2, 2}, 1);
        voxels.fill({1, 0, 1}, {2, 1, 2}, 0);  // a pocket in an edge
        const VoxelBrep pocket(voxels, flipped);
        CHECK(edges_at(pocket.brep(), edge_angles(pocket.brep(), SolidId{0}), 270) == 5);
    }
}

TEST_CASE("Slanting faces have the angles of the drawing") {
    TestBrep b;
    const SolidId prism = add_prism(b, {{0, 0}, {1, 0}, {0.5, std::sqrt(0.75)}}, 0, 1);
    const std::vector<EdgeAngle> angles = edge_angles(b, prism);
    CHECK(edges_at(b, angles, 60) == 3);
    CHECK(edges_at(b, angles, 90) == 6);
    const double ten = 10 * std::numbers::pi / 180;
    const SolidId wedge = add_prism(b, {{0, 0}, {3, 0}, {3 * std::cos(ten), 3 * std::sin(ten)}}, 5, 6);
    CHECK(edges_at(b, edge_angles(b, wedge), 10) == 1);
}

TEST_CASE("Round edges: the rims of cylinders, cones and pipes; seams are no edges") {
    TestBrep b;
    const std::vector<EdgeAngle> cylinder = edge_angles(b, add_cylinder(b, 1, 1, 2));
    CHECK(cylinder.size() == 2);
    CHECK(edges_at(b, cylinder, 90) == 2);
    const std::vector<EdgeAngle> cone = edge_angles(b, add_cylinder(b, 2, 1, 1));
    CHECK(cone.size() == 2);
    CHECK(edges_at(b, cone, 45) == 1);
    CHECK(edges_at(b, cone, 135) == 1);
    const std::vector<EdgeAngle> pipe = edge_angles(b, add_cylinder(b, 2, 2, 1, 1));
    CHECK(pipe.size() == 4);
    CHECK(edges_at(b, pipe, 90) == 4);
}

TEST_CASE("Where faces go on into each other an edge is smooth: blends of both kinds, faces in one plane") {
    TestBrep b;
    for (const bool bulges : {true, false}) {
        CAPTURE(bulges);
        const std::vector<EdgeAngle> angles = edge_angles(b, add_round_profile(b, bulges));
        CHECK(angles.size() == (bulges ? 15U : 21U));
        CHECK(smooth(angles) == 2);
        CHECK(edges_at(b, angles, 180) == 2);
        CHECK(concave(angles) == 0);
        CHECK(edges_at(b, angles, 90) == angles.size() - 2);
    }
    CHECK(smooth(edge_angles(b, add_half_stacked_box(b))) == 2);
}

TEST_CASE("The outward normal leaves the solid, whichever way a face is turned") {
    TestBrep b;
    const SolidId pipe = add_cylinder(b, 2, 2, 1, 1);
    const auto faces = b.solid_faces(pipe);
    const Vec3 inside(1.5, 0, 0.5);
    for (const OrientedFace& f : faces) {
        const Vec2 uv = b.closest_on_face(f.face, inside);
        const Vec3 n = outward_normal(b, f, uv);
        CHECK(n.norm() == Approx(1));
        CHECK(n.dot(b.face_point(f.face, uv) - inside) == Approx(0.5));
    }
}
