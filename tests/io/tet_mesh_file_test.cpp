#include "support/catch.hpp"

#include <pavior/core/error.hpp>
#include <pavior/io/tet_mesh_file.hpp>

#include <Eigen/Geometry>

#include <unistd.h>
#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <string>
#include <vector>

using namespace pavior;

namespace {

/// A file in a directory of this test, removed at the end.
class Scratch {
public:
    Scratch(const std::string& name, const std::string& text)
        : directory_(std::filesystem::temp_directory_path() /
                     ("pavior_tets_" + std::to_string(getpid()) + "_" + std::to_string(counter_++))),
          file_((directory_ / name).string()) {
        std::filesystem::create_directories(directory_);
        std::ofstream(file_, std::ios::binary) << text;
    }
    Scratch(const Scratch&) = delete;
    Scratch& operator=(const Scratch&) = delete;
    ~Scratch() { std::filesystem::remove_all(directory_); }
    [[nodiscard]] const std::string& file() const { return file_; }

private:
    inline static int counter_ = 0;
    std::filesystem::path directory_;
    std::string file_;
};

TetMeshData read(const std::string& name, const std::string& text) {
    const Scratch scratch(name, text);
    return read_tet_mesh_data(scratch.file());
}

std::string refusal(const std::string& name, const std::string& text) {
    const Scratch scratch(name, text);
    try {
        static_cast<void>(read_tet_mesh_data(scratch.file()));
    } catch (const FileError& error) {
        const std::string what = error.what();
        return what.substr(what.find(scratch.file()) + scratch.file().size() + 2);
    }
    return "nothing";
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    text.replace(text.find(from), from.size(), to);
    return text;
}

// Two tetrahedra on a common face, the second one negative; a node of none; a wall on the common face, a boundary
// triangle against the outside, a bent line, a point.
const std::string points = "0 0 0 1 0 0 0 1 0 7 7 7 0 0 1 0.5 0.5 -1";
const std::string legacy =
    "# vtk DataFile Version 3.0\ntest\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 6 double\n" + points +
    "\nCELLS 6 24\n4 0 1 2 4\n4 0 1 2 5\n3 2 1 0\n3 0 1 4\n3 0 1 2\n1 4\nCELL_TYPES 6\n10\n10\n5\n5\n4\n1\n"
    "CELL_DATA 6\nSCALARS color int 1\nLOOKUP_TABLE default\n31\n32\n-1\n5\n8\n9\n";
const std::string xml =
    "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
    "<UnstructuredGrid><Piece NumberOfPoints=\"6\" NumberOfCells=\"6\"><Points>\n"
    "<DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">" +
    points +
    "</DataArray></Points><Cells>\n<DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">"
    "0 1 2 4 0 1 2 5 2 1 0 0 1 4 0 1 2 4</DataArray>\n"
    "<DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">4 8 11 14 17 18</DataArray>\n"
    "<DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">10 10 5 5 4 1</DataArray></Cells>\n"
    "<CellData><DataArray type=\"Float32\" Name=\"tag\" format=\"ascii\">31 32 -1 5 8 9</DataArray></CellData>\n"
    "</Piece></UnstructuredGrid></VTKFile>\n";
const std::string msh =
    "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n6\n10 0 0 0\n20 1 0 0\n30 0 1 0\n35 7 7 7\n40 0 0 1\n"
    "50 0.5 0.5 -1\n$EndNodes\n$Elements\n7\n1 4 2 31 1 10 20 30 40\n2 4 2 32 2 10 20 30 50\n3 2 2 -1 3 30 20 10\n"
    "4 2 2 5 4 10 20 40\n5 1 2 8 5 10 20\n6 1 2 8 5 20 30\n7 15 2 9 6 40\n$EndElements\n";

void check_two(const TetMeshData& data, std::int32_t wall_tag = -1) {
    const TaggedTetMesh& mesh = data.tets;
    REQUIRE(mesh.mesh.nodes.size() == 5);
    CHECK(mesh.mesh.nodes[3] == Vec3(0, 0, 1));
    CHECK((mesh.mesh.tets == std::vector<TetCorners>{{0, 1, 2, 3}, {0, 1, 4, 2}}));
    CHECK((data.tet_tags == std::vector<std::int32_t>{31, 32}));
    CHECK((data.walls == std::vector<TaggedTriangle>{{{2, 1, 0}, wall_tag}}));
    CHECK((mesh.edges == std::vector<TaggedEdge>{{{0, 1}, 8}, {{1, 2}, 8}}));
    CHECK((mesh.vertices == std::vector<TaggedNode>{{3, 9}}));
    REQUIRE(mesh.triangles.size() == 6);
    const Vec3 middle(0.3, 0.3, 0.0);
    for (const TaggedTriangle& t : mesh.triangles) {
        const Vec3& x = mesh.mesh.nodes[t.nodes[0]];
        CHECK((mesh.mesh.nodes[t.nodes[1]] - x).cross(mesh.mesh.nodes[t.nodes[2]] - x).dot(x - middle) > 0.0);
        TriCorners sorted = t.nodes;
        std::sort(sorted.begin(), sorted.end());
        CHECK(t.tag == (sorted == TriCorners{0, 1, 3} ? 5 : 0));
    }
}

}  // namespace

TEST_CASE("Legacy and XML files of VTK") {
    check_two(read("a.vtk", legacy));
    check_two(read("a.VTU", xml));
    const Scratch scratch("a.vtk", legacy);
    CHECK(read_tet_mesh(scratch.file()).triangles.size() == 6);
}

TEST_CASE("Files of Gmsh: physical groups are tags") {
    check_two(read("a.msh", replaced(msh, "2 2 -1 3", "2 2 77 3")), 77);
    // Without physical groups the entities are.
    std::string plain = msh;
    plain = replaced(plain, "4 2 31 1", "4 2 0 1");
    plain = replaced(plain, "4 2 32 2", "4 2 0 2");
    CHECK((read("a.msh", plain).tet_tags == std::vector<std::int32_t>{1, 2}));
}

TEST_CASE("Published tetrahedra with features") {
    struct Expected {
        std::string name;
        std::size_t nodes, tets, boundary, lines, points, walls, blocks;
    };
    const std::vector<Expected> list{{"s01c_cube", 482, 1200, 946, 96, 8, 0, 1},
                                     {"s02c_prism", 487, 1279, 914, 83, 6, 116, 3},
                                     {"s07c_notch", 1069, 2943, 1972, 166, 12, 489, 10},
                                     {"n09c_pyramid", 2318, 7688, 3554, 170, 5, 2059, 26},
                                     {"s11c_cube_cyl", 1799, 5224, 3138, 216, 10, 1307, 24}};
    for (const Expected& e : list) {
        CAPTURE(e.name);
        std::string path(PAVIOR_EXAMPLE_DATA);
        path.append("/mc3d/hexme_").append(e.name).append("_MC.vtk");
        const TetMeshData data = read_tet_mesh_data(path);
        CHECK(data.tets.mesh.nodes.size() == e.nodes);
        CHECK(data.tets.mesh.tets.size() == e.tets);
        CHECK(data.tets.triangles.size() == e.boundary);
        CHECK(data.tets.edges.size() == e.lines);
        CHECK(data.tets.vertices.size() == e.points);
        CHECK(data.walls.size() == e.walls);
        const std::set<std::int32_t> blocks(data.tet_tags.begin(), data.tet_tags.end());
        CHECK(blocks.size() == e.blocks);
        double volume = 0.0;
        for (const TetCorners& c : data.tets.mesh.tets) {
            const auto& x = data.tets.mesh.nodes;
            const double six = (x[c[1]] - x[c[0]]).cross(x[c[2]] - x[c[0]]).dot(x[c[3]] - x[c[0]]);
            REQUIRE(six > 0.0);
            volume += six / 6.0;
        }
        // The same volume from the boundary: it is closed and points outward.
        double flux = 0.0;
        for (const TaggedTriangle& t : data.tets.triangles) {
            const auto& x = data.tets.mesh.nodes;
            flux += x[t.nodes[0]].cross(x[t.nodes[1]]).dot(x[t.nodes[2]]) / 6.0;
        }
        CHECK(flux == Approx(volume).epsilon(1e-12));
    }
}

TEST_CASE("Broken files name the cell") {
    CHECK(refusal("a.vtk", replaced(legacy, "4 0 1 2 5", "4 0 1 2 2")) == "cell 1 names a node twice");
    CHECK(refusal("a.vtk", replaced(legacy, "3 0 1 4", "3 0 4 5")) ==
          "cell 3 is a triangle that is no face of a tetrahedron");
    CHECK(refusal("a.vtk", replaced(legacy, "3 0 1 2\n1", "3 0 4 5\n1")) ==
          "cell 4 is a line that is no edge of a tetrahedron");
    CHECK(refusal("a.vtk", replaced(legacy, "1 4\nCELL", "1 3\nCELL")) ==
          "cell 5 is a point that is no node of a tetrahedron");
    CHECK(refusal("a.vtk", replaced(legacy, "\n10\n10", "\n10\n9")) ==
          "cell 1 is of VTK type 9, neither tetrahedron nor triangle, line or vertex");
    CHECK(refusal("a.vtk", replaced(legacy, "0.5 0.5 -1", "0.5 0.5 0")) == "cell 1 is a tetrahedron without volume");
    CHECK(refusal("a.vtk", replaced(legacy, "0.5 0.5 -1", "0.5 0.5 nan")) != "nothing");
    CHECK(refusal("a.msh", replaced(msh, "10 20 30 50", "10 20 30 60")) != "nothing");
    CHECK(refusal("a.msh", replaced(msh, "7\n1 4 2", "8\n8 5 2 1 1 10 20 30 40 10 20 30 50\n1 4 2"))
              .find("holds elements of Gmsh type 5") == 0);
    CHECK(refusal("a.msh", "nonsense") != "nothing");
    CHECK(refusal("a.vtk", "nonsense").find("VTK cannot read it") == 0);
    CHECK(refusal("a.vtu", "nonsense").find("VTK cannot read it") == 0);
}

TEST_CASE("Three tetrahedra on one face are refused") {
    const std::string text =
        "# vtk DataFile Version 3.0\ntest\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 6 double\n"
        "0 0 0 1 0 0 0 1 0 0 0 1 0 0 2 0.5 0.5 -1\nCELLS 3 15\n4 0 1 2 3\n4 0 1 2 4\n4 0 1 2 5\n"
        "CELL_TYPES 3\n10\n10\n10\n";
    CHECK(refusal("a.vtk", text) == "a face of more than two tetrahedra");
}

TEST_CASE("Files that hold no tetrahedra") {
    CHECK(can_read_tet_mesh("a.Msh"));
    CHECK_FALSE(can_read_tet_mesh("a.stl"));
    CHECK_THROWS_WITH(read_tet_mesh("/nowhere/a.vtk"), Catch::Contains("no such file"));
    CHECK_THROWS_WITH(read_tet_mesh("/nowhere/a.inp"), Catch::Contains("unknown format"));
    const std::string empty =
        "# vtk DataFile Version 3.0\ntest\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 3 double\n0 0 0 1 0 0 0 1 0\n"
        "CELLS 1 4\n3 0 1 2\nCELL_TYPES 1\n5\n";
    CHECK(refusal("a.vtk", empty) == "holds no tetrahedra");
    CHECK(refusal("a.vtk", empty.substr(0, empty.find("POINTS")) + "POINTS 0 double\n").find("holds no points") !=
          std::string::npos);
}

TEST_CASE("A file of fewer nodes than it says, on which Gmsh crashes, is refused") {
    CHECK_FALSE(refusal("three.msh",
                        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n3\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n"
                        "$EndNodes\n$Elements\n1\n1 4 2 1 1 1 2 3 4\n$EndElements\n")
                    .empty());
}
