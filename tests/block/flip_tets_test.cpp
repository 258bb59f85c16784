#include "support/catch.hpp"
#include "support/tet_meshes.hpp"

#include <pavior/block/flip_tets.hpp>
#include <pavior/block/split_tets.hpp>
#include <pavior/core/stop.hpp>
#include <pavior/mesh/quality.hpp>
#include <pavior/mesh/verify_tets.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <set>
#include <stop_token>

using namespace pavior;

namespace {

/// The mesh with its whole boundary tagged.
TaggedTetMesh closed(TetMesh mesh) {
    TaggedTetMesh result;
    const TetTopology topology = tet_topology(mesh);
    for (const Index f : IndexRange(topology.faces.size())) {
        if (topology.boundary(f)) {
            const Index t = topology.face_tets[f][0];
            const auto local = static_cast<std::size_t>(detail::local_face(topology, t, f));
            result.triangles.push_back({detail::tet_face(mesh.tets[t], local), 1});
        }
    }
    result.mesh = std::move(mesh);
    return result;
}

/// So many tetrahedra round the edge from node 0 to 1.
TaggedTetMesh round_edge(Index n, double length, double stretch = 1) {
    TetMesh mesh;
    mesh.nodes = {Vec3(0, 0, -length / 2), Vec3(0, 0, length / 2)};
    for (Index i = 0; i < n; ++i) {
        const double angle = 2 * std::numbers::pi * i / n;
        mesh.nodes.emplace_back(std::cos(angle), stretch * std::sin(angle), 0.05 * (i % 2));
        mesh.tets.push_back({0, 1, 2 + i, 2 + (i + 1) % n});
    }
    return closed(std::move(mesh));
}

double split_minimum(const TetMesh& mesh) { return hex_quality(split_tets(mesh).mesh).scaled_jacobian.min; }

void check_same_solid(const TaggedTetMesh& before, const FlippedTets& after) {
    const TetMesh mesh{before.mesh.nodes, after.tets};
    const TetReport report = verify_tets(mesh, {16, true});
    INFO(report.text());
    CHECK(report.ok());
    CHECK(report.volume == Approx(verify_tets(before.mesh, {16, true}).volume).epsilon(1e-12));
    CHECK(report.boundary_faces == verify_tets(before.mesh, {16, true}).boundary_faces);
    CHECK(after.after == Approx(split_minimum(mesh)));
    CHECK(after.after >= after.before);
    REQUIRE(after.origin.size() == after.tets.size());
    const TetTopology topology = tet_topology(mesh);
    for (const TaggedTriangle& triangle : before.triangles) {
        CHECK(topology.face(triangle.nodes) != no_index);
    }
}

}  // namespace

TEST_CASE("A long edge with few tetrahedra round it is removed, the boundary is kept") {
    for (const Index n : {3U, 4U, 5U}) {
        CAPTURE(n);
        const TaggedTetMesh edge = round_edge(n, 2.8);
        const FlippedTets removed = flip_tets(edge);
        check_same_solid(edge, removed);
        CHECK(removed.flips == 1);
        CHECK(removed.tets.size() == 2 * (n - 2));
        CHECK(removed.after > removed.before + 0.03);
    }
    const TaggedTetMesh round = round_edge(8, 1);  // good as it is
    CHECK(flip_tets(round).tets == round.mesh.tets);
    const TaggedTetMesh flat = round_edge(4, 2.8, 0.25);  // the shorter diagonal of the ring
    const FlippedTets across = flip_tets(flat);
    check_same_solid(flat, across);
    for (const TetCorners& c : across.tets) {
        const auto has = [&](Index i) { return std::find(c.begin(), c.end(), i) != c.end(); };
        CHECK((has(3) && has(5)));
    }
}

TEST_CASE("Two flat tetrahedra on a face become three round an edge; those that meet on a smooth face are parted") {
    TetMesh mesh;
    mesh.nodes = {Vec3(1, 0, 0), Vec3(-0.5, 0.9, 0), Vec3(-0.5, -0.9, 0), Vec3(0, 0, 0.45), Vec3(0, 0, -0.45)};
    mesh.tets = {{0, 1, 2, 3}, {0, 2, 1, 4}};
    FlipOptions all;
    all.sufficient = 1;
    const TaggedTetMesh flat = closed(mesh);
    const FlippedTets three = flip_tets(flat, all);
    check_same_solid(flat, three);
    CHECK(three.flips == 1);
    CHECK(three.tets.size() == 3);
    CHECK(three.after > three.before);
    TaggedTetMesh wall = flat;
    wall.triangles.push_back({{0, 1, 2}, 5});
    CHECK(flip_tets(wall, all).flips == 0);
    const TaggedTetMesh thin = round_edge(3, 2.8, 0.25);  // two sides of one tetrahedron at 157 degrees
    const FlippedTets parted = flip_tets(thin, all);
    CHECK(parted.before < 1e-3);
    CHECK(parted.after > 0.2);
}

TEST_CASE("Shaken tetrahedra: the minimum does not fall, walls inside stay, the same bytes again") {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> shake(-0.22, 0.22);
    std::size_t flips = 0;
    for (int trial = 0; trial < 4; ++trial) {
        tet_meshes::VoxelTets voxels = tet_meshes::tetrahedra(tet_meshes::box(4, 3, 3));
        TaggedTetMesh mesh = closed(voxels.mesh);
        std::set<Index> boundary;
        for (const TaggedTriangle& t : mesh.triangles) {
            boundary.insert(t.nodes.begin(), t.nodes.end());
        }
        for (Index i = 0; i < mesh.mesh.nodes.size(); ++i) {
            if (!boundary.contains(i) && voxels.lattice[i][0] != 2) {
                mesh.mesh.nodes[i] += Vec3(shake(random), shake(random), shake(random));
            }
        }
        if (!verify_tets(mesh.mesh).ok()) {
            continue;
        }
        const TetTopology topology = tet_topology(mesh.mesh);
        for (const TriCorners& c : topology.faces) {  // a wall at x = 2
            if (std::all_of(c.begin(), c.end(), [&](Index i) { return voxels.lattice[i][0] == 2; })) {
                mesh.triangles.push_back({c, 2});
            }
        }
        const FlippedTets flipped = flip_tets(mesh);
        check_same_solid(mesh, flipped);
        flips += flipped.flips;
        for (std::size_t t = 0; t < flipped.tets.size(); ++t) {  // each on the side of the wall that it comes from
            const auto side = [&](const TetCorners& c) {
                double x = 0;
                for (const Index i : c) {
                    x += mesh.mesh.nodes[i].x() / 4;
                }
                return x > 2;
            };
            REQUIRE(side(flipped.tets[t]) == side(mesh.mesh.tets[flipped.origin[t]]));
        }
        CHECK(flip_tets(mesh).tets == flipped.tets);
    }
    CHECK(flips > 0);
}

TEST_CASE("What is good enough is left alone; options, ids and stops are heeded") {
    const TaggedTetMesh mesh = closed(tet_meshes::tetrahedra(tet_meshes::box(2, 2, 1)).mesh);
    FlipOptions low;
    low.sufficient = 0.01;
    const FlippedTets same = flip_tets(mesh, low);
    CHECK(same.tets == mesh.mesh.tets);
    CHECK(same.flips == 0);
    CHECK(same.before == Approx(split_minimum(mesh.mesh)));
    CHECK(flip_tets(TaggedTetMesh{}).tets.empty());
    FlipOptions bad;
    bad.sufficient = 0;
    CHECK_THROWS_AS(flip_tets(mesh, bad), InputError);
    TaggedTetMesh wrong = mesh;
    wrong.mesh.tets[1][2] = 999;
    CHECK_THROWS_AS(flip_tets(wrong), InputError);
    wrong = mesh;
    wrong.triangles[0].nodes[0] = 999;
    CHECK_THROWS_AS(flip_tets(wrong), InputError);
    std::stop_source source;
    source.request_stop();
    FlipOptions stopped;
    stopped.sufficient = 1;
    stopped.stop = source.get_token();
    CHECK_THROWS_AS(flip_tets(mesh, stopped), Stopped);
}
