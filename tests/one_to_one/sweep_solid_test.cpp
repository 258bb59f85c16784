#include "support/catch.hpp"
#include "support/grid_cap.hpp"
#include "support/test_brep.hpp"

#include <pavior/mesh/verify_hexes.hpp>
#include <pavior/one_to_one/recognition.hpp>
#include <pavior/one_to_one/sweep_model.hpp>

using namespace pavior;

namespace {

/// Two boxes, one on the other, that share a face: caps 0, 1 (shared), 2.
struct Tower : test::TestBrep {
    Tower() {
        const auto r0 = test::lift(*this, test::rectangle(2, 1), 0);
        const auto r1 = test::lift(*this, test::rectangle(2, 1), 1);
        const auto r2 = test::lift(*this, test::rectangle(2, 1), 3);
        const FaceId low = flat_polygon(r0);
        const FaceId middle = flat_polygon(r1);
        const FaceId high = flat_polygon(r2);
        std::vector<OrientedFace> lower{{low, false}, {middle, true}};
        test::add_sides(*this, r0, r1, lower);
        std::vector<OrientedFace> upper{{middle, false}, {high, true}};
        test::add_sides(*this, r1, r2, upper);
        solid(lower);
        solid(upper);
    }
    [[nodiscard]] std::vector<SweepTopology> sweeps() const {
        return {sweep_between(*this, SolidId{0}, FaceId{0}, FaceId{1}),
                sweep_between(*this, SolidId{1}, FaceId{2}, FaceId{1})};
    }
};

}  // namespace

TEST_CASE("solids that share a cap share its mesh") {
    const Tower b;
    const auto sweeps = b.sweeps();
    const ModelMesh result = sweep_model(b, sweeps, std::vector<int>(b.edge_count(), 4), test::GridCap<Tower>{&b});
    const HexReport report = verify_hexes(result.mesh);
    INFO(report.text());
    CHECK(report.ok());
    CHECK(report.volume == Approx(6.0).epsilon(1e-13));
    CHECK(result.mesh.hexes.size() == 128);
    CHECK(result.mesh.nodes.size() == 25 * 9);
    CHECK(result.quads.size() == 16 * 11);
    CHECK(result.solids[0].target_projection.has_value());
    CHECK(result.solids[1].source == FaceId{1});
    CHECK(result.hex_solid.front() == SolidId{0});
    CHECK(result.hex_solid.back() == SolidId{1});
}

TEST_CASE("a target that carries another mesh is refused by name") {
    const Tower b;
    const auto sweeps = b.sweeps();
    const std::vector<int> intervals(b.edge_count(), 4);
    BoundaryMesh mesh = mesh_edges(b, intervals);
    ModelMesh ignored;
    detail::mesh_linking_sides(b, mesh, sweeps, true, ignored);
    mesh_cap_face(b, mesh, FaceId{0}, test::GridCap<Tower>{&b});
    mesh_cap_face(b, mesh, FaceId{1}, test::GridCap<Tower>{&b});
    BoundaryMesh fitting = mesh;
    CHECK(sweep_solid(b, fitting, sweeps[0], intervals, {}).layers == 4);  // the same mesh, found again
    mesh.faces[1].quads.pop_back();
    try {
        (void)sweep_solid(b, mesh, sweeps[0], intervals, {});
        FAIL("accepted");
    } catch (const UnmeshableError& error) {
        CHECK(error.ids() == Error::Ids{1, 2});
    }
}

TEST_CASE("hexahedra that would be inverted are repaired, or left alone on request") {
    // The front side bulges into the middle level, past the nodes that the maps leave where they are in a box.
    test::TestBrep b;
    test::add_prism(b, test::rectangle(1, 1), 0, 1);
    const SweepTopology sweep = sweep_between(b, SolidId{0}, FaceId{0}, FaceId{1});
    const std::vector<int> intervals(b.edge_count(), 4);
    BoundaryMesh given = mesh_edges(b, intervals);
    ModelMesh ignored;
    detail::mesh_linking_sides(b, given, std::span(&sweep, 1), true, ignored);
    mesh_cap_face(b, given, FaceId{0}, test::GridCap<test::TestBrep>{&b});
    const LevelIds levels = level_ids(b, given, sweep, intervals);
    for (const Index node : levels.level(2)) {
        const Vec3 x = given.nodes[node];
        if (x[1] == 0.0 && x[0] > 0.1 && x[0] < 0.9) {
            given.nodes[node][1] = 0.5;
        }
    }
    std::size_t bad = 0;
    for (const bool smooth : {false, true}) {
        CAPTURE(smooth);
        BoundaryMesh mesh = given;
        SolidSweepOptions options;
        options.smooth = smooth;
        options.sweep.correction = BoundaryCorrection::none;
        const SolidMesh solid = sweep_solid(b, mesh, sweep, intervals, options);
        std::vector<Vec3> nodes;
        for (const Index node : solid.nodes) {
            nodes.push_back(mesh.nodes[node]);
        }
        const HexReport report = verify_hexes(SweepMesh(nodes, solid.quads, solid.layers));
        if (smooth) {
            CHECK(solid.smooth.status == SmoothStatus::repaired);
            CHECK(solid.smooth.moved_nodes > 0);
            CHECK(solid.smooth.inverted_before == bad);
            CHECK(report.ok());
        } else {
            CHECK(solid.smooth.status == SmoothStatus::unchanged);
            CHECK(solid.smooth.moved_nodes == 0);
            bad = report.count(MeshFault::inverted);
            CHECK(bad > 0);
        }
        for (std::size_t i = 0; i < given.nodes.size(); ++i) {
            CHECK(mesh.nodes[i] == given.nodes[i]);
        }
    }
}
