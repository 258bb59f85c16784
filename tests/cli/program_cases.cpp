// The program as its users see it: exit codes, files, messages.
#include "support/catch.hpp"
#include "support/program.hpp"

#include <pavior/io/mesh_file.hpp>
#include <pavior/mesh/verify_hexes.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

using namespace pavior;
using namespace pavior::test;
namespace fs = std::filesystem;

namespace {

std::string example(const std::string& name) { return std::string(PAVIOR_EXAMPLE_DATA) + "/" + name; }

std::string test_case(const std::string& name) { return std::string(PAVIOR_TEST_DATA) + "/" + name; }

}  // namespace

TEST_CASE("a STEP part becomes a valid mesh, with report and groups") {
    const std::string mesh = scratch() / "part.vtu";
    const std::string report = scratch() / "part.json";
    const ProgramRun outcome =
        run_program("sweep " + example("mfcad/4-4-19.step") + " --size 2 -o " + mesh + " --report " + report);
    CAPTURE(outcome.err);
    REQUIRE(outcome.code == 0);
    const HexMeshData data = read_mesh(mesh);
    CHECK(verify_hexes(data.mesh).ok());
    CHECK(data.groups.size() == 13);
    const auto json = nlohmann::json::parse(content(report));
    CHECK(json["exit_code"] == 0);
    CHECK(json["mesh"]["hexahedra"] == data.mesh.hexes.size());
    CHECK(json["mesh"]["inverted"] == 0);
    CHECK(json["mesh"]["volume"].get<double>() == Approx(json["solids"][0]["cad_volume"].get<double>()).epsilon(1e-9));
    CHECK(outcome.out.find("hexahedra") != std::string::npos);
    CHECK(outcome.err.empty());
    CHECK(run_program("quality " + mesh).code == 0);
}

TEST_CASE("--quiet is quiet, threads and formats do not change the mesh") {
    const std::string part = "sweep " + example("mfcad/6-8-8-8-19.step") + " --size 1 --quiet -o ";
    const std::string a = scratch() / "a.vtu";
    const ProgramRun outcome = run_program(part + a + " --threads 1");
    REQUIRE(outcome.code == 0);
    CHECK(outcome.out.empty());
    CHECK(outcome.err.empty());
    REQUIRE(run_program(part + (scratch() / "b.vtu").string() + " --threads 2").code == 0);
    CHECK(content(a) == content(scratch() / "b.vtu"));
    const HexMeshData want = read_mesh(a);
    for (const char* name : {"c.msh", "c.inp", "c.vtk"}) {
        REQUIRE(run_program(part + (scratch() / name).string()).code == 0);
        const HexMeshData got = read_mesh(scratch() / name);
        CHECK(got.mesh.hexes == want.mesh.hexes);
        REQUIRE(got.mesh.nodes.size() == want.mesh.nodes.size());
        CHECK(std::memcmp(got.mesh.nodes.data(), want.mesh.nodes.data(), want.mesh.nodes.size() * sizeof(Vec3)) == 0);
    }
}

TEST_CASE("an assembly conforms across its shared faces and keeps the names of its solids") {
    const std::string mesh = scratch() / "assembly.msh";
    const ProgramRun outcome =
        run_program("sweep " + example("assembly/bolt_plate_washer.step") + " --size 2 -o " + mesh);
    CAPTURE(outcome.err);
    REQUIRE(outcome.code == 0);
    const HexMeshData data = read_mesh(mesh);
    const HexReport report = verify_hexes(data.mesh);
    CHECK(report.ok());
    CHECK(report.crossed_edges == 0);
    std::set<std::string> names;
    for (const MeshGroup& group : data.groups) {
        if (group.dimension == 3) {
            names.insert(group.name);
        }
    }
    CHECK(names == std::set<std::string>{"bolt", "plate", "washer"});
    std::set<int> used(data.hex_groups.begin(), data.hex_groups.end());
    CHECK(used.size() == 3);
    // Quads on the interfaces are there once, beside those of the boundary.
    CHECK(data.quads.size() > report.boundary_quads);
}

TEST_CASE("IGES files are meshed as the STEP files of the same parts, loose faces too") {
    const std::string mesh = (scratch() / "iges.vtu").string();
    for (const std::string part : {"4-4-19", "s15o_cylinder"}) {
        const std::string step = part == "4-4-19" ? "mfcad/4-4-19.step" : "hexme/s15o_cylinder.stp";
        REQUIRE(run_program("sweep " + example(step) + " --size 1 -o " + mesh + " --quiet").code == 0);
        const auto want = verify_hexes(read_mesh(mesh).mesh);
        for (const std::string form : {"_faces.igs", "_solid.igs"}) {
            INFO(part << form);
            REQUIRE(run_program("sweep " + example("iges/" + part + form) + " --size 1 -o " + mesh + " --quiet").code ==
                    0);
            const auto got = verify_hexes(read_mesh(mesh).mesh);
            CHECK(got.ok());
            CHECK(got.volume == Approx(want.volume).epsilon(1e-6));
        }
    }
}

TEST_CASE("a size that leaves a cap no quads is made finer, and the user is told") {
    const std::string sweep =
        "sweep " + example("mfcad/0-1-19.step") + " -o " + scratch_file("coarse.vtu") + " --size ";
    const ProgramRun outcome = run_program(sweep + "6");
    CAPTURE(outcome.err);
    REQUIRE(outcome.code == 0);
    CHECK(outcome.err.find("face 2") != std::string::npos);
    CHECK(outcome.err.find("tried again with size 4.2") != std::string::npos);
    CHECK(verify_hexes(read_mesh(scratch_file("coarse.vtu")).mesh).ok());
    const ProgramRun finer = run_program(sweep + "4.2");  // which needs no other try
    CHECK(finer.code == 0);
    CHECK(finer.err.empty());
}

TEST_CASE("--layers, --source and --target are obeyed") {
    const std::string report = scratch() / "layers.json";
    const std::string common = " --size 2 -o " + (scratch() / "layers.vtu").string() + " --report " + report;
    REQUIRE(run_program("sweep " + example("mfcad/4-4-19.step") + common + " --layers 7").code == 0);
    auto json = nlohmann::json::parse(content(report));
    CHECK(json["solids"][0]["layers"] == 7);
    const std::string source = std::to_string(json["solids"][0]["source"].get<int>());
    const std::string target = std::to_string(json["solids"][0]["target"].get<int>());
    REQUIRE(
        run_program("sweep " + example("mfcad/4-4-19.step") + common + " --source " + target + " --target " + source)
            .code == 0);
    json = nlohmann::json::parse(content(report));
    CHECK(json["solids"][0]["source"] == std::stoi(target));
    CHECK(run_program("sweep " + example("mfcad/4-4-19.step") + common + " --source 999").code == 2);
    CHECK(run_program("sweep " + example("mfcad/4-4-19.step") + common + " --source " + source + " --target " + source)
              .code == 2);
}

TEST_CASE("a solid that cannot be swept is refused with the reason, and nothing is written") {
    const std::string mesh = scratch() / "refused.vtu";
    const ProgramRun outcome = run_program("sweep " + example("mfcad/0-1-13-19.step") + " --size 1 -o " + mesh);
    CHECK(outcome.code == 3);
    CHECK(outcome.err.find("face") != std::string::npos);
    CHECK_FALSE(fs::exists(mesh));
}

TEST_CASE("a sweep problem in JSON gives the expected nodes") {
    const std::string input = test_case("sweep/s35_flattening.json");
    const auto json = nlohmann::json::parse(std::ifstream(input));
    const std::string mesh = scratch() / "problem.msh";
    for (const auto& [options, strategy, key] : {std::tuple{"", "direct", "HC_bec"},
                                                 {" --correction none --method f", "direct", "F"},
                                                 {" --strategy front --method h", "front", "H31_bec"},
                                                 {" --strategy front --method g --correction none", "front", "G"}}) {
        CAPTURE(key);
        REQUIRE(run_program("sweep " + input + " -o " + mesh + " --smooth off" + options).code == 0);
        const HexMeshData data = read_mesh(mesh);
        const auto& expected = json["expected"][strategy][key];
        const std::size_t n = json["source_nodes"].size();
        double worst = 0;
        for (std::size_t k = 1; k <= expected.size(); ++k) {
            for (std::size_t j = 0; j < json["inner"].size(); ++j) {
                const Vec3& x = data.mesh.nodes[k * n + json["inner"][j].get<std::size_t>()];
                for (int c = 0; c < 3; ++c) {
                    worst =
                        std::max(worst, std::abs(x[c] - expected[k - 1][j][static_cast<std::size_t>(c)].get<double>()));
                }
            }
        }
        CHECK(worst <= json["tol_abs"].get<double>());
    }
}

TEST_CASE("bad sweep problems are refused by the name of their error") {
    const std::string mesh = scratch() / "bad.vtu";
    std::size_t cases = 0;
    for (const auto& entry : fs::directory_iterator(test_case("sweep-bad"))) {
        const auto json = nlohmann::json::parse(std::ifstream(entry.path()));
        CAPTURE(entry.path().string());
        std::vector<std::string> accepted = json["also_acceptable"];
        accepted.push_back(json["want"]);
        const ProgramRun outcome = run_program("sweep " + entry.path().string() + " -o " + mesh);
        CAPTURE(outcome.err);
        if (json["want"] == "ok") {
            CHECK(outcome.code == 0);
            fs::remove(mesh);
        } else {
            CHECK(outcome.code == 2);
            CHECK(std::any_of(accepted.begin(), accepted.end(), [&](const std::string& name) {
                return outcome.err.find(name + ":") != std::string::npos;
            }));
            CHECK_FALSE(fs::exists(mesh));
        }
        ++cases;
    }
    CHECK(cases >= 11);
}

TEST_CASE("an invalid mesh is reported and only written on demand") {
    // The source quads run clockwise: every hexahedron is inside out.
    const auto file = scratch() / "inside_out.json";
    std::ofstream(file) << R"({"source_nodes": [[0,0,0],[1,0,0],[1,1,0],[0,1,0]], "quads": [[0,3,2,1]],
        "target_nodes": [[0,0,1],[1,0,1],[1,1,1],[0,1,1]], "loops": [[0,3,2,1]],
        "boundary_levels": [[[0,0,0],[0,1,0],[1,1,0],[1,0,0]], [[0,0,1],[0,1,1],[1,1,1],[1,0,1]]]})";
    const std::string mesh = scratch() / "inside_out.vtu";
    const ProgramRun outcome = run_program("sweep " + file.string() + " -o " + mesh);
    CHECK(outcome.code == 1);
    CHECK(outcome.err.find("inverted") != std::string::npos);
    CHECK_FALSE(fs::exists(mesh));
    CHECK(run_program("sweep " + file.string() + " -o " + mesh + " --keep-invalid").code == 1);
    CHECK(fs::exists(mesh));
    CHECK(run_program("quality " + mesh).code == 1);
}

TEST_CASE("bad options and files exit with 2 and say why") {
    const std::string part = example("mfcad/4-4-19.step");
    const std::string mesh = (scratch() / "x.vtu").string();
    std::ofstream(scratch() / "garbage.step") << "this is no STEP file";
    std::ofstream(scratch() / "empty.step");
    for (const std::string& arguments :
         {std::string(),
          std::string("sweep"),
          std::string("no_such_command"),
          "sweep " + part,
          "sweep " + part + " -o " + mesh + " --size 0",
          "sweep " + part + " -o " + mesh + " --size -1",
          "sweep " + part + " -o " + mesh + " --size x",
          "sweep " + part + " -o " + mesh + " --method q",
          "sweep " + part + " -o " + mesh + " --layers 0",
          "sweep " + part + " -o " + mesh + " --local-size edge:1",
          "sweep " + part + " -o " + mesh + " --local-size edge:1=-2",
          "sweep " + part + " -o " + mesh + " --no-such",
          "sweep " + part + " -o " + (scratch() / "x.stl").string(),
          "sweep " + part + " -o " + (scratch() / "none" / "x.vtu").string() + " --size 4",
          "sweep " + (scratch() / "missing.step").string() + " -o " + mesh,
          "sweep " + (scratch() / "garbage.step").string() + " -o " + mesh,
          "sweep " + (scratch() / "empty.step").string() + " -o " + mesh,
          "sweep " + scratch().string() + " -o " + mesh,
          "sweep " + test_case("sweep/h01_translation.json") + " -o " + mesh + " --size 1",
          "quality " + (scratch() / "missing.vtu").string(),
          "quality " + part}) {
        CAPTURE(arguments);
        const ProgramRun outcome = run_program(arguments);
        CHECK(outcome.code == 2);
        CHECK_FALSE(outcome.err.empty());
        CHECK_FALSE(fs::exists(mesh));
    }
    CHECK(run_program("--help").code == 0);
    CHECK(run_program("sweep --help").code == 0);
}
