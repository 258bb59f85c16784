// One-to-one sweeps between caps that contain the pole or the seam of their surface.
#include "support/catch.hpp"
#include "support/domes.hpp"
#include "support/scratch.hpp"

#include <pavior/brep/face_distance.hpp>
#include <pavior/cad/cap_mesh.hpp>
#include <pavior/cad/gmsh_brep.hpp>
#include <pavior/glpk/solve_program.hpp>
#include <pavior/mesh/quality.hpp>
#include <pavior/mesh/verify_hexes.hpp>
#include <pavior/one_to_one/intervals.hpp>
#include <pavior/one_to_one/recognition.hpp>
#include <pavior/one_to_one/sweep_model.hpp>

#include <set>
#include <string>
#include <vector>

using namespace pavior;
using namespace pavior::test;

namespace {

ModelMesh swept(const GmshBrep& model, const SweepTopology& sweep, double size) {
    const std::vector sweeps{sweep};
    IntervalOptions options;
    options.size = size;
    const IntervalAssignment numbers = assign_intervals(model, sweeps, options, GlpkSolver{});
    return sweep_model(model, sweeps, numbers.intervals, GmshCapMesher{&model});
}

}  // namespace

TEST_CASE("Domes round the pole of their surface are caps") {
    for (const Dome dome : all_domes) {
        CAPTURE(static_cast<int>(dome));
        const GmshBrep model = GmshBrep::build([&] { make_dome(dome); });
        const SweepTopology best = best_sweep(model, SolidId{0});
        for (const bool backwards : {false, true}) {
            CAPTURE(backwards);
            const ModelMesh mesh = swept(model, backwards ? reversed(best) : best, 0.35);
            const HexReport report = verify_hexes(mesh.mesh);
            INFO(report.text());
            CHECK(report.ok());
            CHECK(report.volume == Approx(model.solid_volume(SolidId{0})).epsilon(0.04));
            CHECK(hex_quality(mesh.mesh).scaled_jacobian.min > 0.2);
            CHECK(face_distance(model, mesh.mesh.nodes, mesh.quads, mesh.quad_face).distance < 1e-6);
            CHECK(std::set<FaceId>(mesh.quad_face.begin(), mesh.quad_face.end()).size() == model.face_count());
            CHECK(mesh.solids.at(0).target_projection->folded.empty());
        }
    }
}

TEST_CASE("The same dome twice is the same mesh") {
    const GmshBrep model = GmshBrep::build([&] { make_dome(Dome::lens); });
    const ModelMesh a = swept(model, best_sweep(model, SolidId{0}), 0.4);
    const ModelMesh b = swept(model, best_sweep(model, SolidId{0}), 0.4);
    CHECK(a.mesh.nodes == b.mesh.nodes);
    CHECK(a.mesh.hexes == b.mesh.hexes);
}

TEST_CASE("A named dome is a cap, a tube is none") {
    const GmshBrep model = GmshBrep::build([] { make_dome(Dome::sphere); });
    FaceId dome, wall, floor;
    for (std::size_t f = 0; f < model.face_count(); ++f) {
        const FaceId id{static_cast<std::int32_t>(f)};
        (model.face_kind(id) == "Sphere" ? dome : model.face_kind(id) == "Plane" ? floor : wall) = id;
    }
    const SweepTopology sweep = sweep_between(model, SolidId{0}, dome, floor);
    CHECK(sweep.source == dome);
    CHECK(sweep.source_loops.at(0).size() == 1);
    CHECK(sweep.loops.at(0).at(0).closed());
    CHECK_THROWS_AS(sweep_between(model, SolidId{0}, wall, floor), UnmeshableError);

    // hexagonal ring: its inner and outer wall are tubes, and all its faces have seams
    const GmshBrep ring = GmshBrep::build([] {
        const int big = occ::addCylinder(0, 0, 0, 0, 0, 1, 2);
        const int cone = occ::addCone(0, 0, 1, 0, 0, 0.5, 2, 1.5);
        gmsh::vectorpair fused;
        std::vector<gmsh::vectorpair> map;
        occ::fuse({{3, big}}, {{3, cone}}, fused, map);
        cut(fused.at(0).second, {{3, occ::addCylinder(0, 0, -1, 0, 0, 4, 1)}});
    });
    for (const SweepTopology& candidate : recognise_sweeps(ring, SolidId{0}).candidates) {
        CHECK(ring.face_kind(candidate.source) != "Cylinder");
        CHECK(ring.face_kind(candidate.target) != "Cylinder");
    }
}

TEST_CASE("A dome comes back from a STEP file as a cap") {
    for (const Dome dome : {Dome::sphere, Dome::ring, Dome::revolved}) {
        CAPTURE(static_cast<int>(dome));
        const std::string file = scratch_file("dome.step");
        gmsh::initialize();
        gmsh::option::setNumber("General.Terminal", 0);
        make_dome(dome);
        occ::synchronize();
        gmsh::write(file);
        gmsh::finalize();
        const GmshBrep model = GmshBrep::load(file);
        const ModelMesh mesh = swept(model, best_sweep(model, SolidId{0}), 0.35 * model.diagonal() / 6);
        CHECK(verify_hexes(mesh.mesh).ok());
        CHECK(hex_quality(mesh.mesh).scaled_jacobian.min > 0.2);
        CHECK(face_distance(model, mesh.mesh.nodes, mesh.quads, mesh.quad_face).distance < 1e-6 * model.diagonal());
    }
}
