// What `pavior` says about geometry: overlaps and gaps, deviation from the CAD model, units; nothing lost to its check.
#include "support/catch.hpp"
#include "support/program.hpp"

#include <pavior/core/stopwatch.hpp>
#include <pavior/io/mesh_file.hpp>
#include <pavior/math/box.hpp>
#include <pavior/mesh/verify_hexes.hpp>

#include <cmath>
#include <set>
#include <span>
#include <string>

using namespace pavior;
using namespace pavior::test;

namespace {

std::string fault(const std::string& name) { return std::string(PAVIOR_TEST_DATA) + "/faults/" + name; }

/// Runs a command that is to make a mesh, and adds what came out.
struct Told {
    ProgramRun run;
    nlohmann::json json;
    HexMeshData data;

    explicit Told(const std::string& command) {
        const std::string mesh = scratch_file("told.vtu");
        const std::string report = scratch_file("told.json");
        run = run_program(command + " -o " + mesh + " --report " + report);
        CAPTURE(command, run.err);
        REQUIRE(run.code == 0);
        json = json_of(report);
        data = read_mesh(mesh);
        CHECK(verify_hexes(data.mesh).ok());
    }
    [[nodiscard]] bool warns(const std::string& text) const { return run.err.find(text) != std::string::npos; }
    [[nodiscard]] std::set<int> solids() const { return {data.hex_groups.begin(), data.hex_groups.end()}; }
    [[nodiscard]] double volume_off() const { return json["deviation"]["relative_volume"].get<double>(); }
};

}  // namespace

TEST_CASE("A mesh of spline faces is checked in a fraction of the time that it takes to make") {
    const Stopwatch watch;
    const Told sweep("sweep " + fault("spring_1.step"));
    const double made = watch.total();
    const Stopwatch other;
    const Told mesh("mesh " + fault("spring_1.step"));
    CHECK(other.total() < 5 * made);  // it tries more than one method
    CHECK(mesh.json["deviation"]["distance_in_sizes"].get<double>() < 0.25);
    CHECK(mesh.json["deviation"]["distance"].get<double>() ==
          Approx(sweep.json["deviation"]["distance"].get<double>()));
}

TEST_CASE("The tip of a cone is meshed or refused in reasonable time") {
    for (const char* command : {"mesh ", "block ", "sweep "}) {
        const Stopwatch watch;
        const ProgramRun run = run_program(command + fault("cone_full.step") + " -o " + scratch_file("cone.vtu"));
        CAPTURE(command, run.err);
        CHECK((run.code == 0 || run.code == 3));
        CHECK(watch.total() < 60);
    }
}

TEST_CASE("Overlaps, duplicates, nested solids and gaps are told with their solids") {
    const Told overlap("mesh " + fault("overlap.step"));
    CHECK(overlap.warns("solids 1 and 2 overlap"));
    CHECK(overlap.solids() == std::set{1, 2});
    CHECK(Told("mesh " + fault("duplicate.step")).warns("solids 1 and 2 are the same"));
    const Told gap("sweep " + fault("gap_1e5.step"));
    CHECK(gap.warns("apart"));
    const Told closed("sweep " + fault("gap_1e5.step") + " --imprint-tolerance 1e-4");
    CHECK_FALSE(closed.warns("apart"));
    CHECK(verify_hexes(closed.data.mesh).boundary_quads < verify_hexes(gap.data.mesh).boundary_quads);
}

TEST_CASE("A local size by the tag of the file reaches a solid that others were cut out of") {
    const Told plain("sweep " + fault("nested_cylinder.step"));
    CHECK(plain.warns("lies inside solid"));
    CHECK(plain.solids() == std::set{1, 2});
    const double size = plain.json["deviation"]["size"].get<double>() / 3;
    for (const char* solid : {"1", "2"}) {
        const Told fine("sweep " + fault("nested_cylinder.step") + " --local-size solid:" + solid + "=" +
                        std::to_string(size));
        CHECK(fine.data.mesh.hexes.size() > 2 * plain.data.mesh.hexes.size());
    }
}

TEST_CASE("What a mesh lacks of its solid stands in the report, the summary and a warning") {
    const Told blocks("block " + fault("fillet_all.step"));
    CHECK(blocks.volume_off() < -0.02);
    CHECK(blocks.warns("less volume than the geometry"));
    CHECK(blocks.run.out.find("% off the geometry") != std::string::npos);
    const Told fine("block " + fault("fillet_all.step") + " --size 0.3");
    CHECK(std::abs(fine.volume_off()) < 0.25 * std::abs(blocks.volume_off()));
    CHECK(fine.warns("away from the geometry"));
    const Told sphere("mesh " + fault("sphere.step") + " --size 10");
    CHECK(std::abs(sphere.volume_off()) < 0.1);
    const Told coarse("mesh " + fault("sphere.step") + " --size 10 --max-angle 90");
    CHECK(coarse.volume_off() < -0.1);
    CHECK(coarse.warns("less volume than the geometry"));
    CHECK(run_program("mesh " + fault("sphere.step") + " --max-angle 0.5 -o " + scratch_file("o.vtu")).code == 2);
    const Told surface("block " + std::string(PAVIOR_TEST_DATA) + "/block/c20_cylinder.off --size 2");
    CHECK(surface.json["deviation"]["cad_volume"].get<double>() > 0);
}

TEST_CASE("Blocks that pass over a part of the solid are no mesh of it") {
    const std::string peg = std::string(PAVIOR_EXAMPLE_DATA) + "/solids/peg_neck_fillet_tip_chamfer.step";
    const std::string mesh = scratch_file("peg.vtu");
    const ProgramRun run = run_program("block " + peg + " --size 1 -o " + mesh);
    CAPTURE(run.err);
    if (run.code == 0) {  // it is not passed over any more
        CHECK(verify_hexes(read_mesh(mesh).mesh).volume == Approx(969.72).epsilon(0.02));
    } else {
        CHECK(run.code == 1);
        CHECK(run.err.find("pass over a part") != std::string::npos);
        CHECK_FALSE(std::filesystem::exists(mesh));
    }
}

TEST_CASE("Units: what the file says, what comes out, and another one") {
    const Told plain("sweep " + fault("slot.step"));
    CHECK(plain.json["unit"]["file"] == "mm");
    CHECK(plain.json["unit"]["output"] == "mm");
    const Told metres("sweep " + fault("slot.step") + " --unit m");
    CHECK(metres.json["unit"]["scale"].get<double>() == Approx(1e-3));
    CHECK(metres.run.out.find("in m (the file: mm)") != std::string::npos);
    CHECK(box_round(std::span<const Vec3>(metres.data.mesh.nodes)).diagonal() ==
          Approx(1e-3 * box_round(std::span<const Vec3>(plain.data.mesh.nodes)).diagonal()));
    CHECK(run_program("sweep " + fault("slot.step") + " --unit parsec -o " + scratch_file("o.vtu")).code == 2);
    const ProgramRun none = run_program("block " + fault("slot_1e-6.off") + " --unit m -o " + scratch_file("o.vtu"));
    CHECK(none.code == 2);
    CHECK(none.err.find("no unit") != std::string::npos);
}

TEST_CASE("Reports say what was done: no blocks of an invalid dual, how sheets ran, what corrected the target") {
    const Told blocks("block " + fault("slot.step"));
    CHECK(blocks.json["marking"]["propagation"].is_string());
    const Told idw("sweep " + fault("spring_1.step"));
    CHECK(idw.json["solids"][0]["target_projection"]["corrected"] == true);
    const Told none("sweep " + fault("spring_1.step") + " --correction none");
    CHECK(none.json["solids"][0]["target_projection"]["corrected"] == false);
}

TEST_CASE("Thin slots and slivers give valid blocks or the reason, other files a word about what is wrong") {
    const Told slot("block " + fault("slot_1e-6.off"));
    CHECK(slot.data.mesh.hexes.size() > 4);
    const ProgramRun sliver =
        run_program("block " + fault("coplanar_sliver_1e12.off") + " -o " + scratch_file("o.vtu"));
    CHECK(sliver.code == 2);
    CHECK(sliver.err.find("triangle ") != std::string::npos);
    CHECK(sliver.err.find("gave up") == std::string::npos);
    const Told text("block " + fault("stl_Solid_mixed_case.stl"));
    CHECK(text.data.mesh.hexes.size() >= 1);
    const ProgramRun nan = run_program("block " + fault("vtk_tets_nan.vtk") + " -o " + scratch_file("o.vtu"));
    CHECK(nan.code == 2);
    CHECK(nan.err.find("not finite") != std::string::npos);
    CHECK(nan.err.find(".cxx") == std::string::npos);
}

TEST_CASE("A sweep problem of a full turn closes to a ring, one of two components is two meshes") {
    const Told ring("sweep " + fault("ring_full_360.json"));
    CHECK(ring.json["closed_to_a_ring"] == true);
    CHECK(ring.data.mesh.nodes.size() == 256);
    const Told two("sweep " + fault("two_components.json"));
    CHECK(two.json["closed_to_a_ring"] == false);
    CHECK(two.data.mesh.hexes.size() == 54);
}
