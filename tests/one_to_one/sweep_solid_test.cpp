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
    // A cap whose inner node the affine maps leave behind: the middle of the sweep is pinched to a thin section.
    test::TestBrep b;
    test::add_prism(b, test::rectangle(1, 1), 0, 1);
    const SweepTopology sweep = sweep_between(b, SolidId{0}, FaceId{0}, FaceId{1});
    const std::vector<int> intervals(b.edge_count(), 4);
    const auto run = [&](bool smooth) {
        BoundaryMesh mesh = mesh_edges(b, intervals);
        ModelMesh ignored;
        detail::mesh_linking_sides(b, mesh, std::span(&sweep, 1), true, ignored);
        mesh_cap_face(b, mesh, FaceId{0}, test::GridCap<test::TestBrep>{&b});
        for (const Index node : mesh.faces[0].nodes) {  // drag the inner nodes of the source out of order
            Vec3& x = mesh.nodes[node];
            if ((x.head<2>() - Vec2(0.5, 0.5)).norm() < 0.1) {
                x += Vec3(0, 0, 0.4);
            }
        }
        SolidSweepOptions options;
        options.smooth = smooth;
        return sweep_solid(b, mesh, sweep, intervals, options);
    };
    const SolidMesh repaired = run(true);
    const SolidMesh plain = run(false);
    CHECK(plain.smooth.moved_nodes == 0);
    CHECK(repaired.smooth.inverted_after == 0);
    CHECK((repaired.smooth.inverted_before == 0) == (repaired.smooth.status == SmoothStatus::unchanged));
}
