#include "support/catch.hpp"

#include <pavior/core/error.hpp>
#include <pavior/io/surface_file.hpp>

#include <Eigen/Geometry>

#include <unistd.h>
#include <array>
#include <bit>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <string>
#include <vector>

using namespace pavior;

namespace {

/// A file in a directory of this test, removed at the end.
class Scratch {
public:
    Scratch(const std::string& name, const std::string& text)
        : directory_(std::filesystem::temp_directory_path() /
                     ("pavior_surface_" + std::to_string(getpid()) + "_" + std::to_string(counter_++))),
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

TaggedSurface read(const std::string& name, const std::string& text, const SurfaceReadOptions& options = {}) {
    const Scratch scratch(name, text);
    return read_surface(scratch.file(), options);
}

/// What the FileError says after the name of the file.
std::string refusal(const std::string& name, const std::string& text) {
    const Scratch scratch(name, text);
    try {
        static_cast<void>(read_surface(scratch.file()));
    } catch (const FileError& error) {
        CHECK(error.file() == scratch.file());
        const std::string what = error.what();
        const std::size_t at = what.find(scratch.file());
        return what.substr(at + scratch.file().size() + 2);
    }
    return "nothing";
}

const std::vector<Vec3> corners{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0.1}};
const std::vector<TriCorners> faces{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};

std::string number(double x) {
    std::array<char, 40> text{};
    std::snprintf(text.data(), text.size(), "%.17g", x);
    return text.data();
}

std::string ascii_stl(const std::vector<std::size_t>& solid_sizes = {4}) {
    std::string text;
    std::size_t f = 0;
    for (const std::size_t size : solid_sizes) {
        text += "solid part " + std::to_string(f) + "\n";
        for (const std::size_t end = f + size; f < end; ++f) {
            text += "  facet normal 0 0 0\n    outer loop\n";
            for (const Index i : faces[f]) {
                text += "      vertex " + number(corners[i].x()) + " " + number(corners[i].y()) + " " +
                        number(corners[i].z()) + "\n";
            }
            text += "    endloop\n  endfacet\n";
        }
        text += "endsolid\n";
    }
    return text;
}

void append_bits(std::string& text, std::uint64_t bits, int bytes, bool little = true) {
    for (int i = 0; i < bytes; ++i) {
        const int byte = little ? i : bytes - 1 - i;
        text += static_cast<char>(bits >> (8 * byte) & 0xFFU);
    }
}

std::string binary_stl(const std::string& header = "solid trap") {
    std::string text = header;
    text.resize(80, ' ');
    append_bits(text, faces.size(), 4);
    for (const TriCorners& face : faces) {
        text.append(12, '\0');
        for (const Index i : face) {
            for (const double x : corners[i]) {
                append_bits(text, std::bit_cast<std::uint32_t>(static_cast<float>(x)), 4);
            }
        }
        append_bits(text, 0xABCD, 2);
    }
    return text;
}

/// Vertices as doubles with a colour between, faces behind another list, edges at the end.
std::string binary_ply(bool little) {
    std::string text = std::string("ply\nformat ") + (little ? "binary_little_endian" : "binary_big_endian") +
                       " 1.0\ncomment made by hand\nelement vertex 4\nproperty double x\nproperty uchar red\n"
                       "property double y\nproperty double z\nelement face 4\nproperty list uint8 float quality\n"
                       "property list uchar int vertex_indices\nelement edge 1\nproperty int a\nend_header\n";
    for (const Vec3& x : corners) {
        append_bits(text, std::bit_cast<std::uint64_t>(x.x()), 8, little);
        append_bits(text, 10, 1);  // a byte that looks like an end of line
        append_bits(text, std::bit_cast<std::uint64_t>(x.y()), 8, little);
        append_bits(text, std::bit_cast<std::uint64_t>(x.z()), 8, little);
    }
    for (const TriCorners& face : faces) {
        append_bits(text, 1, 1);
        append_bits(text, std::bit_cast<std::uint32_t>(0.5F), 4, little);
        append_bits(text, 3, 1);
        for (const Index i : face) {
            append_bits(text, i, 4, little);
        }
    }
    append_bits(text, 7, 4, little);
    return text;
}

std::vector<std::vector<Vec3>> geometry(const TaggedSurface& surface) {
    std::vector<std::vector<Vec3>> result;
    for (const TriCorners& c : surface.mesh.triangles) {
        result.push_back({surface.mesh.nodes.at(c[0]), surface.mesh.nodes.at(c[1]), surface.mesh.nodes.at(c[2])});
    }
    return result;
}

void check_tetrahedron(const TaggedSurface& surface, bool floats = false) {
    REQUIRE(surface.mesh.nodes.size() == 4);
    REQUIRE(surface.mesh.triangles.size() == 4);
    const auto triangles = geometry(surface);
    for (std::size_t f = 0; f < 4; ++f) {
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3& x = corners[faces[f][k]];
            CHECK(triangles[f][k] == (floats ? Vec3(x.cast<float>().cast<double>()) : x));
        }
    }
}

}  // namespace

TEST_CASE("ASCII STL: all digits, welded, solids as tags") {
    const TaggedSurface one = read("a.stl", ascii_stl());
    check_tetrahedron(one);
    CHECK(one.face_tags.empty());
    const TaggedSurface two = read("a.STL", ascii_stl({1, 3}));
    check_tetrahedron(two);
    CHECK(two.face_tags == std::vector<std::int32_t>{1, 2, 2, 2});
    SurfaceReadOptions apart;
    apart.weld_distance = -1.0;
    CHECK(read("a.stl", ascii_stl(), apart).mesh.nodes.size() == 12);
}

TEST_CASE("Solids of STL files and groups of OBJ files give their names to their tags") {
    const auto facet = [](const char* x) {
        return std::string("facet normal 0 0 1\nouter loop\nvertex 0 0 ")
            .append(x)
            .append("\nvertex 1 0 ")
            .append(x)
            .append("\nvertex 0 1 ")
            .append(x)
            .append("\nendloop\nendfacet\n");
    };
    using Names = std::map<std::int32_t, std::string>;
    const std::string two = "solid  wall \"a b\" \r\n" + facet("0") + "endsolid\nsolid\n" + facet("1") +
                            "endsolid\nSOLID wall\n" + facet("2") + "endsolid wall\n";
    CHECK(read("named.stl", two).face_names == Names{{1, "wall \"a b\""}, {3, "wall"}});
    CHECK(read("one.stl", "solid bolt\n" + facet("0") + "endsolid bolt\n").face_names.empty());  // no tags
    const std::string points = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";
    CHECK(read("named.obj", points + "g top side\nf 1 2 3\ng none\ng low\nf 1 2 4\ng top side\nf 2 3 4\n").face_names ==
          Names{{1, "top side"}, {2, "low"}});
    CHECK(read("objects.obj", points + "o a\nf 1 2 3\no b\nf 1 2 4\n").face_names == Names{{1, "a"}, {2, "b"}});
    CHECK(read("none.obj", points + "f 1 2 3\n").face_names.empty());
    const TaggedSurface six = read_surface(std::string(PAVIOR_TEST_DATA).append("/faults/stl_six_named_patches.stl"));
    CHECK(six.face_names == Names{{1, "bottom"}, {2, "top"}, {3, "s1"}, {4, "s2"}, {5, "s3"}, {6, "s4"}});
}

TEST_CASE("ASCII STL in any case of letters, also behind a byte-order mark") {
    std::string text = ascii_stl();
    text[0] = 'S';
    check_tetrahedron(read("a.stl", text), false);
    check_tetrahedron(read("a.stl", "\xEF\xBB\xBF" + ascii_stl()), false);
    text.replace(0, 5, "sOLid");
    check_tetrahedron(read("a.stl", " \n" + text), false);
}

TEST_CASE("Binary STL, also one that begins with solid") {
    check_tetrahedron(read("b.stl", binary_stl()), true);
    check_tetrahedron(read("b.stl", binary_stl("made by hand")), true);
    check_tetrahedron(read("b.stl", binary_stl() + "trailing bytes"), true);
}

TEST_CASE("Broken STL files name the place") {
    CHECK(refusal("a.stl", "") == "empty");
    CHECK(refusal("a.stl", "hello") ==
          "is no STL file: neither does it begin with 'solid' nor is it long enough for a header");
    CHECK(refusal("a.stl", binary_stl().substr(0, 200)) == "holds 2 of the 4 triangles that its header promises");
    std::string nan = binary_stl();
    nan.replace(84 + 50 + 12, 4, "\xFF\xFF\xFF\xFF");
    CHECK(refusal("a.stl", nan) == "triangle 1 has a coordinate that is not finite");
    const std::string text = ascii_stl();
    CHECK(refusal("a.stl", text.substr(0, text.size() - 9)) == "line 29: the file ends before 'endsolid'");
    CHECK(refusal("a.stl", text.substr(0, 60)).substr(0, 8) == "line 4: ");
    std::string word = text;
    word.replace(word.find("vertex 0"), 8, "vertex x");
    CHECK(refusal("a.stl", word) == "line 4: x is no finite number: 'x'");
    word = text;
    word.replace(word.find("vertex 0"), 8, "vertex nan");
    CHECK(refusal("a.stl", word) == "line 4: x is no finite number: 'nan'");
    word = text;
    word.replace(word.find("endloop"), 7, "vertex ");
    CHECK(refusal("a.stl", word) == "line 7: expected 'endloop', not 'vertex'");
    CHECK(refusal("a.stl", "solid empty\nendsolid\n") == "holds no triangles");
}

TEST_CASE("OBJ: groups, slashes, negative ids, polygons, unused nodes") {
    const std::string text =
        "# a cube with quads and a spare vertex\r\nmtllib none.mtl\nv 0 0 0\nv 1 0 0 1.0\nv 1 1 0\nv 0 1 0\nv 9 9 9\n"
        "v 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\nvt 0 0\nvn 0 0 1\n"
        "g bottom\nf 1/1 4/1/1 3//1 2\ng top lid\nf -4 -3 \\\n -2 -1\ng\nf 1 2 7 6\nf 2 3 8 7\ng bottom\nf 3 4 9 8\n"
        "l 1 2\nf 4 1 6 9\n";
    const TaggedSurface cube = read("c.obj", text);
    CHECK(cube.mesh.nodes.size() == 8);
    CHECK(cube.mesh.triangles.size() == 12);
    CHECK(cube.face_tags == std::vector<std::int32_t>{1, 1, 2, 2, 3, 3, 3, 3, 1, 1, 1, 1});
    double volume = 0.0;
    for (const auto& x : geometry(cube)) {
        volume += x[0].cross(x[1]).dot(x[2]) / 6.0;
    }
    CHECK(volume == Approx(1.0));
    const TaggedSurface objects = read("d.obj", "o a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\no b\nf 3 2 1\n");
    CHECK(objects.face_tags == std::vector<std::int32_t>{1, 2});
    CHECK(read("e.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").face_tags.empty());
}

TEST_CASE("Broken OBJ files name the line") {
    const std::string start = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    CHECK(refusal("a.obj", start + "f 1 2 4\n") == "line 4: vertex 4 does not exist (here)");
    CHECK(refusal("a.obj", start + "f 0 1 2\n") == "line 4: vertex 0 does not exist (here)");
    CHECK(refusal("a.obj", start + "f 1 2 -4\n") == "line 4: vertex -4 does not exist (here)");
    CHECK(refusal("a.obj", start + "f 1 2\n") == "line 4: a face with less than three corners");
    CHECK(refusal("a.obj", start + "f 1 2 a/b\n") == "line 4: 'a/b' is no corner of a face");
    CHECK(refusal("a.obj", "v 0 inf 0\n") == "line 1: y is no finite number: 'inf'");
    CHECK(refusal("a.obj", "v 0 0\n") == "line 1: z is missing");
    CHECK(refusal("a.obj", start) == "holds no triangles");
}

TEST_CASE("OFF: counts here or there, comments, colours") {
    const std::string body =
        "0 0 0\n1 0 0 255 0 0\n# between\n0 1 0\n\n0 0 0.1\n3 0 2 1\n3 0 1 3 0.5 0.5 0.5\n3 1 2 3\n3 2 0 3\n";
    check_tetrahedron(read("a.off", "OFF\n# comment\n4 4 6\n" + body));
    check_tetrahedron(read("a.off", "COFF 4 4 0\n" + body));
    check_tetrahedron(read("a.off", "4 4 0\n" + body));
    CHECK(refusal("a.off", "OFF\n4 5 0\n" + body) == "line 12: the file ends before face 4");
    CHECK(refusal("a.off", "OFF\n9 4 0\n" + body) == "line 12: the file ends before vertex 8");
    CHECK(refusal("a.off", "PLY\n") == "line 1: expected 'OFF', not 'PLY'");
    CHECK(refusal("a.off", "OFF BINARY\n") == "line 1: binary OFF files cannot be read");
    CHECK(refusal("a.off", "OFF\n-1 4 0\n") == "line 2: impossible numbers of vertices and faces");
    CHECK(refusal("a.off", "OFF\n999999999999 4 0\n") == "line 2: impossible numbers of vertices and faces");
    CHECK(refusal("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n") ==
          "line 6: face 0 names vertex 3, which does not exist");
    CHECK(refusal("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n2 0 1\n") == "line 6: face 0 with 2 corners");
}

TEST_CASE("PLY: ASCII and both byte orders, doubles kept") {
    check_tetrahedron(
        read("a.ply",
             "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
             "property float z\nproperty uchar red\nelement face 4\nproperty list uchar int vertex_index\n"
             "end_header\n0 0 0 255\n1 0 0 255\n0 1 0 255\n0 0 0.1 255\n"
             "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n"));
    check_tetrahedron(read("a.ply", binary_ply(true)));
    check_tetrahedron(read("a.ply", binary_ply(false)));
}

TEST_CASE("PLY: elements without properties take no room and no time, however many there are said to be") {
    const std::string head = "ply\nformat binary_little_endian 1.0\nelement nothing 7777777777777777\n";
    CHECK_THROWS_AS(read("empty.ply", head + "element vertex 0\nproperty float x\nend_header\n"), FileError);
    CHECK_THROWS_AS(read("more.ply", head + "element vertex 7777777777777777\nend_header\n"), FileError);
}

TEST_CASE("Broken PLY files name the element") {
    CHECK(refusal("a.ply", "OFF\n") == "line 1: is no PLY file: it does not begin with 'ply'");
    CHECK(refusal("a.ply", "ply\nformat ascii 1.0\n") == "line 2: the file ends within its header");
    CHECK(refusal("a.ply", "ply\nformat bits 1.0\nend_header\n") == "line 3: unknown format 'bits'");
    CHECK(refusal("a.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty real x\nend_header\n") ==
          "line 4: unknown type 'real'");
    const std::string good = binary_ply(true);
    CHECK(refusal("a.ply", good.substr(0, good.size() - 5)) == "face 3: the file ends within it");
    std::string bad = good;
    bad[good.size() - 4 - 4] = 9;  // the last corner
    CHECK(refusal("a.ply", bad) == "face 3: names a vertex that does not exist");
    CHECK(refusal("a.ply",
                  "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nend_header\n0 0\n") ==
          "vertex 0: a coordinate is missing or not finite");
}

TEST_CASE("Polygons that are not convex are cut inside") {
    // An L and a comb; the fan from the first corner would run outside.
    const TaggedSurface l = read("l.off", "OFF\n6 1 0\n2 0 0\n2 1 0\n1 1 0\n1 2 0\n0 2 0\n0 0 0\n6 0 1 2 3 4 5\n");
    REQUIRE(l.mesh.triangles.size() == 4);
    double area = 0.0;
    for (const auto& x : geometry(l)) {
        const Vec3 part = (x[1] - x[0]).cross(x[2] - x[0]) / 2.0;
        CHECK(part.z() > 0.0);
        CHECK(part.head<2>().norm() == 0.0);
        area += part.z();
    }
    CHECK(area == Approx(3.0));
    std::string comb = "OFF\n14 1 0\n0 0 0\n7 0 0\n";
    for (int i = 6; i > 0; i -= 2) {
        comb += std::to_string(i + 1) + " 3 0\n" + std::to_string(i) + " 3 0\n" + std::to_string(i) + " 1 0\n" +
                std::to_string(i - 1) + " 1 0\n";
    }
    // The last gap is the tooth at x = 0..1, closed by hand.
    comb.replace(comb.find("14 1 0"), 6, "16 1 0");
    comb += "1 3 0\n0 3 0\n16 0 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15\n";
    const TaggedSurface teeth = read("comb.off", comb);
    CHECK(teeth.mesh.triangles.size() == 14);
    area = 0.0;
    for (const auto& x : geometry(teeth)) {
        const double part = (x[1] - x[0]).cross(x[2] - x[0]).z() / 2.0;
        CHECK(part > 0.0);
        area += part;
    }
    CHECK(area == Approx(7.0 + 4 * 2.0));
}

TEST_CASE("Welding within a distance drops what collapses") {
    const std::string text =
        "OFF\n7 5 0\n0 0 0\n1 0 0\n0 1 0\n0 0 0.1\n1e-5 0 0\n1 1e-5 0\n0 -0.0 0\n"
        "3 4 2 5\n3 0 1 3\n3 1 2 3\n3 2 6 3\n3 0 4 2\n";
    CHECK(read("w.off", text).mesh.nodes.size() == 6);  // 0 and -0 are one place
    CHECK(read("w.off", text).mesh.triangles.size() == 5);
    SurfaceReadOptions options;
    options.weld_distance = 1e-4;
    check_tetrahedron(read("w.off", text, options));
    options.weld_distance = std::numeric_limits<double>::quiet_NaN();
    CHECK_THROWS_AS(read("w.off", text, options), InputError);
}

TEST_CASE("Files that are none") {
    CHECK(can_read_surface("part.Ply"));
    CHECK_FALSE(can_read_surface("part.step"));
    CHECK_THROWS_WITH(read_surface("/nowhere/part.stl"), Catch::Contains("no such file"));
    CHECK_THROWS_WITH(read_surface("/nowhere/part.xyz"), Catch::Contains("unknown surface format"));
    const std::string directory = (std::filesystem::temp_directory_path() / "pavior_directory.stl").string();
    std::filesystem::create_directories(directory);
    CHECK_THROWS_WITH(read_surface(directory), Catch::Contains("is a directory"));
    std::filesystem::remove_all(directory);
}

TEST_CASE("The domains of the block tests") {
    const TaggedSurface gear = read_surface(std::string(PAVIOR_TEST_DATA) + "/block/c04_half_gear.off");
    CHECK(gear.mesh.nodes.size() == 344);
    CHECK(gear.mesh.triangles.size() == 684);
    CHECK(gear.face_tags.empty());
    CHECK(gear.edges.empty());
}
