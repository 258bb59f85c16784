// `pavior block` as its users see it: exit codes, files, messages.
#include "support/catch.hpp"
#include "support/program.hpp"

#include <pavior/io/mesh_file.hpp>
#include <pavior/mesh/verify_hexes.hpp>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <utility>

using namespace pavior;
using namespace pavior::test;
namespace fs = std::filesystem;

namespace {

std::string write(const std::string& name, const std::string& text) {
    std::ofstream(scratch() / name) << text;
    return scratch_file(name);
}

/// [0, 3] x [0, 2] x [0, 1] as triangles.
std::string box_off() {
    return write("box.off",
                 "OFF\n8 12 0\n0 0 0\n3 0 0\n3 2 0\n0 2 0\n0 0 1\n3 0 1\n3 2 1\n0 2 1\n"
                 "3 0 2 1\n3 0 3 2\n3 4 5 6\n3 4 6 7\n3 0 1 5\n3 0 5 4\n3 1 2 6\n3 1 6 5\n3 2 3 7\n3 2 7 6\n3 3 0 4\n"
                 "3 3 4 7\n");
}

/// A box with a pyramid on it: 92 blocks, 84 where sheets stop.
std::string pyramid_off() {
    return write("pyramid.off",
                 "OFF\n13 22 0\n0 0 0\n3 0 0\n3 3 0\n0 3 0\n0 0 1\n3 0 1\n3 3 1\n0 3 1\n1 1 1\n2 1 1\n2 2 1\n1 2 1\n"
                 "1.5 1.5 1.8\n3 1 0 3\n3 3 2 1\n3 4 0 1\n3 1 5 4\n3 5 1 2\n3 2 6 5\n3 6 2 3\n3 3 7 6\n3 7 3 0\n"
                 "3 0 4 7\n3 8 4 5\n3 5 9 8\n3 9 5 6\n3 6 10 9\n3 10 6 7\n3 7 11 10\n3 11 7 4\n3 4 8 11\n3 8 9 12\n"
                 "3 9 10 12\n3 10 11 12\n3 11 8 12\n");
}

/// 5.5 radians of a square ring of radii 5 and 6.
std::string open_ring_off() {
    constexpr int n = 24;
    std::ostringstream text;
    text.precision(17);
    text << "OFF\n" << 4 * (n + 1) << " " << 8 * n + 4 << " 0\n";
    for (int i = 0; i <= n; ++i) {
        const double a = 5.5 * i / n;
        for (const auto& [r, z] : {std::pair{5, 0}, std::pair{6, 0}, std::pair{6, 1}, std::pair{5, 1}}) {
            text << r * std::cos(a) << " " << r * std::sin(a) << " " << z << "\n";
        }
    }
    for (int i = 0; i < n; ++i) {
        for (int k = 0; k < 4; ++k) {
            const int a = 4 * i + k;
            const int b = 4 * i + (k + 1) % 4;
            text << "3 " << a << " " << a + 4 << " " << b + 4 << "\n3 " << a << " " << b + 4 << " " << b << "\n";
        }
    }
    text << "3 0 1 2\n3 0 2 3\n3 " << 4 * n << " " << 4 * n + 2 << " " << 4 * n + 1 << "\n3 " << 4 * n << " "
         << 4 * n + 3 << " " << 4 * n + 2 << "\n";
    return write("ring.off", text.str());
}

/// The box as a VTK file of six tetrahedra.
std::string box_vtk() {
    return write("tets.vtk",
                 "# vtk DataFile Version 3.0\nbox\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 8 double\n0 0 0\n3 0 0\n"
                 "3 2 0\n0 2 0\n0 0 1\n3 0 1\n3 2 1\n0 2 1\nCELLS 6 30\n4 0 1 2 6\n4 0 2 3 6\n4 0 3 7 6\n4 0 7 4 6\n"
                 "4 0 4 5 6\n4 0 5 1 6\nCELL_TYPES 6\n10\n10\n10\n10\n10\n10\n");
}

}  // namespace

TEST_CASE("a surface becomes blocks, with report and groups") {
    const std::string mesh = scratch_file("blocks.vtu");
    const ProgramRun outcome =
        run_program("block " + pyramid_off() + " -o " + mesh + " --report " + scratch_file("blocks.json"));
    CAPTURE(outcome.err);
    REQUIRE(outcome.code == 0);
    CHECK(outcome.err.empty());
    CHECK(outcome.out.find("92 blocks") != std::string::npos);
    const HexMeshData data = read_mesh(mesh);
    CHECK(data.mesh.hexes.size() == 92);
    CHECK(data.mesh.nodes.size() == 177);
    CHECK(verify_hexes(data.mesh).ok());
    CHECK(std::set<int>(data.quad_groups.begin(), data.quad_groups.end()).size() == 10);
    CHECK(std::set<int>(data.hex_groups.begin(), data.hex_groups.end()).size() == 14);
    const auto json = json_of(scratch_file("blocks.json"));
    CHECK(json["exit_code"] == 0);
    CHECK(json["status"] == "valid");
    CHECK(json["blocks"]["blocks"] == 92);
    CHECK(json["blocks"]["nodes"] == 177);
    CHECK(json["blocks"]["euler"] == 1);
    CHECK(json["violations"].empty());
    CHECK(json["output"] == mesh);
    CHECK(json["mesh"]["volume"].get<double>() == Approx(9 + 4.0 / 15));
    CHECK(json["marking"]["sheets"].size() >= 4);
    CHECK(run_program("quality " + mesh).code == 0);
}

TEST_CASE("sheets run on or stop") {
    const std::string common = "block " + pyramid_off() + " -o " + scratch_file("stop.vtu") + " --quiet --propagation ";
    REQUIRE(run_program(common + "stop").code == 0);
    const std::size_t stopped = read_mesh(scratch_file("stop.vtu")).mesh.hexes.size();
    REQUIRE(run_program(common + "full --report " + scratch_file("stop.json")).code == 0);
    CHECK(json_of(scratch_file("stop.json"))["options"]["propagation"] == "full");
    CHECK(read_mesh(scratch_file("stop.vtu")).mesh.hexes.size() == 92);
    CHECK(stopped == 84);
}

TEST_CASE("blocks read off the local dual contributions are the same bytes as those of the cell complex") {
    const std::string mc3d = std::string(PAVIOR_EXAMPLE_DATA) + "/mc3d/hexme_s07c_notch_MC.vtk";
    const std::string hole = std::string(PAVIOR_TEST_DATA) + "/block/c05_plate_two_holes.off";
    for (const std::string& arguments :
         {pyramid_off(), pyramid_off() + " --propagation stop --size 0.3", box_vtk(), hole + " --size 2", mc3d}) {
        CAPTURE(arguments);
        for (const std::string way : {"complex", "contributions"}) {
            const ProgramRun outcome =
                run_program("block " + arguments + " -o " + scratch_file(way + ".vtu") + " --dualization " + way +
                            " --report " + scratch_file(way + ".json") + " --quiet");
            CAPTURE(way, outcome.err);
            REQUIRE(outcome.code == 0);
            CHECK(json_of(scratch_file(way + ".json"))["options"]["dualization"] == way);
        }
        CHECK(content(scratch_file("complex.vtu")) == content(scratch_file("contributions.vtu")));
        CHECK(read_mesh(scratch_file("complex.vtu")).mesh.hexes.size() >= 8);
    }
}

TEST_CASE("--size writes a fine mesh on the geometry, the same bytes for any number of threads") {
    const std::string common =
        "block " + pyramid_off() + " --size 0.2 --quiet --report " + scratch_file("fine.json") + " -o ";
    const ProgramRun outcome = run_program(common + scratch_file("fine1.vtu") + " --threads 1");
    REQUIRE(outcome.code == 0);
    CHECK(outcome.out.empty());
    CHECK(outcome.err.empty());
    const HexMeshData data = read_mesh(scratch_file("fine1.vtu"));
    CHECK(data.mesh.hexes.size() > 1000);
    const HexReport report = verify_hexes(data.mesh);
    CHECK(report.ok());
    CHECK(report.volume == Approx(9 + 4.0 / 15).epsilon(1e-12));
    CHECK(data.quads.size() == report.boundary_quads);
    CHECK(std::set<int>(data.hex_groups.begin(), data.hex_groups.end()).size() == 92);
    const auto json = json_of(scratch_file("fine.json"));
    CHECK(json["refinement"]["sheets"].size() == json["blocks"]["sheets"].get<std::size_t>());
    CHECK(json["mesh"]["hexahedra"] == data.mesh.hexes.size());
    REQUIRE(run_program(common + scratch_file("fine2.vtu") + " --threads 2").code == 0);
    CHECK(content(scratch_file("fine1.vtu")) == content(scratch_file("fine2.vtu")));
}

TEST_CASE("tetrahedra and CAD models are read too, and tags of faces travel") {
    REQUIRE(run_program("block " + box_vtk() + " -o " + scratch_file("tets.vtu")).code == 0);
    CHECK(read_mesh(scratch_file("tets.vtu")).mesh.hexes.size() == 8);
    const std::string part = std::string(PAVIOR_EXAMPLE_DATA) + "/mfcad/4-4-19.step";
    const ProgramRun outcome =
        run_program("block " + part + " -o " + scratch_file("part.msh") + " --report " + scratch_file("part.json"));
    CAPTURE(outcome.err);
    REQUIRE(outcome.code == 0);
    const HexMeshData data = read_mesh(scratch_file("part.msh"));
    CHECK(verify_hexes(data.mesh).ok());
    std::set<std::string> faces;  // the file calls its twelve faces 0 ... 11
    for (const MeshGroup& group : data.groups) {
        if (group.dimension == 2) {
            faces.insert(group.name);
        }
    }
    std::set<std::string> names;
    for (int i = 0; i < 12; ++i) {
        names.insert(std::to_string(i));
    }
    CHECK(faces == names);
}

TEST_CASE("tetrahedra whose feature edges have no names become blocks") {
    const auto blocks_of = [](const std::string& solid) {
        std::string input(PAVIOR_EXAMPLE_DATA);
        input.append("/mc3d/hexme_").append(solid).append("_MC.vtk");
        const ProgramRun outcome = run_program("block " + input + " -o " + scratch_file("mc.vtu") +
                                               " --size 1.2 --report " + scratch_file("mc.json") + " --quiet");
        CAPTURE(solid, outcome.err);
        REQUIRE(outcome.code == 0);
        const HexReport report = verify_hexes(read_mesh(scratch_file("mc.vtu")).mesh);
        CHECK(report.ok());
        return json_of(scratch_file("mc.json"))["blocks"]["blocks"].get<int>();
    };
    CHECK(blocks_of("s01c_cube") == 8);
    CHECK(blocks_of("s02c_prism") == 6);
    CHECK(blocks_of("n09c_pyramid") == 8);
    // The sheets of the re-entrant curve part the notched cube into two prisms of five sides and one of three.
    CHECK(blocks_of("s07c_notch") == 10 + 10 + 6);
    // The foot of the boss flares, so that its sheet ends on the sides of the box. A quarter is a prism of three sides
    // above the box, a cell of ten corners under the sheet and one of eight round it.
    CHECK(blocks_of("s11c_cube_cyl") == 4 * (6 + 10 + 8));
}

TEST_CASE("the dual can be looked at, also where it makes no blocks") {
    const ProgramRun outcome =
        run_program("block " + box_off() + " -o " + scratch_file("box.vtu") + " --mu 0.2 --dual " +
                    scratch_file("dual.vtu") + " --report " + scratch_file("dual.json"));
    CAPTURE(outcome.err);
    REQUIRE(outcome.code == 0);
    CHECK(fs::file_size(scratch_file("dual.vtu")) > 1000);
    const auto json = json_of(scratch_file("dual.json"));
    CHECK(json["dual"]["regions"] == 27);
    CHECK(json["dual"]["region_polyhedra"].get<int>() == 15 * json["reference"]["tetrahedra_cut"].get<int>());
    CHECK(json["options"]["mu"] == 0.2);
    const ProgramRun pyramid =
        run_program("block " + pyramid_off() + " --marking published -o " + scratch_file("none.vtu") + " --dual " +
                    scratch_file("none_dual.vtu") + " --report " + scratch_file("none.json"));
    CAPTURE(pyramid.err);
    CHECK(pyramid.code == 3);
    CHECK(pyramid.err.find("not meshable: invalid_dual") != std::string::npos);
    CHECK_FALSE(fs::exists(scratch_file("none.vtu")));
    CHECK(fs::exists(scratch_file("none_dual.vtu")));
    const auto report = json_of(scratch_file("none.json"));
    CHECK(report["exit_code"] == 3);
    CHECK_FALSE(report["violations"].empty());
    CHECK(report["violations"][0].contains("fault"));
    CHECK(report["blocks"].is_null());  // there are none: nothing is said of them
    CHECK_FALSE(report.contains("mesh"));
    CHECK_FALSE(report.contains("deviation"));
}

TEST_CASE("feature angles decide what is a curve") {
    // Edges of 90 degrees are no features if only sharper ones end: the box has no vertices then.
    const std::string common =
        "block " + box_off() + " -o " + scratch_file("angles.vtu") + " --report " + scratch_file("angles.json");
    REQUIRE(run_program(common + " --feature-angles 91,225,315").code == 0);
    CHECK(json_of(scratch_file("angles.json"))["options"]["feature_angles"][0] == 91.0);
    CHECK(read_mesh(scratch_file("angles.vtu")).mesh.hexes.size() == 8);
    // Like a ball: three planes through the centre part it into eight cells of four corners each.
    REQUIRE(run_program(common + " --feature-angles 80 225 315").code == 0);
    const auto smooth = json_of(scratch_file("angles.json"));
    CHECK(smooth["options"]["feature_angles"][0] == 80.0);
    CHECK(smooth["blocks"]["cells"] == 8);
    CHECK(smooth["blocks"]["blocks"] == 32);
    CHECK(smooth["marking"]["sheets"].size() == 3);
    const HexMeshData ball = read_mesh(scratch_file("angles.vtu"));
    CHECK(verify_hexes(ball.mesh).ok());
    CHECK(std::set<int>(ball.quad_groups.begin(), ball.quad_groups.end()).size() == 1);
}

TEST_CASE("an invalid block mesh is reported and only written on demand") {
    // Most of a thin ring is one box: its straight blocks cut through the hole, the fine mesh follows the ring.
    const std::string common = "block " + open_ring_off() + " -o " + scratch_file("ring.vtu");
    const ProgramRun outcome = run_program(common);
    CAPTURE(outcome.err);
    REQUIRE(outcome.code == 1);
    CHECK(outcome.err.find("inverted") != std::string::npos);
    CHECK_FALSE(fs::exists(scratch_file("ring.vtu")));
    CHECK(run_program(common + " --keep-invalid").code == 1);
    CHECK(fs::exists(scratch_file("ring.vtu")));
    CHECK(run_program("quality " + scratch_file("ring.vtu")).code == 1);
    const ProgramRun fine = run_program(common + " --size 0.5");
    CAPTURE(fine.err);
    CHECK(fine.code == 0);
    CHECK(fine.err.find("warning") != std::string::npos);
    CHECK(run_program("quality " + scratch_file("ring.vtu")).code == 0);
}

TEST_CASE("bad block options and files exit with 2 and say why") {
    const std::string box = box_off();
    const std::string mesh = scratch_file("x.vtu");
    const std::string open = write("open.off", "OFF\n4 3 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n");
    write("garbage.stl", "this is no STL file");
    write("empty.off", "");
    const std::string folded =  // two tetrahedra on the same side of their common face
        write("folded.vtk",
              "# vtk DataFile Version 3.0\nfolded\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 5 double\n"
              "0 0 0\n1 0 0\n0 1 0\n0 0 1\n0.2 0.2 2\nCELLS 2 10\n4 0 1 2 3\n4 0 1 2 4\n"
              "CELL_TYPES 2\n10\n10\n");
    for (const std::string& arguments : {std::string("block"),
                                         "block " + box,
                                         "block " + box + " -o " + mesh + " --size 0",
                                         "block " + box + " -o " + mesh + " --size -1",
                                         "block " + box + " -o " + mesh + " --marking none",
                                         "block " + box + " -o " + mesh + " --propagation far",
                                         "block " + box + " -o " + mesh + " --dualization none",
                                         "block " + box + " -o " + mesh + " --mu 0.25",
                                         "block " + box + " -o " + mesh + " --mu 0",
                                         "block " + box + " -o " + mesh + " --mu nan",
                                         "block " + box + " -o " + mesh + " --feature-angles 135 225",
                                         "block " + box + " -o " + mesh + " --feature-angles 200,225,315",
                                         "block " + box + " -o " + mesh + " --dual " + scratch_file("dual.txt"),
                                         "block " + box + " -o " + mesh + " --no-such",
                                         "block " + box + " -o " + scratch_file("x.stl"),
                                         "block " + box + " -o " + scratch_file("none/x.vtu"),
                                         "block " + open + " -o " + mesh,
                                         "block " + scratch_file("missing.off") + " -o " + mesh,
                                         "block " + scratch_file("garbage.stl") + " -o " + mesh,
                                         "block " + scratch_file("empty.off") + " -o " + mesh,
                                         "block " + folded + " -o " + mesh,
                                         "block " + scratch_file("stdout.txt") + " -o " + mesh}) {
        CAPTURE(arguments);
        const ProgramRun outcome = run_program(arguments);
        CHECK(outcome.code == 2);
        CHECK_FALSE(outcome.err.empty());
        CHECK_FALSE(fs::exists(mesh));
    }
    const ProgramRun outcome = run_program("block " + open + " -o " + mesh);
    CHECK(outcome.err.find("open_surface") != std::string::npos);
    CHECK(run_program("block " + folded + " -o " + mesh).err.find("same sense") != std::string::npos);
    CHECK(run_program("block --help").code == 0);
}
