#include "support/catch.hpp"
#include "support/grid_cap.hpp"
#include "support/test_brep.hpp"

#include <pavior/mesh/verify_hexes.hpp>
#include <pavior/one_to_one/recognition.hpp>
#include <pavior/one_to_one/sweep_model.hpp>

#include <cstring>

using namespace pavior;

namespace {

/// Sweeps the solids of b between their faces 0 and 1, `n` intervals an edge.
ModelMesh swept(const test::TestBrep& b, int n, const ModelSweepOptions& options = {}) {
    std::vector<SweepTopology> sweeps;
    for (std::size_t s = 0; s < b.solid_count(); ++s) {
        const SolidId solid{static_cast<std::int32_t>(s)};
        sweeps.push_back(sweep_between(b, solid, b.solid_faces(solid)[0].face, b.solid_faces(solid)[1].face));
    }
    return sweep_model(b, sweeps, std::vector<int>(b.edge_count(), n), test::GridCap<test::TestBrep>{&b}, options);
}

double volume(const ModelMesh& mesh) {
    const HexReport report = verify_hexes(mesh.mesh);
    INFO(report.text());
    CHECK(report.ok());
    return report.volume;
}

}  // namespace

TEST_CASE("a box becomes hexahedra, nodes level by level in the order of the source") {
    test::TestBrep b;
    test::add_prism(b, test::rectangle(2, 1), 0, 3);
    const ModelMesh result = swept(b, 4);
    CHECK(result.mesh.hexes.size() == 64);
    CHECK(result.mesh.nodes.size() == 125);
    CHECK(volume(result) == Approx(6.0).epsilon(1e-13));
    for (std::size_t i = 0; i < 125; ++i) {
        CHECK(result.mesh.nodes[i][2] == Approx(0.75 * static_cast<double>(i / 25)).margin(1e-14));
        CHECK((result.mesh.nodes[i] - result.mesh.nodes[i % 25]).head<2>().norm() < 1e-13);
    }
    CHECK(result.quads.size() == 6 * 16);
    CHECK(result.solids.at(0).layers == 4);
}

TEST_CASE("side faces above each other are swept through") {
    test::TestBrep b;
    test::add_prism(b, test::rectangle(1, 1), 0, 2, {}, 2);
    const ModelMesh result = swept(b, 2);
    CHECK(result.solids[0].layers == 4);
    CHECK(result.mesh.hexes.size() == 16);
    CHECK(volume(result) == Approx(2.0).epsilon(1e-13));
}

TEST_CASE("a cone with a seam is swept from circle to circle") {
    test::TestBrep b;
    test::add_cylinder(b, 1, 0.6, 2);
    const ModelMesh result = swept(b, 16);
    const double polygon = 8 * std::sin(std::numbers::pi / 8);  // area of the 16-gon in the unit circle
    CHECK(volume(result) == Approx(polygon * 2 * (1 + 0.6 + 0.36) / 3).epsilon(1e-9));
}

TEST_CASE("a loop of the target that is no image of the source is met exactly") {
    test::TestBrep b;  // a frustum between a square and a trapezium
    const auto low = test::lift(b, test::rectangle(2, 2), 0);
    const auto high = test::lift(b, {{0, 0}, {2, 0}, {1.2, 1.5}, {0.5, 2}}, 2);
    std::vector<OrientedFace> faces{{b.flat_polygon(low), false}, {b.flat_polygon(high), true}};
    for (std::size_t i = 0; i < 4; ++i) {
        const OrientedEdge bottom = b.joint(low[i], low[(i + 1) % 4]);
        const OrientedEdge top = b.joint(high[i], high[(i + 1) % 4]);
        const OrientedEdge right = b.joint(low[(i + 1) % 4], high[(i + 1) % 4]);
        const OrientedEdge left = b.joint(low[i], high[i]);
        const EdgeLoop loop{bottom, right, {top.edge, !top.forward}, {left.edge, !left.forward}};
        faces.push_back({b.wall(bottom.edge, top.edge, {loop}), bottom.forward});
    }
    b.solid(faces);
    const ModelMesh result = swept(b, 6);
    CHECK(volume(result) > 0);
    CHECK(result.solids[0].target_projection->folded.empty());
    CHECK(result.mesh.hexes.size() == 216);
}

TEST_CASE("threads do not change a bit") {
    test::TestBrep b;
    test::add_cylinder(b, 1, 0.6, 2);
    ModelSweepOptions two;
    two.solid.sweep.execution = Execution{2};
    const ModelMesh a = swept(b, 16);
    const ModelMesh c = swept(b, 16, two);
    CHECK(a.mesh.hexes == c.mesh.hexes);
    CHECK(std::memcmp(a.mesh.nodes.data(), c.mesh.nodes.data(), sizeof(Vec3) * a.mesh.nodes.size()) == 0);
}
