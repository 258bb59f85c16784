// `pavior mesh` as its users see it: which method, exit codes, reasons, reports.
#include "support/catch.hpp"
#include "support/occ_solids.hpp"
#include "support/program.hpp"

#include <pavior/cad/gmsh_brep.hpp>
#include <pavior/core/stopwatch.hpp>
#include <pavior/io/mesh_file.hpp>
#include <pavior/mesh/face_table.hpp>
#include <pavior/mesh/outward_quads.hpp>
#include <pavior/mesh/quality.hpp>
#include <pavior/mesh/verify_hexes.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <set>
#include <utility>
#include <vector>

using namespace pavior;
using namespace pavior::test;

namespace {

std::string example(const std::string& name) { return std::string(PAVIOR_EXAMPLE_DATA) + "/" + name; }

/// Meshes a part and returns the report; the mesh must be sound and its groups those of the CAD model.
nlohmann::json meshed(const std::string& part, const std::string& options, std::size_t faces) {
    const std::string mesh = scratch_file("part.vtu");
    const std::string report = scratch_file("part.json");
    std::string arguments = "mesh ";
    arguments.append(example(part)).append(" -o ").append(mesh).append(" --report ").append(report);
    const ProgramRun run = run_program(arguments.append(" ").append(options));
    CAPTURE(arguments, run.err);
    REQUIRE(run.code == 0);
    const HexMeshData data = read_mesh(mesh);
    const HexReport check = verify_hexes(data.mesh);
    CHECK(check.ok());
    CHECK(check.boundary_quads == data.quads.size());
    CHECK(std::set<int>(data.quad_groups.begin(), data.quad_groups.end()).size() == faces);
    CHECK(std::set<int>(data.hex_groups.begin(), data.hex_groups.end()) == std::set<int>{1});
    nlohmann::json json = json_of(report);
    CHECK(json["mesh"]["volume"].get<double>() == Approx(check.volume));
    std::filesystem::remove(mesh);
    return json;
}

/// The entry of the report on one method.
nlohmann::json tried(const nlohmann::json& json, const std::string& method) {
    for (const nlohmann::json& attempt : json["decisions"][0]["tries"]) {
        if (attempt["method"] == method) {
            return attempt;
        }
    }
    return {};
}

/// Quads on the boundary that do not look outward.
std::size_t quads_that_look_inward(const HexMeshData& data) {
    const auto faces = faces_under_quads(data.mesh, data.quads);
    std::size_t count = 0;
    for (std::size_t q = 0; q < data.quads.size(); ++q) {
        const auto& [own, other] = faces[q];
        REQUIRE(own.hex != no_index);
        const QuadCorners outward = hex_face(data.mesh.hexes[own.hex], own.face);
        count += other.hex == no_index && from_smallest(data.quads[q]) != from_smallest(outward) ? 1 : 0;
    }
    return count;
}

/// Writes what \p make makes with the CAD kernel to a file; its name.
template <class Make>
std::string made(const std::string& name, Make&& make) {
    const std::string file = scratch_file(name);
    gmsh::initialize();
    gmsh::option::setNumber("General.Terminal", 0);
    make();
    occ::synchronize();
    gmsh::write(file);
    gmsh::finalize();
    return file;
}

}  // namespace

TEST_CASE("mesh: a part of boxes is submapped") {
    const auto json = meshed("mfcad/5-5-6-19.step", "--size 2", 16);
    CHECK(json["decisions"][0]["method"] == "submap");
    CHECK(json["exit_code"] == 0);
    const auto submap = tried(json, "submap");
    CHECK(submap["outcome"] == "mesh");
    CHECK(submap["details"]["cad_volume"].get<double>() == Approx(json["mesh"]["volume"].get<double>()).epsilon(1e-9));
    CHECK(tried(json, "block")["outcome"] == "not_tried");
}

TEST_CASE("mesh: a one-to-one part is swept, submapping says why not") {
    const auto json = meshed("mfcad/4-4-19.step", "--size 2", 12);
    CHECK(json["decisions"][0]["method"] == "sweep");
    const auto submap = tried(json, "submap");
    CHECK(submap["outcome"] == "refused");
    CHECK(submap["reason"].get<std::string>().find("not_submappable") == 0);
    CHECK(submap["faces"].size() == 1);
}

TEST_CASE("mesh: a many-to-many part is swept from cap to cap, and --explain says so with face ids") {
    const auto json = meshed("mfcad/9-12-19.step", "--size 1.5", 14);
    CHECK(json["decisions"][0]["method"] == "multi-sweep");
    CHECK(tried(json, "sweep")["outcome"] == "refused");
    CHECK(tried(json, "multi-sweep")["details"]["attempts"].size() >= 1);
    const ProgramRun run = run_program("mesh " + example("mfcad/9-12-19.step") + " --size 1.5 --quiet --explain -o " +
                                       scratch_file("tree.msh"));
    CHECK(run.code == 0);
    CHECK(run.out.find("`- solid 1: multi-sweep\n") != std::string::npos);
    CHECK(run.out.find("   |- submap: refused (") != std::string::npos);
    CHECK(run.out.find("[faces 7]") != std::string::npos);
    CHECK(run.out.find("   |- multi-sweep: valid mesh, taken (") != std::string::npos);
    CHECK(run.out.find("   |- block: not needed\n") != std::string::npos);
    CHECK(run.out.find("   `- split: last resort, not needed\n") != std::string::npos);
}

TEST_CASE("mesh: what no sweep reaches becomes blocks") {
    const auto json = meshed("mfcad/1-4-4-4-14-23.step", "--size 2 --decompose off", 21);
    CHECK(json["decisions"][0]["method"] == "block");
    for (const char* method : {"submap", "sweep", "multi-sweep"}) {
        CHECK(tried(json, method)["outcome"] == "refused");
        CHECK_FALSE(tried(json, method)["faces"].empty());
    }
}

TEST_CASE("mesh: --method takes one method alone") {
    for (const std::string method : {"submap", "sweep", "multi-sweep", "block"}) {
        const auto json = meshed("mfcad/2-6-19.step", "--size 2 --method " + method, 12);
        CHECK(json["decisions"][0]["method"] == method);
        CHECK(json["decisions"][0]["tries"].size() == 1);
        CHECK(json["options"]["method"] == method);
    }
}

TEST_CASE("mesh: a later method may be better where an earlier one is poor") {
    const auto json = meshed("mfcad/4-4-19.step", "--size 8", 12);
    const auto sweep = tried(json, "sweep");
    REQUIRE(sweep["outcome"] == "mesh");
    CHECK(sweep["scaled_jacobian"] < 0.2);
    CHECK(json["decisions"][0]["method"] == "multi-sweep");
    CHECK(tried(json, "multi-sweep")["scaled_jacobian"] > sweep["scaled_jacobian"]);
}

TEST_CASE("mesh: a refusal exits with 3 and names faces; nothing is written") {
    const std::string mesh = scratch_file("none.vtu");
    const std::string report = scratch_file("none.json");
    const ProgramRun run = run_program("mesh " + example("hexme/i14o_s7.step") + " --method multi-sweep -o " + mesh +
                                       " --report " + report);
    CHECK(run.code == 3);
    CHECK(run.err.find("pavior: not meshable: solid 1\n") == 0);
    CHECK(run.err.find("multi-sweep: not_sweepable:") != std::string::npos);
    CHECK(run.err.find("face 1 leans") != std::string::npos);
    CHECK_FALSE(std::filesystem::exists(mesh));
    const auto json = json_of(report);
    CHECK(json["exit_code"] == 3);
    CHECK(json["output"].is_null());
    CHECK(tried(json, "multi-sweep")["faces"] == nlohmann::json({1, 3}));
}

TEST_CASE("mesh: the time limit strikes, and the answer says so") {
    const std::string mesh = scratch_file("late.vtu");
    const std::string report = scratch_file("late.json");
    const Stopwatch watch;
    const ProgramRun run = run_program("mesh " + example("mfcad/10-11-11-11-11-23.step") +
                                       " --size 0.02 --max-hexahedra 0 --timeout 5 -o " + mesh + " --report " + report);
    CHECK(watch.total() < 15);
    CHECK(run.code == 3);
    CHECK(run.err.find("within the time limit of 5 s\n") != std::string::npos);
    CHECK(run.err.find("submap: not done after ") != std::string::npos);
    CHECK_FALSE(std::filesystem::exists(mesh));
    const auto json = json_of(report);
    CHECK(json["decisions"][0]["out_of_time"] == true);
    CHECK(tried(json, "submap")["outcome"] == "timed_out");
    CHECK(tried(json, "block")["outcome"] == "timed_out");
    CHECK_FALSE(tried(json, "split")["outcome"] == "not_tried");  // these are too many tetrahedra, too
}

TEST_CASE("mesh: solids are cut on demand, the tree shows the cuts, and the report has them") {
    const std::string mesh = scratch_file("tee.vtu");
    const std::string report = scratch_file("tee.json");
    const ProgramRun run = run_program("mesh " + example("solids/pipe_tee.step") +
                                       " --method decompose --explain --timeout 0 -o " + mesh + " --report " + report);
    CAPTURE(run.err, run.out);
    REQUIRE(run.code == 0);
    CHECK(run.out.find("`- solid 1: decompose\n") != std::string::npos);
    CHECK(run.out.find("`- decompose: valid mesh, taken (") != std::string::npos);
    CHECK(run.out.find("- cut at a ") != std::string::npos);
    CHECK(run.out.find("plane") != std::string::npos);
    CHECK(run.out.find(" pieces, by ") != std::string::npos);
    const auto json = json_of(report);
    CHECK(json["options"]["method"] == "decompose");
    CHECK(json["decisions"][0]["method"] == "decompose");
    CHECK(json["decisions"][0]["tries"].size() == 1);
    const auto details = tried(json, "decompose")["details"];
    REQUIRE_FALSE(details["cuts"].empty());
    CHECK(details["pieces"].size() > details["cuts"].size());
    CHECK(details["cuts_tried"] >= details["cuts"].size());
    CHECK(details["meshes_tried"] > 0);
    std::size_t lines = 0;
    for (std::size_t at = run.out.find("- cut at a "); at != std::string::npos;
         at = run.out.find("- cut at a ", at + 1)) {
        ++lines;
    }
    CHECK(lines == details["cuts"].size());
    for (const auto& cut : details["cuts"]) {
        CHECK(run.out.find("cut at a " + cut["reason"].get<std::string>()) != std::string::npos);
        REQUIRE_FALSE(cut["surfaces"].empty());
        for (const auto& surface : cut["surfaces"]) {
            CHECK(std::set<std::string>{"plane", "half-plane", "cylinder"}.count(surface["kind"]) == 1);
            CHECK(surface["point"].size() == 3);
        }
    }
    const HexMeshData data = read_mesh(mesh);
    CHECK(verify_hexes(data.mesh).ok());
    CHECK(verify_hexes(data.mesh).boundary_quads == data.quads.size());
    CHECK(std::set<int>(data.hex_groups.begin(), data.hex_groups.end()) == std::set<int>{1});
    CHECK(json["mesh"]["quality"]["scaled_jacobian"]["min"].get<double>() >= 0.3);
    CHECK(quads_that_look_inward(data) == 0);
}

TEST_CASE("mesh: --decompose off cuts nothing, and is not explained") {
    for (const bool off : {false, true}) {
        const std::string report = scratch_file("whole.json");
        const ProgramRun run =
            run_program("mesh " + example("mfcad/4-4-19.step") + " --size 2 --explain -o " + scratch_file("whole.vtu") +
                        " --report " + report + (off ? " --decompose off" : " --decompose on"));
        CAPTURE(run.err);
        REQUIRE(run.code == 0);
        const auto json = json_of(report);
        CHECK(json["options"]["decompose"] == !off);
        CHECK(tried(json, "decompose").is_null() == off);
        CHECK((run.out.find("- decompose: not needed\n") == std::string::npos) == off);
        CHECK((run.out.find("decompose") == std::string::npos) == off);
        CHECK(run.out.find("- block: not needed\n") != std::string::npos);
    }
    const ProgramRun bad =
        run_program("mesh " + example("mfcad/4-4-19.step") + " --decompose maybe -o " + scratch_file("whole.vtu"));
    CHECK(bad.code == 2);
    CHECK(bad.err.find("--decompose") != std::string::npos);
}

TEST_CASE("mesh: --save-pieces keeps the pieces, as solids that are meshed again; none where nothing is cut") {
    const std::string pieces = scratch_file("pieces.brep");
    const std::string report = scratch_file("pieces.json");
    const std::string command = "mesh " + example("solids/pipe_tee.step") + " --size 2 --method decompose -o " +
                                scratch_file("tee.vtu") + " --report " + report + " --save-pieces ";
    const ProgramRun run = run_program(command + pieces);
    CAPTURE(run.err);
    REQUIRE(run.code == 0);
    const std::size_t count = tried(json_of(report), "decompose")["details"]["pieces"].size();
    CHECK(count > 1);
    CHECK(GmshBrep::load(pieces).solid_count() == count);
    CHECK(run_program("mesh " + pieces + " --size 2 -o " + scratch_file("again.vtu")).code == 0);

    for (const std::string& bad :
         {scratch_file("pieces.step"), scratch_file("tee.vtu"), scratch_file("no/such/folder/pieces.brep")}) {
        CAPTURE(bad);
        const ProgramRun refused = run_program(command + bad);
        CHECK(refused.code == 2);
        CHECK(refused.err.find(bad) != std::string::npos);
    }

    const std::string none = scratch_file("none.brep");
    const ProgramRun whole = run_program("mesh " + example("mfcad/4-4-19.step") + " --size 2 -o " +
                                         scratch_file("whole.vtu") + " --save-pieces " + none);
    CHECK(whole.code == 0);
    CHECK(whole.err.find("no solid was cut") != std::string::npos);
    CHECK_FALSE(std::filesystem::exists(none));
}

TEST_CASE("mesh: what nothing else meshes is split as the last resort, and says so; --no-split refuses it") {
    const std::string model = made("bowl.step", [] {
        const int block = occ::addBox(0, 0, 0, 6, 6, 4);
        const int ball = occ::addSphere(3, 3, 4.5, 2.2);
        const int hole = occ::addCylinder(-1, 3, 1, 8, 0, 0, 0.6);
        gmsh::vectorpair out;
        std::vector<gmsh::vectorpair> map;
        occ::cut({{3, block}}, {{3, ball}, {3, hole}}, out, map);
    });
    const std::string mesh = scratch_file("split.vtu");
    const std::string report = scratch_file("split.json");
    const std::string command = "mesh " + model + " --size 0.6 -o " + mesh + " --report " + report;
    const ProgramRun run = run_program(command + " --method split --explain");
    CAPTURE(run.err);
    REQUIRE(run.code == 0);
    CHECK(run.out.find("`- split: last resort, valid mesh, taken (") != std::string::npos);
    CHECK(run.out.find("- last resort: tetrahedra, each split in four\n") != std::string::npos);
    const auto json = json_of(report);
    CHECK(json["decisions"][0]["method"] == "split");
    CHECK(json["options"]["method"] == "split");
    const auto details = tried(json, "split")["details"];
    CHECK(details["last_resort"] == true);
    CHECK(4 * details["attempts"][details["taken"].get<std::size_t>()]["tetrahedra"].get<std::size_t>() ==
          json["mesh"]["hexahedra"]);
    const HexMeshData data = read_mesh(mesh);
    CHECK(verify_hexes(data.mesh).ok());
    CHECK(std::set<int>(data.quad_groups.begin(), data.quad_groups.end()).size() == 8);
    CHECK(json["mesh"]["quality"]["scaled_jacobian"]["min"].get<double>() > 0.1);
    CHECK(json["deviation"]["distance_in_sizes"].get<double>() < 0.25);

    const std::string hard =
        "mesh " + example("hexme/i14o_s7.step") + " --timeout 20 -o " + mesh + " --report " + report;
    const ProgramRun refused = run_program(hard + " --no-split --method auto");
    const auto without = json_of(report);
    CHECK(without["options"]["last_resort"] == false);
    for (const auto& one : without["decisions"][0]["tries"]) {
        CHECK(one["method"] != "split");
    }
    const ProgramRun split = run_program(hard);
    CAPTURE(split.err);
    CHECK(split.code == 0);
    const auto with = json_of(report);
    CHECK(with["options"]["last_resort"] == true);
    if (refused.code != 0) {  // where time is short
        CHECK(with["decisions"][0]["method"] == "split");
    } else {
        CHECK(with["mesh"]["quality"]["scaled_jacobian"]["min"].get<double>() >=
              without["mesh"]["quality"]["scaled_jacobian"]["min"].get<double>());
    }
}

TEST_CASE("mesh: an invalid mesh exits with 1 and is only written on demand") {
    const std::string mesh = scratch_file("invalid.vtu");
    const std::string arguments =  // so coarse that blocks lose a feature: the volume is 4 % too small
        "mesh " + example("mfcad/0-5-8-19.step") + " --size 4 --max-angle 90 --method block --timeout 0 -o " + mesh;
    const ProgramRun run = run_program(arguments);
    CHECK(run.code == 1);
    CHECK(run.err.find("its volume is") != std::string::npos);
    CHECK_FALSE(std::filesystem::exists(mesh));
    CHECK(run_program(arguments + " --keep-invalid").code == 1);
    REQUIRE(std::filesystem::exists(mesh));
    CHECK(verify_hexes(read_mesh(mesh).mesh).volume < 670);  // of 683.6
}

TEST_CASE("mesh: solids that share faces are meshed together, conforming") {
    const std::string mesh = scratch_file("assembly.vtu");
    const ProgramRun run =
        run_program("mesh " + example("assembly/bolt_plate_washer.step") + " --size 3 --explain -o " + mesh);
    CAPTURE(run.err);
    REQUIRE(run.code == 0);
    CHECK(run.out.find("solids 1, 2, 3: ") != std::string::npos);
    const HexMeshData data = read_mesh(mesh);
    CHECK(verify_hexes(data.mesh).ok());
    CHECK(std::set<int>(data.hex_groups.begin(), data.hex_groups.end()) == std::set<int>{1, 2, 3});
    CHECK(group_name(data, 3, 1) == "plate");
}

TEST_CASE("mesh: 27 cubes with holes, pockets and slots conform across their shared faces") {
    const std::string mesh = scratch_file("cubes.vtu");
    const std::string report = scratch_file("cubes.json");
    const ProgramRun run = run_program("mesh " + example("assembly/cubes_27.brep") + " --size 1 -o " + mesh +
                                       " --report " + report + " --quiet");
    CAPTURE(run.err);
    REQUIRE(run.code == 0);
    CHECK(json_of(report)["decisions"].size() == 1);
    CHECK(json_of(report)["decisions"][0]["method"] == "multi-sweep");
    const HexMeshData data = read_mesh(mesh);
    CHECK(verify_hexes(data.mesh).ok());
    CHECK(hex_quality(data.mesh).scaled_jacobian.min >= 0.2);
    CHECK(std::set<int>(data.hex_groups.begin(), data.hex_groups.end()).size() == 27);
}

TEST_CASE("mesh: 27 cubes whose features end on those of their neighbours conform") {
    const std::string mesh = scratch_file("unlike.vtu");
    const ProgramRun run =
        run_program("mesh " + example("assembly/cubes_27_unlike.brep") + " --size 1 --quiet -o " + mesh);
    CAPTURE(run.err);
    REQUIRE(run.code == 0);
    const HexMeshData data = read_mesh(mesh);
    CHECK(verify_hexes(data.mesh).ok());
    CHECK(hex_quality(data.mesh).scaled_jacobian.min > 0.03);  // circles touch the edges of pockets
    CHECK(std::set<int>(data.hex_groups.begin(), data.hex_groups.end()).size() == 27);
}

TEST_CASE("mesh: a poor mesh is improved by sliding nodes on plane faces") {
    const auto json = meshed("mfcad/10-11-11-11-11-23.step", "--size 1", 39);
    CHECK(json["decisions"][0]["method"] == "submap");
    const auto submap = tried(json, "submap");
    CHECK(submap["scaled_jacobian"].get<double>() >= 0.3);
    CHECK(submap["details"]["improvement"]["moved_nodes"].get<int>() > 0);
    CHECK(submap["details"]["cad_volume"].get<double>() == Approx(json["mesh"]["volume"].get<double>()).epsilon(1e-12));
    CHECK(tried(json, "block")["outcome"] == "not_tried");
}

TEST_CASE("mesh: solids apart from each other get each its own method") {
    const std::string mesh = scratch_file("apart.msh");
    const std::string report = scratch_file("apart.json");
    const ProgramRun run = run_program(std::string("mesh ") + PAVIOR_TEST_DATA + "/cad/box_and_cylinder.step" +
                                       " --size 0.5 -o " + mesh + " --report " + report);
    CAPTURE(run.err);
    REQUIRE(run.code == 0);
    const auto json = json_of(report);
    REQUIRE(json["decisions"].size() == 2);
    CHECK(json["decisions"][0]["method"] == "submap");
    CHECK(json["decisions"][1]["method"] == "sweep");
    const HexMeshData data = read_mesh(mesh);
    CHECK(verify_hexes(data.mesh).ok());
    CHECK(std::count(data.hex_groups.begin(), data.hex_groups.end(), 1) == 6 * 4 * 2);
    CHECK(std::count(data.hex_groups.begin(), data.hex_groups.end(), 2) ==
          static_cast<std::ptrdiff_t>(data.mesh.hexes.size() - 48));
    CHECK(std::set<int>(data.quad_groups.begin(), data.quad_groups.end()).size() == 9);
}

TEST_CASE("mesh: one of several solids becomes blocks, the others do not notice") {
    const std::string model = made("block_and_box.brep", [] {
        gmsh::vectorpair solids;
        (void)occ::addBox(30, 0, 0, 4, 3, 2);
        occ::importShapes(example("mfcad/1-4-4-4-14-23.step"), solids);
    });
    const std::string mesh = scratch_file("block_and_box.vtu");
    const std::string report = scratch_file("block_and_box.json");
    const ProgramRun run =
        run_program("mesh " + model + " --size 2 --decompose off --quiet -o " + mesh + " --report " + report);
    CAPTURE(run.err);
    REQUIRE(run.code == 0);
    const auto json = json_of(report);
    CHECK(json["decisions"][0]["method"] == "submap");
    CHECK(json["decisions"][1]["method"] == "block");
    const HexMeshData data = read_mesh(mesh);
    CHECK(verify_hexes(data.mesh).ok());
    CHECK(std::count(data.hex_groups.begin(), data.hex_groups.end(), 1) == 2 * 2 * 1);
    CHECK(std::set<int>(data.hex_groups.begin(), data.hex_groups.end()) == std::set<int>{1, 2});
    CHECK(std::set<int>(data.quad_groups.begin(), data.quad_groups.end()).size() == 6 + 21);
}

TEST_CASE("mesh: shallow creases between plane faces are features of the blocks") {
    const std::string model = made("creased.brep", [] {
        // a flat roof over a box with a corner cut off from below
        std::vector<int> points;
        std::vector<int> lines;
        for (const auto& [x, z] : {std::pair(0.0, 0.0), {6.0, 0.0}, {6.0, 3.0}, {3.0, 3.9}, {0.0, 3.0}}) {
            points.push_back(occ::addPoint(x, 0, z));
        }
        for (std::size_t i = 0; i < points.size(); ++i) {
            lines.push_back(occ::addLine(points[i], points[(i + 1) % points.size()]));
        }
        gmsh::vectorpair house;
        occ::extrude({{2, occ::addPlaneSurface({occ::addCurveLoop(lines)})}}, 0, 6, 0, house);
        gmsh::vectorpair cut;
        std::vector<gmsh::vectorpair> map;
        occ::cut({house.at(1)}, {{3, occ::addBox(4, 4, -1, 3, 3, 2)}}, cut, map);
    });
    const std::string mesh = scratch_file("creased.vtu");
    const ProgramRun run = run_program("mesh " + model + " --size 1 --method block --explain -o " + mesh);
    CAPTURE(run.err);
    REQUIRE(run.code == 0);
    CHECK(run.out.find("are features, too") != std::string::npos);
    const HexReport check = verify_hexes(read_mesh(mesh).mesh);
    CHECK(check.ok());
    CHECK(check.volume == Approx(6 * (18 + 2.7) - 2 * 2).epsilon(1e-9));
}

TEST_CASE("mesh: a bend whose radius changes is swept round its axis") {
    const std::string model = made("bend.brep", [] {
        gmsh::vectorpair pieces;
        for (const auto& [radius, from] : {std::pair(1.0, 0.0), {1.6, 0.8}}) {
            const int disc = occ::addDisk(4, 0, 0, radius, radius);
            occ::rotate({{2, disc}}, 4, 0, 0, 1, 0, 0, 0.5 * std::numbers::pi);
            occ::rotate({{2, disc}}, 0, 0, 0, 0, 0, 1, from);
            gmsh::vectorpair out;
            occ::revolve({{2, disc}}, 0, 0, 0, 0, 0, 1, 0.8, out);
            pieces.push_back(out.at(1));
        }
        gmsh::vectorpair solid;
        std::vector<gmsh::vectorpair> map;
        occ::fuse({pieces[0]}, {pieces[1]}, solid, map);
    });
    const std::string mesh = scratch_file("bend.vtu");
    const std::string report = scratch_file("bend.json");
    const ProgramRun run = run_program("mesh " + model + " --size 0.5 --explain -o " + mesh + " --report " + report);
    CAPTURE(run.err);
    REQUIRE(run.code == 0);
    CHECK(run.out.find("round the axis through (") != std::string::npos);
    const auto json = json_of(report);
    CHECK(json["decisions"][0]["method"] == "multi-sweep");
    const auto axis = json["decisions"][0]["tries"][2]["details"]["axis"];
    CHECK(std::abs(axis["direction"][2].get<double>()) == Approx(1));
    CHECK(verify_hexes(read_mesh(mesh).mesh).ok());
    CHECK(json["mesh"]["quality"]["scaled_jacobian"]["min"].get<double>() >= 0.2);
}

TEST_CASE("mesh: a pipe elbow with flanges is swept along its path") {
    const std::string mesh = scratch_file("elbow.vtu");
    const std::string report = scratch_file("elbow.json");
    const ProgramRun run =
        run_program("mesh " + example("paths/elbow.step") + " --size 0.3 --explain -o " + mesh + " --report " + report);
    CAPTURE(run.err);
    REQUIRE(run.code == 0);
    CHECK(run.out.find("parallel to edges ") != std::string::npos);
    const auto json = json_of(report);
    CHECK(json["decisions"][0]["method"] == "multi-sweep");
    const auto& details = json["decisions"][0]["tries"][2]["details"];
    CHECK(details["edges"].size() == 3);
    CHECK(details["axis"].is_null());
    CHECK(details["direction"].is_null());
    CHECK(verify_hexes(read_mesh(mesh).mesh).ok());
    CHECK(json["mesh"]["quality"]["scaled_jacobian"]["min"].get<double>() >= 0.2);
}

TEST_CASE("mesh: touching solids that no one method takes get each its own, and conform") {
    const std::string mesh = scratch_file("mixed.vtu");
    const std::string report = scratch_file("mixed.json");
    const ProgramRun run = run_program("mesh " + example("assembly/mixed_methods.brep") + " --size 0.7 --explain -o " +
                                       mesh + " --report " + report);
    CAPTURE(run.err);
    REQUIRE(run.code == 0);
    const auto json = json_of(report);
    for (const char* method : {"submap", "sweep", "multi-sweep"}) {
        const auto& tries = json["decisions"][0]["tries"];
        CHECK(std::any_of(tries.begin(), tries.end(),
                          [&](const auto& one) { return one["method"] == method && one["outcome"] == "refused"; }));
    }
    CHECK(json["decisions"][0]["method"] == "mixed");
    CHECK(run.out.find("solid 1: multi-sweep") != std::string::npos);
    CHECK(run.out.find("solid 2: submap") != std::string::npos);
    CHECK(run.out.find("solid 3: sweep") != std::string::npos);
    CHECK(run.out.find("solid 4: sweep") != std::string::npos);
    const HexMeshData data = read_mesh(mesh);
    CHECK(verify_hexes(data.mesh).ok());
    CHECK(hex_quality(data.mesh).scaled_jacobian.min > 0.2);
    CHECK(std::set<int>(data.hex_groups.begin(), data.hex_groups.end()) == std::set<int>{1, 2, 3, 4});
    CHECK(run_program("mesh " + example("mfcad/0-1-13-19.step") + " --size 2 --quiet --method mixed -o " + mesh).code ==
          0);
}

TEST_CASE("mesh: twice the same bytes, whatever the threads") {
    const std::string arguments = "mesh " + example("mfcad/9-12-19.step") + " --size 1.5 --quiet -o ";
    REQUIRE(run_program(arguments + scratch_file("a.vtu") + " --threads 1").code == 0);
    REQUIRE(run_program(arguments + scratch_file("b.vtu") + " --threads 2").code == 0);
    CHECK(content(scratch_file("a.vtu")) == content(scratch_file("b.vtu")));
}

TEST_CASE("mesh: bad options and files exit with 2 and say why") {
    const std::string part = "mesh " + example("mfcad/4-4-19.step");
    const std::string mesh = scratch_file("x.vtu");
    std::ofstream(scratch_file("garbage.step")) << "this is no STEP file";
    for (const std::string& arguments :
         {std::string("mesh"), part, part + " -o " + mesh + " --size 0", part + " -o " + mesh + " --size x",
          part + " -o " + mesh + " --method dual", part + " -o " + mesh + " --timeout -1",
          part + " -o " + mesh + " --no-such", part + " -o " + scratch_file("x.stl"),
          part + " -o " + scratch_file("none/x.vtu") + " --size 4",
          "mesh " + scratch_file("missing.step") + " -o " + mesh,
          "mesh " + scratch_file("garbage.step") + " -o " + mesh, "mesh " + scratch_file("x.off") + " -o " + mesh}) {
        CAPTURE(arguments);
        const ProgramRun run = run_program(arguments);
        CHECK(run.code == 2);
        CHECK_FALSE(run.err.empty());
        CHECK_FALSE(std::filesystem::exists(mesh));
    }
    CHECK(run_program("mesh --help").code == 0);
}
