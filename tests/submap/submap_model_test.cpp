#include <pavior/glpk/solve_program.hpp>
#include <pavior/submap/submap_model.hpp>

#include "support/catch.hpp"
#include "support/voxel_brep.hpp"

#include <pavior/mesh/quality.hpp>
#include <pavior/mesh/verify_hexes.hpp>
#include <pavior/mesh/verify_quads.hpp>

#include <cstring>
#include <map>

using namespace pavior;
using namespace pavior::test;

namespace {

IntervalOptions with_size(double size) {
    IntervalOptions options;
    options.size = size;
    return options;
}

/// Sound, of the right volume, structured: eight hexahedra round every inner node, four round every inner edge.
void check(const SubmappedMesh& mesh, double volume) {
    const HexReport report = verify_hexes(mesh.mesh);
    INFO(report.text());
    CHECK(report.ok());
    CHECK(report.volume == Approx(volume).epsilon(1e-9));
    std::vector<int> hexes(mesh.mesh.nodes.size(), 0);
    std::vector<bool> boundary(mesh.mesh.nodes.size(), false);
    std::map<std::pair<Index, Index>, int> edges;
    for (const HexCorners& hex : mesh.mesh.hexes) {
        for (const Index n : hex) {
            ++hexes[n];
        }
        constexpr std::array<std::array<std::size_t, 2>, 12> ends{
            {{0, 1}, {1, 2}, {3, 2}, {0, 3}, {4, 5}, {5, 6}, {7, 6}, {4, 7}, {0, 4}, {1, 5}, {2, 6}, {3, 7}}};
        for (const auto& [a, c] : ends) {
            ++edges[std::minmax(hex[a], hex[c])];
        }
    }
    for (const QuadCorners& q : mesh.quads) {
        for (const Index n : q) {
            boundary[n] = true;
        }
    }
    std::vector<int> neighbours(hexes.size(), 0);
    for (const auto& [ends, count] : edges) {
        const bool inner = !boundary[ends.first] || !boundary[ends.second];
        CHECK((!inner || count == 4));
        ++neighbours[ends.first];
        ++neighbours[ends.second];
    }
    for (std::size_t n = 0; n < hexes.size(); ++n) {
        CHECK((boundary[n] || (hexes[n] == 8 && neighbours[n] == 6)));
    }
}

double volume(const Voxels& voxels) {
    double sum = 0.0;
    for (int label = 1; label < 10; ++label) {
        sum += voxels.volume(label);
    }
    return sum;
}

}  // namespace

TEST_CASE("a box becomes a grid, i along x, j along y, k along z") {
    TestBrep b;
    const std::vector<SolidId> solids{add_prism(b, rectangle(2, 3), 0, 4)};
    const SubmappedMesh mesh = submap_model(b, solids, with_size(1), GlpkSolver{});
    check(mesh, 24.0);
    CHECK(mesh.mesh.hexes.size() == 24);
    CHECK(mesh.mesh.nodes.size() == 60);
    for (std::size_t n = 0; n < 60; ++n) {
        const Vec3 wanted(static_cast<double>(n % 3), static_cast<double>(n / 3 % 4), static_cast<double>(n / 12));
        CHECK((mesh.mesh.nodes[n] - wanted).norm() < 1e-12);
    }
    CHECK(mesh.min_scaled_jacobian() == Approx(1.0));
    CHECK(mesh.quads.size() == 2 * (6 + 8 + 12));
}

TEST_CASE("a boss, a pocket, a tunnel and a step in one solid") {
    Voxels voxels(7, 6, 5);
    voxels.fill({0, 0, 0}, {7, 6, 4}, 1);
    voxels.fill({1, 1, 4}, {3, 3, 5}, 1);  // boss
    voxels.fill({4, 3, 2}, {5, 5, 4}, 0);  // pocket from above
    voxels.fill({1, 4, 0}, {2, 5, 4}, 0);  // tunnel
    voxels.fill({6, 0, 2}, {7, 6, 4}, 0);  // step
    const VoxelBrep model(voxels, true);
    REQUIRE(model.sound());
    for (const double size : {2.0, 1.0, 0.5}) {
        const SubmappedMesh mesh = submap_model(model.brep(), model.solids(), with_size(size), GlpkSolver{});
        check(mesh, volume(voxels));
        CHECK(mesh.min_scaled_jacobian() > (size > 1.0 ? 0.5 : 0.99));
        CHECK(mesh.solids[0].deviation < 1e-6);
    }
    const SubmappedMesh mesh = submap_model(model.brep(), model.solids(), with_size(1.0), GlpkSolver{});
    CHECK(mesh.mesh.hexes.size() == static_cast<std::size_t>(std::lround(volume(voxels))));
}

TEST_CASE("solids that share faces conform, and share them once") {
    Voxels voxels(4, 4, 4);
    voxels.fill({0, 0, 0}, {4, 4, 2}, 1);
    voxels.fill({0, 0, 2}, {2, 4, 4}, 2);
    voxels.fill({2, 1, 2}, {4, 3, 4}, 3);
    voxels.fill({1, 1, 1}, {3, 2, 2}, 2);
    const VoxelBrep model(voxels, true);
    REQUIRE(model.sound());
    const SubmappedMesh mesh = submap_model(model.brep(), model.solids(), with_size(0.8), GlpkSolver{});
    const HexReport report = verify_hexes(mesh.mesh);
    INFO(report.text());
    CHECK(report.ok());
    CHECK(report.volume == Approx(volume(voxels)).epsilon(1e-12));
    CHECK(mesh.solids.size() == 3);
    std::map<SolidId, double> parts;
    for (std::size_t h = 0; h < mesh.mesh.hexes.size(); ++h) {
        HexPoints x;
        for (std::size_t c = 0; c < 8; ++c) {
            x[c] = mesh.mesh.nodes[mesh.mesh.hexes[h][c]];
        }
        parts[mesh.hex_solid[h]] += hex_volume(x);
    }
    for (const auto& [solid, v] : parts) {
        CHECK(v == Approx(voxels.volume(solid.value + 1)).epsilon(1e-12));
    }
    std::set<QuadCorners> seen;
    for (QuadCorners q : mesh.quads) {
        std::sort(q.begin(), q.end());
        CHECK(seen.insert(q).second);
    }
}

TEST_CASE("random unions of boxes") {
    std::mt19937 random(11);
    const int rounds = 120;
    int meshed = 0, pieces = 0;
    for (int round = 0; round < rounds; ++round) {
        const Voxels voxels = random_voxels(random, 5, 6, 1 + round % 3);
        const VoxelBrep model(voxels, round % 2 == 0);
        if (!model.sound()) {
            continue;
        }
        CAPTURE(round);
        SubmappedMesh mesh;
        try {
            mesh = submap_model(model.brep(), model.solids(), with_size(round % 4 == 0 ? 0.7 : 1.5), GlpkSolver{});
        } catch (const UnmeshableError& e) {
            INFO(e.what());
            CHECK(std::string(e.what()).find("in several pieces") != std::string::npos);
            ++pieces;
            continue;
        }
        const HexReport report = verify_hexes(mesh.mesh);
        INFO(report.text());
        CHECK(report.ok());
        CHECK(report.volume == Approx(volume(voxels)).epsilon(1e-9));
        CHECK(mesh.min_scaled_jacobian() > 0.2);
        ++meshed;
    }
    CHECK(meshed >= 25);
    CHECK(pieces < 60);
}

TEST_CASE("bent and twisted unions of boxes keep their structure") {
    Voxels voxels(6, 3, 3);
    voxels.fill({0, 0, 0}, {6, 3, 2}, 1);
    voxels.fill({2, 0, 2}, {4, 2, 3}, 1);
    const VoxelBrep model(voxels, false, [](const Vec3& x) {  // sheared, planar faces stay planar
        return Vec3(x[0] + 0.3 * x[1], x[1] + 0.2 * x[2], x[2] - 0.1 * x[0]);
    });
    REQUIRE(model.sound());
    const double det = (Eigen::Matrix3d() << 1, 0.3, 0, 0, 1, 0.2, -0.1, 0, 1).finished().determinant();
    const SubmappedMesh mesh = submap_model(model.brep(), model.solids(), with_size(0.5), GlpkSolver{});
    check(mesh, volume(voxels) * det);
    CHECK(mesh.min_scaled_jacobian() > 0.85);
    CHECK(mesh.solids[0].deviation > 5.0);
}

TEST_CASE("refusals name faces") {
    TestBrep b;
    const std::vector<SolidId> pyramid{add_pyramid(b)};
    CHECK_THROWS_AS(submap_model(b, pyramid, with_size(1), GlpkSolver{}), UnmeshableError);
    TestBrep round;
    const std::vector<SolidId> cylinder{add_cylinder(round, 1, 1, 2)};
    try {
        (void)submap_model(round, cylinder, with_size(1), GlpkSolver{});
        FAIL("a cylinder is no union of boxes");
    } catch (const UnmeshableError& e) {
        CHECK(e.code() == ErrorCode::not_submappable);
        REQUIRE(!e.ids().empty());
        CHECK(std::string(e.what()).find("face " + std::to_string(e.ids()[0])) != std::string::npos);
    }
    CHECK_THROWS_AS(submap_model(b, std::vector<SolidId>{}, IntervalOptions{}, GlpkSolver{}), InputError);
}

TEST_CASE("the mesh does not depend on threads, and repeats itself") {
    Voxels voxels(4, 4, 3);
    voxels.fill({0, 0, 0}, {4, 4, 2}, 1);
    voxels.fill({1, 1, 2}, {3, 3, 3}, 1);
    const VoxelBrep model(voxels, false, [](const Vec3& x) { return Vec3(x[0] + 0.4 * x[2], x[1], x[2]); });
    ModelSubmapOptions two;
    two.solid.execution = Execution{2};
    const SubmappedMesh a = submap_model(model.brep(), model.solids(), with_size(0.4), GlpkSolver{});
    const SubmappedMesh c = submap_model(model.brep(), model.solids(), with_size(0.4), GlpkSolver{}, {}, two);
    REQUIRE(a.mesh.nodes.size() == c.mesh.nodes.size());
    CHECK(a.mesh.hexes == c.mesh.hexes);
    CHECK(std::memcmp(a.mesh.nodes.data(), c.mesh.nodes.data(), sizeof(Vec3) * a.mesh.nodes.size()) == 0);
}
