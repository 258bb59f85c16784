#include "support/catch.hpp"

#include <pavior/io/group_names.hpp>

#include <algorithm>

using namespace pavior;

namespace {

/// The names in a file of solids and then of faces, numbered from 1.
std::vector<std::string> written(MeshFormat format, const std::vector<std::string>& solids,
                                 const std::vector<std::string>& faces = {}) {
    HexMeshData data;
    for (std::size_t i = 0; i < faces.size(); ++i) {
        data.groups.push_back({2, static_cast<int>(i) + 1, faces[i]});
    }
    for (std::size_t i = solids.size(); i-- > 0;) {
        data.groups.push_back({3, static_cast<int>(i) + 1, solids[i]});
    }
    std::vector<std::string> names;
    for (const MeshGroup& group : names_in_file(data, format)) {
        names.push_back(group.name);
    }
    std::reverse(data.groups.begin(), data.groups.end());  // the order of the groups does not matter
    std::vector<std::string> again;
    for (const MeshGroup& group : names_in_file(data, format)) {
        again.push_back(group.name);
    }
    CHECK(names == again);
    return names;
}

using Names = std::vector<std::string>;
constexpr std::array formats{MeshFormat::vtu,   MeshFormat::vtk,         MeshFormat::msh41, MeshFormat::msh41_ascii,
                             MeshFormat::msh22, MeshFormat::msh22_ascii, MeshFormat::inp};

}  // namespace

TEST_CASE("names that are legal and differ are kept in every format") {
    for (const MeshFormat format : formats) {
        CHECK(written(format, {"bolt", "Washer_2"}, {"inlet", "face_7"}) ==
              Names{"bolt", "Washer_2", "inlet", "face_7"});
    }
}

TEST_CASE("equal names are numbered, solids first, whatever the dimension") {
    for (const MeshFormat format : formats) {
        CHECK(written(format, {"bolt", "bolt"}, {"bolt", "wall", "wall"}) ==
              Names{"bolt", "bolt_2", "bolt_3", "wall", "wall_2"});
        CHECK(written(format, {"a", "a"}, {"a_2"}) == Names{"a", "a_3", "a_2"});  // a_2 is somebody's own
        CHECK(written(format, {"face_3"}, {"face_1", "face_2", "face_3"}) ==
              Names{"face_3", "face_1", "face_2", "face_3_2"});
    }
    CHECK(written(MeshFormat::vtk, {"METADATA"}) == Names{"METADATA_2"});  // a keyword there
}

TEST_CASE("slashes, spaces and UTF-8 stay where the format can hold them") {
    for (const MeshFormat format : {MeshFormat::vtu, MeshFormat::vtk, MeshFormat::msh41, MeshFormat::msh22_ascii}) {
        CHECK(written(format, {"alu/plate", "steel/plate", "Geh\xC3\xA4use \xC3\x98"}, {"\xE5\x85\xA5\xE5\x8F\xA3"}) ==
              Names{"alu/plate", "steel/plate", "Geh\xC3\xA4use \xC3\x98", "\xE5\x85\xA5\xE5\x8F\xA3"});
        CHECK(written(format, {" two\nlines\t"}) == Names{"two lines"});
        CHECK(written(format, {"\xFF\xC3", "\xED\xA0\x80"}) ==
              Names{"\xEF\xBF\xBD\xEF\xBF\xBD", "\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD"});
    }
    CHECK(written(MeshFormat::vtu, {"bolt \"M8\""}) == Names{"bolt \"M8\""});
    CHECK(written(MeshFormat::msh41, {"a\\b\\", "a/b/"}) == Names{"a/b/_2", "a/b/"});
    CHECK(written(MeshFormat::msh41, {"bolt \"M8\"", "bolt 'M8'"}) == Names{"bolt 'M8'_2", "bolt 'M8'"});
}

TEST_CASE("names of Abaqus are letters, digits and underscores, a letter first, also apart in capitals") {
    CHECK(written(MeshFormat::inp, {"bolt-1", "bolt 1", "BOLT_1"}) == Names{"bolt_1_2", "bolt_1_3", "BOLT_1"});
    CHECK(written(MeshFormat::inp, {"wall"}, {"Wall"}) == Names{"wall", "Wall_2"});
    CHECK(written(MeshFormat::inp, {"2nd", "_x"}, {"1inlet"}) == Names{"V_2nd", "V__x", "S_1inlet"});
    CHECK(written(MeshFormat::inp, {"\xE5\x85\xA5\xE5\x8F\xA3", ""}, {"--"}) ==
          Names{"VOLUME_1", "VOLUME_2", "SURFACE_1"});
    CHECK(written(MeshFormat::inp, {"Geh\xC3\xA4use"}) == Names{"Geh_use"});
    const Names longs = written(MeshFormat::inp, {std::string(100, 'a'), std::string(101, 'A')});
    CHECK(longs == Names{std::string(80, 'a'), std::string(78, 'A') + "_2"});
}

TEST_CASE("long names are cut between characters") {
    std::string umlauts;
    for (int i = 0; i < 300; ++i) {
        umlauts += "\xC3\xA4";
    }
    CHECK(written(MeshFormat::vtu, {umlauts})[0].size() == 600);
    CHECK(written(MeshFormat::vtk, {umlauts})[0].size() == 80);  // six bytes each with escapes
    CHECK(written(MeshFormat::msh41, {"x" + umlauts})[0].size() == 199);
    const Names two = written(MeshFormat::msh41, {umlauts + "1", umlauts + "2"});
    CHECK(two[0].size() == 200);
    CHECK(two[1].substr(two[1].size() - 2) == "_2");
}

TEST_CASE("groups without a name have one in Abaqus alone") {
    HexMeshData data;
    data.mesh.hexes.resize(2);
    data.hex_groups = {4, 9};
    data.quads.resize(1);
    data.groups = {{3, 9, "bolt"}};
    const std::vector<MeshGroup> abaqus = names_in_file(data, MeshFormat::inp);
    REQUIRE(abaqus.size() == 3);
    CHECK(abaqus[0] == MeshGroup{3, 4, "VOLUME_4"});
    CHECK(abaqus[1] == MeshGroup{3, 9, "bolt"});
    CHECK(abaqus[2] == MeshGroup{2, 0, "SURFACE_0"});
    CHECK(names_in_file(data, MeshFormat::vtu) == std::vector<MeshGroup>{{3, 9, "bolt"}});
    data.groups = {{3, 4, ""}, {3, 9, ""}};
    CHECK(names_in_file(data, MeshFormat::msh41) == data.groups);
}
