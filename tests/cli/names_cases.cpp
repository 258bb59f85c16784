// Names of groups, formats and senses of quads, as users of the program meet them.
#include "support/catch.hpp"
#include "support/program.hpp"

#include <pavior/io/mesh_file.hpp>
#include <pavior/mesh/face_table.hpp>
#include <pavior/mesh/outward_quads.hpp>
#include <pavior/mesh/verify_hexes.hpp>

#include <algorithm>
#include <cctype>
#include <map>
#include <set>
#include <utility>
#include <vector>

using namespace pavior;
using namespace pavior::test;

namespace {

std::string fault(const std::string& name) { return std::string(PAVIOR_TEST_DATA).append("/faults/").append(name); }

using Names = std::vector<std::string>;

/// Meshes a file of tests/data/faults; the report.
nlohmann::json meshed(const std::string& command, const std::string& name, const std::string& output) {
    const std::string report = scratch_file("names.json");
    std::string arguments = command;
    arguments.append(" ").append(fault(name)).append(" -o ").append(output).append(" --report ").append(report);
    const ProgramRun run = run_program(arguments);
    CAPTURE(arguments, run.err);
    REQUIRE(run.code == 0);
    return json_of(report);
}

/// The names of groups in the report: as the model has them, or as the file.
Names reported(const nlohmann::json& report, const char* key, int dimension) {
    Names names;
    for (const nlohmann::json& group : report["mesh"]["groups"]) {
        if (group["dimension"] == dimension) {
            names.push_back(group[key]);
        }
    }
    return names;
}

/// The names in a file, by number.
Names in_file(const HexMeshData& data, int dimension) {
    std::map<int, std::string> names;
    for (const MeshGroup& group : data.groups) {
        if (group.dimension == dimension) {
            names.emplace(group.number, group.name);
        }
    }
    Names result;
    for (const auto& [number, name] : names) {
        result.push_back(name);
    }
    return result;
}

struct Output {
    const char* file;
    const char* options = "";
};
const std::vector<Output> outputs{{"a.vtu"},
                                  {"a.vtk"},
                                  {"a.msh"},
                                  {"b.msh", " --format msh4-ascii"},
                                  {"c.msh", " --format msh2"},
                                  {"d.msh", " --format msh2-ascii"},
                                  {"e.msh", " --format msh4"},
                                  {"a.inp"}};

std::string upper(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    return text;
}

/// What every format must keep: groups of all cells, one name each, and the report says which.
void check_file(const std::string& name, const Names& solids, std::size_t faces) {
    for (const auto& [output, options] : outputs) {
        CAPTURE(name, output, options);
        const std::string file = scratch_file(output);
        const nlohmann::json report = meshed("mesh --size 0.5" + std::string(options), name, file);
        CHECK(reported(report, "name", 3) == solids);
        const HexMeshData data = read_mesh(file);
        CHECK(verify_hexes(data.mesh).ok());
        const Names volumes = in_file(data, 3);
        const Names surfaces = in_file(data, 2);
        CHECK(surfaces.size() == faces);
        CHECK(reported(report, "written_as", 3) == volumes);
        CHECK(reported(report, "written_as", 2) == surfaces);
        std::set<std::string> all;
        for (const std::string& one : volumes) {
            all.insert(upper(one));
        }
        for (const std::string& one : surfaces) {
            all.insert(upper(one));
        }
        CHECK(all.size() == volumes.size() + surfaces.size());
        std::filesystem::remove(file);
    }
}

/// Outer quads that look outward, outer quads, quads between solids that look out of the one with the lower number,
/// and all of these.
std::array<std::size_t, 4> senses(const HexMeshData& data) {
    std::array<std::size_t, 4> count{};
    const auto faces = faces_under_quads(data.mesh, data.quads);
    for (std::size_t q = 0; q < data.quads.size(); ++q) {
        const auto& [first, second] = faces[q];
        REQUIRE(first.hex != no_index);
        const bool shared = second.hex != no_index;
        const HexFace& own = shared && data.hex_groups[second.hex] < data.hex_groups[first.hex] ? second : first;
        const bool out = from_smallest(data.quads[q]) == from_smallest(hex_face(data.mesh.hexes[own.hex], own.face));
        count[shared ? 3 : 1] += 1;
        count[shared ? 2 : 0] += out ? 1 : 0;
    }
    return count;
}

}  // namespace

TEST_CASE("names: parts before a slash, equal names, spaces, quotes, names of faces") {
    check_file("pnames_slash.step", {"alu/plate", "steel/plate"}, 12);
    check_file("pnames_same.step", {"bolt", "bolt"}, 12);
    check_file("pnames_collide.step", {"bolt-1", "bolt 1"}, 12);
    check_file("pnames_quote.step", {"bolt \"M8\"", "it's"}, 12);
    check_file("pnames_face_clash.step", {"face_3", "face_4"}, 12);
    check_file("names_utf8.step", {"Geh\xC3\xA4use \xC3\x98", "bolt-1"}, 12);
}

TEST_CASE("names: what stands in which format") {
    const auto written = [](const char* name, const char* output, int dimension) {
        return reported(meshed("mesh --size 0.5", name, scratch_file(output)), "written_as", dimension);
    };
    CHECK(written("pnames_slash.step", "a.vtu", 3) == Names{"alu/plate", "steel/plate"});
    CHECK(written("pnames_slash.step", "a.inp", 3) == Names{"alu_plate", "steel_plate"});
    CHECK(written("pnames_same.step", "a.msh", 3) == Names{"bolt", "bolt_2"});
    CHECK(written("pnames_collide.step", "a.inp", 3) == Names{"bolt_1", "bolt_1_2"});
    CHECK(written("pnames_quote.step", "a.msh", 3) == Names{"bolt 'M8'", "it's"});
    CHECK(written("pnames_quote.step", "a.vtk", 3) == Names{"bolt \"M8\"", "it's"});
    CHECK(written("names_utf8.step", "a.msh", 3) == Names{"Geh\xC3\xA4use \xC3\x98", "bolt-1"});
    const Names faces = written("pnames_face_clash.step", "a.inp", 2);
    CHECK(std::count(faces.begin(), faces.end(), "face_3_2") == 1);
    CHECK(std::count(faces.begin(), faces.end(), "face_4_2") == 1);
    const Names own = written("names_utf8.step", "a.vtu", 2);
    for (const char* name : {"\xE5\x85\xA5\xE5\x8F\xA3", "in let", "in-let", "wall", "wall_2", "1inlet"}) {
        CHECK(std::count(own.begin(), own.end(), name) == 1);
    }
}

TEST_CASE("names: solids of an STL file are its faces") {
    const std::string file = scratch_file("patches.vtu");
    const nlohmann::json report = meshed("block", "stl_six_named_patches.stl", file);
    CHECK(reported(report, "name", 2) == Names{"bottom", "top", "s1", "s2", "s3", "s4"});
    CHECK(in_file(read_mesh(file), 2) == Names{"bottom", "top", "s1", "s2", "s3", "s4"});
    const HexMeshData data = read_mesh(file);
    for (std::size_t q = 0; q < data.quads.size(); ++q) {  // the first two are flat in z
        const auto z = [&](std::size_t k) { return data.mesh.nodes[data.quads[q][k]][2]; };
        const bool flat = z(0) == z(1) && z(1) == z(2) && z(2) == z(3);
        CHECK(flat == (data.quad_groups[q] <= 2));
    }
    CHECK(senses(data)[0] == senses(data)[1]);
}

TEST_CASE("formats: what does not go with the ending is refused in words") {
    for (const char* command : {"mesh", "sweep", "block"}) {
        const std::string file = scratch_file("wrong.vtu");
        const ProgramRun run =
            run_program(std::string(command) + " " + fault("partial_face.step") + " -o " + file + " --format msh2");
        CHECK(run.code == 2);
        CHECK(run.err.find("goes with files that end in .msh, not in .vtu") != std::string::npos);
        CHECK_FALSE(std::filesystem::exists(file));
    }
    CHECK(run_program("mesh " + fault("partial_face.step") + " -o x.msh --format msh3").code == 2);
}

TEST_CASE("formats: every command writes the kind of .msh that is asked for") {
    const std::map<std::string, std::string> heads{
        {"msh4", "4.1 1 8"}, {"msh4-ascii", "4.1 0 8"}, {"msh2", "2.2 1 8"}, {"msh2-ascii", "2.2 0 8"}};
    const std::string file = scratch_file("kind.msh");
    for (const auto& [format, head] : heads) {
        for (const char* part :
             {"mesh|partial_face.step", "sweep|partial_face.step", "block|stl_six_named_patches.stl"}) {
            const std::string text = part;
            const std::size_t bar = text.find('|');
            CAPTURE(format, part);
            const auto report = meshed(text.substr(0, bar) + " --format " + format, text.substr(bar + 1), file);
            CHECK(content(file).rfind("$MeshFormat\n" + head + "\n", 0) == 0);
            CHECK(read_mesh(file).mesh.hexes.size() == report["mesh"]["hexahedra"].get<std::size_t>());
            CHECK(report["mesh"]["groups"][0]["written_as"].is_string());
        }
    }
}

TEST_CASE("quads look outward, also on faces that the CAD model has turned inward") {
    for (const char* command : {"mesh --size 0.25", "mesh --method sweep --size 0.25", "sweep --size 0.25"}) {
        const std::string file = scratch_file("partial.vtu");
        static_cast<void>(meshed(command, "partial_face.step", file));
        const auto [outward, outer, lower, shared] = senses(read_mesh(file));
        CAPTURE(command);
        CHECK(outer == 480);
        CHECK(outward == outer);
        CHECK(shared > 0);
        CHECK(lower == shared);
    }
}
