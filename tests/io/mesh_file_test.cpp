#include "support/catch.hpp"
#include "support/foreign_meshes.hpp"
#include "support/shapes.hpp"

#include <pavior/core/error.hpp>
#include <pavior/io/mesh_file.hpp>

#include <unistd.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

using namespace pavior;
namespace fs = std::filesystem;

namespace {

fs::path scratch() {
    const fs::path directory = fs::temp_directory_path() / "pavior_mesh_file_test";
    fs::create_directories(directory);
    return directory;
}

/// Two hexahedra in two groups, with coordinates that need all 17 digits, and two quads.
HexMeshData two_hexes() {
    HexMeshData data;
    for (int k = 0; k < 3; ++k) {
        for (const auto& [x, y] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
            data.mesh.nodes.emplace_back(x / 3.0, std::sqrt(2.0) * y, 1e-3 * k + 0.1 * k);
        }
    }
    data.mesh.hexes = {{0, 1, 2, 3, 4, 5, 6, 7}, {4, 5, 6, 7, 8, 9, 10, 11}};
    data.quads = {{0, 3, 2, 1}, {8, 9, 10, 11}};
    data.hex_groups = {7, 9};
    data.quad_groups = {1, 2};
    data.groups = {{3, 7, "bolt"}, {3, 9, "washer"}, {2, 1, "bottom"}, {2, 2, "top"}};
    return data;
}

void write_text(const fs::path& file, const std::string& text) { std::ofstream(file) << text; }

std::string content(const fs::path& file) {
    std::ostringstream text;
    text << std::ifstream(file, std::ios::binary).rdbuf();
    return text.str();
}

/// Group names per cell: formats are free to renumber groups, not to rename them.
std::vector<std::string> names(const HexMeshData& data, int dimension) {
    std::vector<std::string> result;
    for (const int number : dimension == 3 ? data.hex_groups : data.quad_groups) {
        for (const MeshGroup& group : data.groups) {
            if (group.dimension == dimension && group.number == number) {
                result.push_back(group.name);
            }
        }
    }
    return result;
}

}  // namespace

TEST_CASE("every format keeps the bits of coordinates, the order of nodes and cells, and the groups") {
    const HexMeshData data = two_hexes();
    for (const char* name : {"a.vtu", "a.vtk", "a.msh", "a.inp", "UPPER.VTU"}) {
        CAPTURE(name);
        const std::string file = scratch() / name;
        write_mesh(file, data);
        const HexMeshData back = read_mesh(file);
        REQUIRE(back.mesh.nodes.size() == data.mesh.nodes.size());
        for (std::size_t i = 0; i < data.mesh.nodes.size(); ++i) {
            CHECK(std::memcmp(back.mesh.nodes[i].data(), data.mesh.nodes[i].data(), 3 * sizeof(double)) == 0);
        }
        CHECK(back.mesh.hexes == data.mesh.hexes);
        CHECK(back.quads == data.quads);
        CHECK(names(back, 3) == names(data, 3));
        CHECK(names(back, 2) == names(data, 2));
    }
}

TEST_CASE("both versions of .msh, binary and text, are read back by Gmsh as they were written") {
    HexMeshData data = two_hexes();
    data.mesh.nodes[3] = {-1.7976931348623157e308, 5e-324, -0.0};
    data.groups = {
        {3, 7, "Geh\xC3\xA4use \xC3\x98"}, {3, 9, "bolt \"M8\""}, {2, 1, "back\\slash\\"}, {2, 2, " it's\na "}};
    std::set<std::string> contents;
    for (const MeshFormat format :
         {MeshFormat::by_extension, MeshFormat::msh41_ascii, MeshFormat::msh22, MeshFormat::msh22_ascii}) {
        CAPTURE(static_cast<int>(format));
        const std::string file = scratch() / "versions.msh";
        if (format == MeshFormat::by_extension || format == MeshFormat::msh41_ascii) {
            data.mesh.nodes.resize(13, Vec3(1e-17, 0.1, 2.0 / 3));  // of no cell: Gmsh reads none in 2.2
        } else {
            data.mesh.nodes.resize(12);
        }
        write_mesh(file, data, {format});
        const HexMeshData back = read_mesh(file);
        REQUIRE(back.mesh.nodes.size() == data.mesh.nodes.size());
        for (std::size_t i = 0; i < data.mesh.nodes.size(); ++i) {
            CHECK(std::memcmp(back.mesh.nodes[i].data(), data.mesh.nodes[i].data(), 3 * sizeof(double)) == 0);
        }
        CHECK(back.mesh.hexes == data.mesh.hexes);
        CHECK(back.quads == data.quads);
        CHECK(back.hex_groups == data.hex_groups);
        CHECK(back.quad_groups == data.quad_groups);
        CHECK(names(back, 3) == std::vector<std::string>{"Geh\xC3\xA4use \xC3\x98", "bolt 'M8'"});
        CHECK(names(back, 2) == std::vector<std::string>{"back/slash/", "it's a"});
        contents.insert(content(file));
    }
    CHECK(contents.size() == 4);
}

TEST_CASE("VTK's files keep every name") {
    HexMeshData data = two_hexes();
    data.groups = {
        {3, 7, "a <b> & \"c\" 'd' &amp; %20 %"}, {3, 9, "bolt\\\"M8\""}, {2, 1, "1 2 int"}, {2, 2, "\xE5\x85\xA5"}};
    for (const char* name : {"names.vtu", "names.vtk"}) {
        CAPTURE(name);
        write_mesh(scratch() / name, data);
        CHECK(read_mesh(scratch() / name).groups == data.groups);
    }
}

TEST_CASE("groups of any numbers and in any order, and many of them, survive in .msh") {
    HexMeshData data;
    data.mesh = shapes::hex_box(4, 3, 2);
    for (std::size_t h = 0; h < data.mesh.hexes.size(); ++h) {
        const int number = static_cast<int>(h * 7 % 5);  // 0: of no group
        data.hex_groups.push_back(number);
        data.quads.push_back(data.mesh.hexes[h][0] == 0 ? QuadCorners{0, 1, 2, 3} : QuadCorners{1, 2, 3, 4});
        data.quad_groups.push_back(1000000 - static_cast<int>(h));
    }
    data.groups = {{3, 4, "d"}, {2, 1000000, "d"}};
    for (const MeshFormat format :
         {MeshFormat::msh41, MeshFormat::msh41_ascii, MeshFormat::msh22, MeshFormat::msh22_ascii}) {
        const std::string file = scratch() / "many.msh";
        write_mesh(file, data, {format});
        const HexMeshData back = read_mesh(file);
        const auto cells = [](const HexMeshData& d, int unnumbered) {
            std::multiset<std::pair<int, HexCorners>> all;
            for (std::size_t h = 0; h < d.mesh.hexes.size(); ++h) {
                all.emplace(d.hex_groups[h] == unnumbered ? 0 : d.hex_groups[h], d.mesh.hexes[h]);
            }
            return all;
        };
        CHECK(cells(back, 5) == cells(data, 0));  // no group becomes the first number that is free
        CHECK(std::set<int>(back.quad_groups.begin(), back.quad_groups.end()).size() == data.quads.size());
        CHECK(std::count(back.groups.begin(), back.groups.end(), MeshGroup{3, 4, "d"}) == 1);
        CHECK(std::count(back.groups.begin(), back.groups.end(), MeshGroup{2, 1000000, "d_2"}) == 1);
    }
}

TEST_CASE("a format that does not go with the ending is refused") {
    CHECK(mesh_format("a.MSH") == MeshFormat::msh41);
    CHECK(mesh_format("a.msh", MeshFormat::msh22_ascii) == MeshFormat::msh22_ascii);
    CHECK(mesh_format("a.inp", MeshFormat::inp) == MeshFormat::inp);
    CHECK_THROWS_WITH(mesh_format("a.vtu", MeshFormat::msh22), Catch::Contains("a.vtu") && Catch::Contains(".msh"));
    CHECK_THROWS_AS(mesh_format("a.msh", MeshFormat::vtk), FileError);
    CHECK_THROWS_AS(mesh_format("a.stl", MeshFormat::vtk), FileError);
    CHECK_THROWS_AS(write_mesh(scratch() / "x.vtu", two_hexes(), {MeshFormat::inp}), FileError);
    CHECK_FALSE(fs::exists(scratch() / "x.vtu"));
    HexMeshData wrong = two_hexes();
    wrong.mesh.hexes[1][3] = 100;
    CHECK_THROWS_WITH(write_mesh(scratch() / "x.vtu", wrong), Catch::Contains("node that does not exist"));
}

TEST_CASE("the names of files of VTK written before are read") {
    const std::string file = scratch() / "before.vtk";
    std::ofstream(file) << "# vtk DataFile Version 5.1\nbefore\nASCII\nDATASET UNSTRUCTURED_GRID\n"
                           "FIELD FieldData 1\ngroup_names 1 2 string\n3%201%20bolt\n2%207%20a%20face\n"
                           "POINTS 8 double\n0 0 0 1 0 0 1 1 0 0 1 0 0 0 1 1 0 1 1 1 1 0 1 1\n"
                           "CELLS 2 8\nOFFSETS vtktypeint64\n0 8\nCONNECTIVITY vtktypeint64\n0 1 2 3 4 5 6 7\n"
                           "CELL_TYPES 1\n12\nCELL_DATA 1\nFIELD FieldData 1\ngroup 1 1 int\n1\n";
    CHECK(read_mesh(file).groups == std::vector<MeshGroup>{{3, 1, "bolt"}, {2, 7, "a face"}});
}

namespace {

/// A section of an Abaqus file: its keyword line and the words of its data lines.
struct Section {
    std::string keyword;
    std::vector<std::vector<std::string>> lines;
};

std::vector<Section> sections(const std::string& file) {
    std::vector<Section> result;
    std::ifstream in(file);
    for (std::string line; std::getline(in, line);) {
        if (line[0] == '*') {
            result.push_back({line, {}});
            continue;
        }
        std::istringstream words(line);
        result.back().lines.emplace_back();
        for (std::string word; std::getline(words, word, ',');) {
            result.back().lines.back().push_back(word.substr(word.find_first_not_of(' ')));
        }
    }
    return result;
}

const Section& section(const std::vector<Section>& all, const std::string& keyword) {
    const auto found = std::find_if(all.begin(), all.end(), [&](const Section& one) { return one.keyword == keyword; });
    REQUIRE(found != all.end());
    return *found;
}

/// Local nodes of the faces S1 ... S6 of C3D8, from the manual of Abaqus.
constexpr std::array<std::array<std::size_t, 4>, 6> abaqus_faces{
    {{1, 2, 3, 4}, {5, 8, 7, 6}, {1, 5, 6, 2}, {2, 6, 7, 3}, {3, 7, 8, 4}, {4, 8, 5, 1}}};

}  // namespace

TEST_CASE("Abaqus: sets of nodes, and surfaces of faces of hexahedra, for each group") {
    HexMeshData data;
    data.mesh = shapes::hex_box(3, 2, 2);
    for (std::size_t h = 0; h < data.mesh.hexes.size(); ++h) {
        data.hex_groups.push_back(h % 2 == 0 ? 2 : 1);  // elements are not in the order of hexahedra
        for (std::size_t f = 0; f < 6; ++f) {
            QuadCorners quad{};
            for (std::size_t k = 0; k < 4; ++k) {
                quad[k] = data.mesh.hexes[h][static_cast<std::size_t>(hex_faces[f][k])];
            }
            std::rotate(quad.begin(), quad.begin() + static_cast<std::ptrdiff_t>(h % 4), quad.end());
            data.quads.push_back(quad);  // those between hexahedra twice, out of either
            data.quad_groups.push_back(static_cast<int>(f) + 11);
        }
    }
    data.quads.push_back({0, 1, 2, 3});  // on no hexahedron
    data.quad_groups.push_back(20);
    data.groups = {{3, 1, "one"}, {3, 2, "two"}, {2, 11, "low"}, {2, 12, "1 high"}};
    const std::string file = scratch() / "sets.inp";
    write_mesh(file, data);
    const auto all = sections(file);

    std::map<std::string, HexCorners> hexes;  // by element number
    for (const char* name : {"one", "two"}) {
        std::set<Index> nodes;
        for (const auto& line : section(all, "*ELEMENT, TYPE=C3D8, ELSET=" + std::string(name)).lines) {
            for (std::size_t k = 0; k < 8; ++k) {
                hexes[line.at(0)][k] = static_cast<Index>(std::stoul(line.at(k + 1)) - 1);
            }
            nodes.insert(hexes[line.at(0)].begin(), hexes[line.at(0)].end());
        }
        std::vector<Index> listed;
        for (const auto& line : section(all, "*NSET, NSET=" + std::string(name)).lines) {
            CHECK(line.size() <= 16);
            for (const std::string& word : line) {
                listed.push_back(static_cast<Index>(std::stoul(word) - 1));
            }
        }
        CHECK(listed == std::vector<Index>(nodes.begin(), nodes.end()));
    }
    const std::map<int, std::string> labels{{11, "low"}, {12, "S_1_high"}, {13, "SURFACE_13"}, {16, "SURFACE_16"}};
    for (const auto& [number, label] : labels) {
        CAPTURE(label);
        std::vector<QuadCorners> quads;
        for (std::size_t q = 0; q < data.quads.size(); ++q) {
            if (data.quad_groups[q] == number) {
                quads.push_back(data.quads[q]);
            }
        }
        const Section& surface = section(all, "*SURFACE, TYPE=ELEMENT, NAME=" + label);
        REQUIRE(surface.lines.size() == quads.size());
        for (std::size_t q = 0; q < quads.size(); ++q) {
            const HexCorners& hex = hexes.at(surface.lines[q].at(0));
            QuadCorners face{};
            for (std::size_t k = 0; k < 4; ++k) {
                face[k] = hex[abaqus_faces.at(std::stoul(surface.lines[q].at(1).substr(1)) - 1)[k] - 1];
            }
            CHECK(surface.lines[q].at(1)[0] == 'S');
            // Abaqus counts the nodes of S1 from inside the hexahedron: the nodes are compared, the sense is S's own.
            CHECK(std::set<Index>(face.begin(), face.end()) == std::set<Index>(quads[q].begin(), quads[q].end()));
            CHECK(number - 10 ==
                  std::stoi(surface.lines[q].at(1).substr(1)));  // of the hexahedron that it looks out of
        }
        static_cast<void>(section(all, "*NSET, NSET=" + label));
        static_cast<void>(section(all, "*ELEMENT, TYPE=S4, ELSET=" + label));
    }
    CHECK(std::none_of(all.begin(), all.end(), [](const Section& one) {
        return one.keyword.find("*SURFACE") == 0 && one.keyword.find("SURFACE_20") != std::string::npos;
    }));
    const HexMeshData back = read_mesh(file);
    CHECK(back.mesh.hexes.size() == data.mesh.hexes.size());
    CHECK(names(back, 2).front() == "low");
}

TEST_CASE("a mesh without groups and quads survives too") {
    HexMeshData data = two_hexes();
    data.quads.clear();
    data.quad_groups.clear();
    data.hex_groups.clear();
    data.groups.clear();
    for (const char* name : {"b.vtu", "b.vtk", "b.msh", "b.inp"}) {
        const std::string file = scratch() / name;
        write_mesh(file, data);
        CHECK(read_mesh(file).mesh.hexes == data.mesh.hexes);
    }
}

TEST_CASE("a file appears whole or not at all") {
    const HexMeshData data = two_hexes();
    CHECK_THROWS_AS(write_mesh(scratch() / "no_such_directory" / "a.vtu", data), FileError);
    CHECK_THROWS_AS(write_mesh(scratch() / "a.stl", data), FileError);
    HexMeshData wrong = data;
    wrong.hex_groups.pop_back();
    fs::remove(scratch() / "c.vtu");
    CHECK_THROWS_AS(write_mesh(scratch() / "c.vtu", wrong), InputError);
    CHECK_FALSE(fs::exists(scratch() / "c.vtu"));
    for (const auto& entry : fs::directory_iterator(scratch())) {
        CHECK(entry.path().filename().string().find(".part") == std::string::npos);
    }
}

TEST_CASE("unreadable files are named") {
    CHECK_THROWS_WITH(read_mesh(scratch() / "missing.vtu"), Catch::Contains("missing.vtu"));
    CHECK_THROWS_AS(read_mesh(scratch()), FileError);
    for (const char* name : {"garbage.vtu", "garbage.vtk", "garbage.msh", "garbage.inp"}) {
        CAPTURE(name);
        write_text(scratch() / name, "this is not a mesh\n1 2 3\n");
        CHECK_THROWS_WITH(read_mesh(scratch() / name), Catch::Contains(name));
        write_text(scratch() / name, "");
        CHECK_THROWS_WITH(read_mesh(scratch() / name), Catch::Contains(name));
    }
    write_text(scratch() / "tet.inp", "*NODE\n1,0,0,0\n2,1,0,0\n3,0,1,0\n4,0,0,1\n*ELEMENT, TYPE=C3D4\n1,1,2,3,4\n");
    CHECK_THROWS_WITH(read_mesh(scratch() / "tet.inp"), Catch::Contains("C3D4"));
    write_text(scratch() / "id.inp", "*NODE\n1,0,0,0\n*ELEMENT, TYPE=C3D8\n1,1,2,3,4,5,6,7,8\n");
    CHECK_THROWS_WITH(read_mesh(scratch() / "id.inp"), Catch::Contains("node 2"));
}

TEST_CASE("files on which Gmsh crashes and VTK crashes or loops are refused, and nothing else happens") {
    write_text(scratch() / "seven.msh",
               "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n7\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n5 0 0 1\n6 1 0 2\n"
               "7 1 1 1\n8 0 1 1\n$EndNodes\n$Elements\n1\n1 5 2 1 1 1 2 3 4 5 6 7 8\n$EndElements\n");
    write_text(scratch() / "one_word.vtk",
               "# vtk DataFile Version 2.0\nhex\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 8 double\n"
               "0 0 0 1 0 0 1 1 0 0. 1 0 0 0 1 1 0 1 1 1 1 0 1 1\nCELLS1 2 3 4 5 6 7\nCELL_TYPES 1\n37\n");
    write_text(scratch() / "no_components.vtu",
               "<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" byte_order=\"LittleEndian\"><UnstructuredGrid>"
               "<Piece NumberOfPoints=\"8\" NumberOfCells=\"1\"><Points><DataArray type=\"Float64\" "
               "NumberOfComponents=\" \" format=\"ascii\">0 0 0 1 0 0 1 1 0 0 1 0 0 0 1 1 0 1 1 1 1 0 1 1</DataArray>"
               "</Points><Cells><DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">0 1 2 3 4 5 6 7"
               "</DataArray><DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">8</DataArray>"
               "<DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">13</DataArray></Cells></Piece>"
               "</UnstructuredGrid></VTKFile>");
    for (const char* name : {"seven.msh", "one_word.vtk", "no_components.vtu"}) {
        CAPTURE(name);
        CHECK_THROWS_WITH(read_mesh(scratch() / name), Catch::Contains(name));
    }
}

TEST_CASE("any hexahedral mesh is written, without groups") {
    const HexMesh box = shapes::hex_box(2, 1, 2);  // halves are floats
    for (const char* name : {"any.vtu", "any.msh", "any.inp"}) {
        CAPTURE(name);
        const std::string file = scratch() / name;
        write_mesh(file, archetype::Hexes(box));
        const HexMeshData back = read_mesh(file);
        CHECK(back.mesh.nodes == box.nodes);
        CHECK(back.mesh.hexes == box.hexes);
        CHECK(back.quads.empty());
    }
    const std::vector<std::array<int, 8>> cells{{0, 1, 2, 3, 4, 5, 6, 7}};
    const std::array<std::array<double, 3>, 8> points{
        {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}};
    write_mesh(scratch() / "view.vtk", HexMeshView{points, cells});
    CHECK(read_mesh(scratch() / "view.vtk").mesh.nodes[6] == Vec3(1, 1, 1));
}

TEST_CASE("Abaqus: labels are whole numbers of up to nine digits, however far apart") {
    const std::string nodes =
        "*NODE\n1,0,0,0\n2,1,0,0\n3,1,1,0\n4,0,1,0\n5,0,0,1\n6,1,0,1\n20000000,1,1,1\n999999999,0,1,1\n";
    const std::string file = scratch() / "labels.inp";
    write_text(file, nodes + "*ELEMENT, TYPE=C3D8\n1, 1,2,3,4,5,6,20000000,999999999\n");
    CHECK(read_mesh(file).mesh.hexes == std::vector<HexCorners>{{0, 1, 2, 3, 4, 5, 6, 7}});
    for (const std::string label : {"-2", "0", "1.5", "nan", "1e300", "1000000000"}) {
        CAPTURE(label);
        write_text(file, nodes + label + ",0,0,2\n");
        CHECK_THROWS_WITH(read_mesh(file), Catch::Contains("line 10") && Catch::Contains("label"));
        write_text(file, nodes + "*ELEMENT, TYPE=C3D8\n1, 1,2,3,4,5,6,20000000," + label + "\n");
        CHECK_THROWS_WITH(read_mesh(file), Catch::Contains("line 11") && Catch::Contains("label"));
    }
    write_text(file, nodes + "*ELEMENT, TYPE=C3D8\n1, 1,2,3,4,5,6,20000000,888888888\n");
    CHECK_THROWS_WITH(read_mesh(file), Catch::Contains("node 888888888 does not exist"));
}
