// What `pavior block` makes of surfaces that are wrong, doubtful or of odd size: one table.
#include "support/catch.hpp"
#include "support/program.hpp"

#include <pavior/io/mesh_file.hpp>
#include <pavior/mesh/tagged_mesh.hpp>
#include <pavior/mesh/verify_hexes.hpp>

#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

using namespace pavior;
using namespace pavior::test;

namespace {

/// Nodes and triangles, closed or not.
struct Surface {
    std::vector<Vec3> nodes;
    std::vector<TriCorners> triangles;
};

Surface box(const Vec3& low = Vec3::Zero(), const Vec3& high = Vec3(3, 2, 1)) {
    Surface s;
    for (unsigned i = 0; i < 8; ++i) {
        s.nodes.emplace_back((i & 1U) != 0 ? high.x() : low.x(), (i & 2U) != 0 ? high.y() : low.y(),
                             (i & 4U) != 0 ? high.z() : low.z());
    }
    constexpr std::array<std::array<Index, 4>, 6> faces{
        {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {1, 3, 7, 5}, {3, 2, 6, 7}, {2, 0, 4, 6}}};
    for (const auto& [a, b, c, d] : faces) {
        s.triangles.push_back({a, b, c});
        s.triangles.push_back({a, c, d});
    }
    return s;
}

/// Both, each with nodes of its own.
Surface operator+(Surface a, const Surface& b) {
    const auto first = static_cast<Index>(a.nodes.size());
    a.nodes.insert(a.nodes.end(), b.nodes.begin(), b.nodes.end());
    for (const TriCorners& c : b.triangles) {
        a.triangles.push_back({c[0] + first, c[1] + first, c[2] + first});
    }
    return a;
}

Surface turned(Surface s) {
    for (TriCorners& c : s.triangles) {
        std::swap(c[1], c[2]);
    }
    return s;
}

Surface with(Surface s, const TriCorners& triangle) {
    s.triangles.push_back(triangle);
    return s;
}

Surface with_node(Surface s, const Vec3& x) {
    s.nodes.push_back(x);
    return s;
}

Surface moved(Surface s, double scale, const Vec3& by) {
    for (Vec3& x : s.nodes) {
        x = scale * x + by;
    }
    return s;
}

/// Three nodes for each triangle, as an STL file has them.
Surface soup(const Surface& s) {
    Surface out;
    for (const TriCorners& c : s.triangles) {
        const auto first = static_cast<Index>(out.nodes.size());
        for (const Index i : c) {
            out.nodes.push_back(s.nodes[i]);
        }
        out.triangles.push_back({first, first + 1, first + 2});
    }
    return out;
}

Surface with_first_node(Surface s, double x) {
    s.nodes[0].x() = x;
    return s;
}

Surface without_last(Surface s) {
    s.triangles.pop_back();
    return s;
}

Surface first_turned(Surface s) {
    std::swap(s.triangles[0][1], s.triangles[0][2]);
    return s;
}

/// An input, the exit code, and what the message must contain; blocks where there is none.
struct Row {
    std::string name;
    Surface surface;
    int code;
    std::string message;
    std::size_t blocks = 0;
};

std::vector<Row> rows() {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double infinity = std::numeric_limits<double>::infinity();
    const Surface cavity = box(Vec3(1, 0.5, 0.25), Vec3(2, 1.5, 0.75));
    return {
        {"a box", box(), 0, "", 8},
        {"open: one triangle missing", without_last(box()), 2, "open_surface: 3 edges"},
        {"open: a fin on an edge", with(with_node(box(), Vec3(1.5, 1, 3)), {4, 7, 8}), 2, "open_surface: 2 edges"},
        {"two boxes that cross", box() + box(Vec3(1, 1, 0.5), Vec3(4, 3, 2)), 2, "self_intersection: 13 pairs"},
        {"a box against the middle of a face", box() + box(Vec3(3, 0.5, 0.2), Vec3(4, 1.5, 0.8)), 2,
         "self_intersection"},
        {"inside out", turned(box()), 2, "bad_orientation: 1 shells turned inside out: triangle 0"},
        {"one triangle turned", first_turned(box()), 2, "bad_orientation: 3 edges"},
        {"a cavity", box() + turned(cavity), 0, "", 208},
        {"a cavity that is turned outwards", box() + cavity, 2, "bad_orientation: 1 shells turned inside out"},
        {"two solids", box() + box(Vec3(5, 0, 0), Vec3(6, 1, 1)), 0, "", 16},
        {"a triangle twice", with(box(), {0, 2, 3}), 2, "non_manifold: 1 triangles on the same nodes"},
        {"the whole surface twice", box() + box(), 2, "non_manifold: 12 triangles on the same nodes"},
        {"nodes of each triangle its own", soup(box()), 0, "", 8},
        {"a triangle on two nodes", with(box(), {0, 0, 1}), 0, "", 8},
        {"a triangle whose nodes lie on a line", with(with_node(box(), Vec3(1.5, 0, 0)), {0, 8, 1}), 2,
         "degenerate_triangle: 1 triangles without area: triangle 12"},
        {"two triangles back to back", {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 1}}}, 2, "non_manifold"},
        {"two boxes that touch at an edge", box() + box(Vec3(3, 2, 0), Vec3(4, 3, 1)), 2,
         "non_manifold: 1 edges of more than two triangles"},
        {"two boxes that touch at a vertex", box() + box(Vec3(3, 2, 1), Vec3(4, 3, 2)), 2,
         "non_manifold: 1 nodes where two parts of the surface touch"},
        {"two boxes that touch at a face", box() + box(Vec3(3, 0, 0), Vec3(4, 2, 1)), 2, "non_manifold: 4 edges"},
        {"nothing", {}, 2, "holds no triangles"},
        {"nodes alone", {box().nodes, {}}, 2, "holds no triangles"},
        {"a node that does not exist", with(box(), {0, 1, 99}), 2, "face 12 names vertex 99"},
        {"NaN", with_first_node(box(), nan), 2, "line 3: x is no finite number"},
        {"infinite", with_first_node(box(), infinity), 2, "line 3: x is no finite number"},
        {"1e9 away", moved(box(), 1.0, Vec3(1e9, -1e9, 1e9)), 0, "", 8},
        {"size 1e9", moved(box(), 1e9, Vec3::Zero()), 0, "", 8},
        {"size 1e-9", moved(box(), 1e-9, Vec3::Zero()), 0, "", 8},
        {"size 1e-9, 1e9 away: all nodes round to two", moved(box(), 1e-9, Vec3(1e9, 0, 0)), 2, "self_intersection"},
        {"size 1e160", moved(box(), 1e160, Vec3::Zero()), 2, "overflow: the longest edge of the boundary"},
        {"size 1e-160", moved(box(), 1e-160, Vec3::Zero()), 2, "overflow: the longest edge of the boundary"},
    };
}

void write_off(const Surface& s, const std::string& file) {
    std::ofstream stream(file);
    stream.precision(17);
    stream << "OFF\n" << s.nodes.size() << " " << s.triangles.size() << " 0\n";
    for (const Vec3& x : s.nodes) {
        stream << x.x() << " " << x.y() << " " << x.z() << "\n";
    }
    for (const TriCorners& c : s.triangles) {
        stream << "3 " << c[0] << " " << c[1] << " " << c[2] << "\n";
    }
}

void print(const Row& row, const ProgramRun& run) {
    const std::string what = run.code == 0 ? std::to_string(row.blocks) + " blocks" : run.err.substr(0, 100);
    std::printf("%-46s exit %d  %s\n", row.name.c_str(), run.code, what.substr(0, what.find('\n')).c_str());
}

}  // namespace

TEST_CASE("bad surfaces are refused by name, odd ones give the right blocks") {
    const std::string input = scratch_file("surface.off");
    const std::string output = scratch_file("surface.vtu");
    for (const Row& row : rows()) {
        CAPTURE(row.name);
        write_off(row.surface, input);
        std::filesystem::remove(output);
        const ProgramRun run = run_program("block " + input + " -o " + output + " --quiet");
        print(row, run);
        CHECK(run.code == row.code);
        CHECK(std::filesystem::exists(output) == (row.code == 0));
        CHECK(run.err.find(row.message) != std::string::npos);
        if (run.code == 0 && row.code == 0) {
            const HexMeshData mesh = read_mesh(output);
            CHECK(mesh.mesh.hexes.size() == row.blocks);
            CHECK(verify_hexes(mesh.mesh).ok());
        }
    }
}
