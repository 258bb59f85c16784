#include "support/catch.hpp"

#include <pavior/cad/gmsh_brep.hpp>
#include <pavior/cad/triangulation.hpp>
#include <pavior/core/error.hpp>

#include <Eigen/Geometry>

#include <gmsh.h>
#include <unistd.h>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <numbers>
#include <set>
#include <string>
#include <utility>
#include <vector>

using namespace pavior;
namespace occ = gmsh::model::occ;

namespace {

const std::string data = PAVIOR_EXAMPLE_DATA;

/// True if every edge has two triangles that run along it in opposite senses, and every node a triangle.
bool closed(const TaggedSurface& surface) {
    std::map<std::pair<Index, Index>, int> uses;
    std::vector<char> used(surface.mesh.nodes.size(), 0);
    for (const TriCorners& c : surface.mesh.triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            ++uses[{c[k], c[(k + 1) % 3]}];
            used[c[k]] = 1;
        }
    }
    return std::count(used.begin(), used.end(), 0) == 0 && std::all_of(uses.begin(), uses.end(), [&](const auto& use) {
               const auto other = uses.find({use.first.second, use.first.first});
               return use.second == 1 && other != uses.end() && other->second == 1;
           });
}

double volume(const TaggedSurface& surface) {
    double sum = 0.0;
    for (const TriCorners& c : surface.mesh.triangles) {
        const auto& x = surface.mesh.nodes;
        sum += x[c[0]].cross(x[c[1]]).dot(x[c[2]]) / 6.0;
    }
    return sum;
}

/// A model written to a file by OpenCASCADE, removed at the end.
class CadFile {
public:
    template <class Make>
    CadFile(const std::string& name, Make&& make)
        : path_(std::filesystem::temp_directory_path() / (std::to_string(getpid()) + "_pavior_" + name)) {
        gmsh::initialize(0, nullptr, false);
        gmsh::option::setNumber("General.Terminal", 0);
        gmsh::model::add("made by a test");
        make();
        occ::synchronize();
        gmsh::write(path_.string());
        gmsh::model::remove();
        gmsh::finalize();
    }
    CadFile(const CadFile&) = delete;
    CadFile& operator=(const CadFile&) = delete;
    ~CadFile() { std::filesystem::remove(path_); }
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

/// Without the trial, which is tested by itself.
TriangulationOptions direct() {
    TriangulationOptions options;
    options.trial_seconds = 0.0;
    return options;
}

/// Faces of each edge of the surface.
std::map<std::pair<Index, Index>, std::set<std::int32_t>> faces_at_edges(const TaggedSurface& surface) {
    std::map<std::pair<Index, Index>, std::set<std::int32_t>> faces;
    for (std::size_t t = 0; t < surface.mesh.triangles.size(); ++t) {
        for (std::size_t k = 0; k < 3; ++k) {
            const auto [a, b] = std::minmax(surface.mesh.triangles[t][k], surface.mesh.triangles[t][(k + 1) % 3]);
            faces[{a, b}].insert(surface.face_tags[t]);
        }
    }
    return faces;
}

/// Tagged edges are just those between two faces.
bool edges_part_faces(const TaggedSurface& surface) {
    std::set<std::pair<Index, Index>> tagged;
    for (const TaggedEdge& edge : surface.edges) {
        tagged.insert(std::minmax(edge.nodes[0], edge.nodes[1]));
    }
    for (const auto& [edge, faces] : faces_at_edges(surface)) {
        if ((faces.size() == 2) != tagged.contains(edge)) {
            return false;
        }
    }
    return tagged.size() == surface.edges.size();
}

}  // namespace

TEST_CASE("Plane machined parts have the nodes of their vertices alone") {
    std::size_t parts = 0;
    for (const auto& entry : std::filesystem::directory_iterator(data + "/mfcad")) {
        if (entry.path().extension() != ".step") {
            continue;
        }
        CAPTURE(entry.path().filename().string());
        const TaggedSurface surface = triangulate(entry.path(), direct());
        const GmshBrep brep = GmshBrep::load(entry.path(), {.imprint = true, .trial_seconds = 0});
        CHECK(closed(surface));
        CHECK(edges_part_faces(surface));
        CHECK(surface.mesh.nodes.size() == brep.vertex_count());
        CHECK(surface.vertices.size() == brep.vertex_count());
        CHECK(surface.edges.size() == brep.edge_count());
        const std::set<std::int32_t> tags(surface.face_tags.begin(), surface.face_tags.end());
        CHECK(tags.size() == brep.face_count());
        double expected = 0.0;
        for (std::int32_t s = 0; s < static_cast<std::int32_t>(brep.solid_count()); ++s) {
            expected += brep.solid_volume(SolidId{s});
        }
        CHECK(volume(surface) == Approx(expected).epsilon(1e-9));
        for (const TaggedNode& vertex : surface.vertices) {
            const auto id = brep.find(0, vertex.tag);
            REQUIRE(id.has_value());
            const Vec3 x = brep.vertex_point(VertexId{static_cast<std::int32_t>(*id)});
            CHECK((x - surface.mesh.nodes[vertex.node]).norm() < 1e-9 * brep.diagonal());
        }
        ++parts;
    }
    CHECK(parts >= 10);
}

TEST_CASE("Curved parts stay within the chord") {
    for (const auto& entry : std::filesystem::directory_iterator(data + "/hexme")) {
        const std::string extension = entry.path().extension().string();
        if (extension != ".step" && extension != ".stp") {
            continue;
        }
        CAPTURE(entry.path().filename().string());
        const TaggedSurface surface = triangulate(entry.path(), direct());
        const GmshBrep brep = GmshBrep::load(entry.path(), {.imprint = true, .trial_seconds = 0});
        CHECK(closed(surface));
        CHECK(edges_part_faces(surface));
        const double chord = brep.diagonal() / 200.0;
        for (const auto& [edge, faces] : faces_at_edges(surface)) {
            const Vec3 middle = (surface.mesh.nodes[edge.first] + surface.mesh.nodes[edge.second]) / 2.0;
            for (const std::int32_t tag : faces) {
                const auto id = brep.find(2, tag);
                REQUIRE(id.has_value());
                const FaceId face{static_cast<std::int32_t>(*id)};
                CHECK((brep.face_point(face, brep.closest_on_face(face, middle)) - middle).norm() <= 1.01 * chord);
            }
        }
        CHECK(volume(surface) == Approx(brep.solid_volume(SolidId{0})).epsilon(0.05));
    }
}

TEST_CASE("A cylinder: seam and its vertices are left out, chord and size refine") {
    const CadFile file("cylinder.step", [] { occ::addCylinder(0, 0, 0, 0, 0, 2, 1); });
    const TaggedSurface coarse = triangulate(file.path(), direct());
    CHECK(closed(coarse));
    CHECK(coarse.vertices.empty());
    std::set<std::int32_t> curves;
    for (const TaggedEdge& edge : coarse.edges) {
        curves.insert(edge.tag);
        for (const Index node : edge.nodes) {
            CHECK(coarse.mesh.nodes[node].head<2>().norm() == Approx(1.0));
        }
    }
    CHECK(curves.size() == 2);
    CHECK(coarse.edges.size() >= 32);
    CHECK(coarse.edges.size() <= 64);

    TriangulationOptions options = direct();
    options.chord = 0.001;
    const TaggedSurface fine = triangulate(file.path(), options);
    CHECK(closed(fine));
    double worst = 0.0;
    for (const TaggedEdge& edge : fine.edges) {
        const Vec3 middle = (fine.mesh.nodes[edge.nodes[0]] + fine.mesh.nodes[edge.nodes[1]]) / 2.0;
        worst = std::max(worst, 1.0 - middle.head<2>().norm());
    }
    CHECK(worst <= 0.001);
    CHECK(worst > 0.0001);
    CHECK(volume(fine) == Approx(2.0 * std::numbers::pi).epsilon(0.005));

    options = direct();
    options.size = 0.2;
    const TaggedSurface small = triangulate(file.path(), options);
    for (const auto& [edge, faces] : faces_at_edges(small)) {
        CHECK((small.mesh.nodes[edge.first] - small.mesh.nodes[edge.second]).norm() < 0.45);
    }
    CHECK(small.mesh.nodes.size() > 2 * coarse.mesh.nodes.size());
}

TEST_CASE("Faces are as coarse as each of them may be") {
    const CadFile file("rod.step", [] {
        gmsh::vectorpair rod;
        gmsh::vectorpair bored;
        std::vector<gmsh::vectorpair> map;
        occ::fuse({{3, occ::addCylinder(0, 0, 0, 0, 0, 100, 1)}}, {{3, occ::addCylinder(0, 0, 0, 0, 0, 1, 40)}}, rod,
                  map);
        occ::cut(rod, {{3, occ::addCylinder(20, 0, -1, 0, 0, 3, 0.5)}}, bored, map);
    });
    TriangulationOptions options = direct();
    options.chord = 0.025;
    const TaggedSurface surface = triangulate(file.path(), options);
    CHECK(closed(surface));
    CHECK(edges_part_faces(surface));
    std::map<std::int32_t, std::size_t> edges;
    for (const TaggedEdge& edge : surface.edges) {
        ++edges[edge.tag];
    }
    std::multiset<std::size_t> counts;
    for (const auto& [curve, count] : edges) {
        counts.insert(count);
    }
    // Two rims of the hole, both ends of the rod and of the disc: 16 suffice for all but the disc.
    CHECK(counts == std::multiset<std::size_t>{16, 16, 16, 16, 128, 128});
    CHECK(surface.mesh.triangles.size() < 1500);
}

TEST_CASE("Surfaces of all kinds are closed and within the chord") {
    const auto cut = [](int a, int b) {
        gmsh::vectorpair out;
        std::vector<gmsh::vectorpair> map;
        occ::cut({{3, a}}, {{3, b}}, out, map);
    };
    const std::map<std::string, std::function<void()>> solids{
        {"sphere", [] { occ::addSphere(0, 0, 0, 1); }},
        {"torus", [] { occ::addTorus(0, 0, 0, 2, 0.5); }},
        {"cone", [] { occ::addCone(0, 0, 0, 0, 0, 2, 1, 0); }},
        {"ellipsoid",
         [] {
             const int ball = occ::addSphere(0, 0, 0, 1);
             occ::dilate({{3, ball}}, 0, 0, 0, 1, 2, 0.5);
         }},
        {"bored", [&] { cut(occ::addCylinder(0, 0, 0, 0, 0, 10, 1), occ::addCylinder(-2, 0, 5, 4, 0, 0, 0.4)); }},
        {"bored at the seam",
         [&] { cut(occ::addCylinder(0, 0, 0, 0, 0, 10, 1), occ::addCylinder(0, -2, 5, 0, 4, 0, 0.4)); }},
        {"ball with a square hole", [&] { cut(occ::addSphere(0, 0, 0, 1), occ::addBox(-0.3, -0.3, -2, 0.6, 0.6, 4)); }},
        {"part of a ball", [] { occ::addSphere(0, 0, 0, 1, -1, -1.2, 0.5, 2); }},
        {"part of a torus", [] { occ::addTorus(0, 0, 0, 2, 0.5, -1, 1.5); }},
        {"rounded box",
         [] {
             const int box = occ::addBox(0, 0, 0, 3, 2, 1);
             occ::synchronize();
             gmsh::vectorpair edges;
             gmsh::vectorpair out;
             occ::getEntities(edges, 1);
             std::vector<int> tags;
             for (const auto& [dim, tag] : edges) {
                 tags.push_back(tag);
             }
             occ::fillet({box}, tags, {0.2}, out);
         }},
        {"wedge of two faces",
         [] {
             const int square = occ::addRectangle(1, 0, 0, 1, 2);
             gmsh::vectorpair out;
             occ::revolve({{2, square}}, 0, 0, 0, 0, 1, 0, 0.1, out);
         }},
    };
    for (const auto& [name, make] : solids) {
        CAPTURE(name);
        const CadFile file("kind.step", make);
        for (const double chord : {0.0, 0.01}) {
            TriangulationOptions options = direct();
            options.chord = chord;
            const CadTriangulation made = triangulate_solids(file.path(), options);
            const TaggedSurface& surface = made.surface;
            const GmshBrep brep = GmshBrep::load(file.path(), {.imprint = true, .trial_seconds = 0});
            CHECK(closed(surface));
            CHECK(edges_part_faces(surface));
            CHECK(surface.mesh.triangles.size() < (chord > 0 ? 12000U : 5000U));
            const double wanted = chord > 0 ? chord : brep.diagonal() / 200.0;
            CHECK(made.chord <= wanted);
            double worst = 0;
            for (const auto& [edge, faces] : faces_at_edges(surface)) {
                const Vec3 middle = (surface.mesh.nodes[edge.first] + surface.mesh.nodes[edge.second]) / 2.0;
                for (const std::int32_t tag : faces) {
                    const FaceId face{static_cast<std::int32_t>(brep.find(2, tag).value())};
                    worst =
                        std::max(worst, (brep.face_point(face, brep.closest_on_face(face, middle)) - middle).norm());
                }
            }
            CHECK(worst <= 1.01 * wanted);
            CHECK(volume(surface) == Approx(brep.solid_volume(SolidId{0})).epsilon(0.08));
        }
    }
}

TEST_CASE("The walls of a thin tube do not cross") {
    for (const double inner : {0.9, 0.97, 0.99}) {
        const CadFile file("tube.step", [&] {
            gmsh::vectorpair out;
            std::vector<gmsh::vectorpair> map;
            occ::cut({{3, occ::addCylinder(0, 0, 0, 0, 0, 5, 1)}}, {{3, occ::addCylinder(0, 0, 0, 0, 0, 5, inner)}},
                     out, map);
        });
        const TaggedSurface surface = triangulate(file.path(), direct());
        CHECK(closed(surface));
        std::map<std::int32_t, double> nearest;  // to the axis, by curve
        for (const TaggedEdge& edge : surface.edges) {
            const Vec3 middle = (surface.mesh.nodes[edge.nodes[0]] + surface.mesh.nodes[edge.nodes[1]]) / 2.0;
            const auto [at, first] = nearest.try_emplace(edge.tag, middle.head<2>().norm());
            at->second = std::min(at->second, middle.head<2>().norm());
        }
        std::size_t outer = 0;
        for (const auto& [curve, radius] : nearest) {
            outer += radius > inner * 0.981 ? 1U : 0U;
        }
        CHECK(nearest.size() == 4);
        CHECK(outer == 2);  // middles of the outer circles lie beyond those of the inner ones
    }
}

TEST_CASE("The chord follows the size of elements, one solid stands for itself") {
    const CadFile file("three.step", [] {
        occ::addCylinder(0, 0, 0, 0, 0, 1, 1);
        occ::addCylinder(0, 0, 1, 0, 0, 1, 0.5);
        occ::addSphere(20, 0, 0, 1);
    });
    const GmshBrep brep = GmshBrep::load(file.path());
    TriangulationOptions options;
    options.element_size = 0.2;
    for (std::size_t s = 0; s < brep.solid_count(); ++s) {
        const SolidId solid{static_cast<std::int32_t>(s)};
        const CadTriangulation made = triangulate_solid(brep, solid, options);
        CHECK(made.inner_facets.empty());
        CHECK(closed(made.surface));
        CHECK(made.chord <= 0.01);
        CHECK(made.chord > 0.001);
        CHECK(made.volume == Approx(brep.solid_volume(solid)));
        CHECK(volume(made.surface) == Approx(made.volume).epsilon(0.03));
        const std::set<std::int32_t> tags(made.surface.face_tags.begin(), made.surface.face_tags.end());
        CHECK(tags.size() == brep.solid_faces(solid).size());
    }
    CHECK(closed(triangulate_solids(brep, options).surface));
}

TEST_CASE("Cavities point into themselves, whatever the format") {
    for (const std::string name : {"hollow.step", "hollow.brep"}) {
        const CadFile file(name, [] {
            const int outer = occ::addBox(0, 0, 0, 3, 3, 3);
            const int inner = occ::addSphere(1.5, 1.5, 1.5, 1);
            gmsh::vectorpair out;
            std::vector<gmsh::vectorpair> map;
            occ::cut({{3, outer}}, {{3, inner}}, out, map);
        });
        const TaggedSurface surface = triangulate(file.path(), direct());
        CHECK(closed(surface));
        CHECK(volume(surface) == Approx(27.0 - 4.0 / 3.0 * std::numbers::pi).epsilon(0.02));
        CHECK(surface.vertices.size() == 8);
    }
}

TEST_CASE("Touching solids share their faces, which become inner facets") {
    const CadFile file("two.step", [] {
        occ::addBox(0, 0, 0, 1, 1, 1);
        occ::addBox(1, 0, 0, 1, 1, 1);
    });
    const CadTriangulation both = triangulate_solids(file.path(), direct());
    CHECK(closed(both.surface));
    CHECK(volume(both.surface) == Approx(2.0));
    REQUIRE(both.inner_facets.size() == 2);
    for (const TaggedTriangle& triangle : both.inner_facets) {
        for (const Index node : triangle.nodes) {
            CHECK(both.surface.mesh.nodes[node].x() == Approx(1.0));
        }
    }
    CHECK_THROWS_WITH(triangulate(file.path(), direct()),
                      Catch::Contains("cad_failure: there are faces between solids"));

    const CadTriangulation assembly = triangulate_solids(data + "/assembly/bolt_plate_washer.step", direct());
    CHECK(assembly.inner_facets.size() > 50);
}

TEST_CASE("The same file gives the same surface") {
    const std::string file = data + "/hexme/s11o_cube_cyl.stp";
    const TaggedSurface a = triangulate(file);
    const TaggedSurface b = triangulate(file, direct());
    CHECK((a.mesh.nodes == b.mesh.nodes && a.mesh.triangles == b.mesh.triangles && a.face_tags == b.face_tags));
    CHECK((a.edges == b.edges && a.vertices == b.vertices));

    const std::string assembly = data + "/assembly/bolt_plate_washer.step";
    const CadTriangulation c = triangulate_solids(assembly);
    const CadTriangulation d = triangulate_solids(assembly, direct());
    CHECK((c.surface.mesh.nodes == d.surface.mesh.nodes && c.surface.mesh.triangles == d.surface.mesh.triangles));
    CHECK((c.surface.face_names == d.surface.face_names && c.inner_facets == d.inner_facets));
    CHECK((c.chord == d.chord && c.volume == d.volume && c.imprint.gaps.size() == d.imprint.gaps.size()));
}

TEST_CASE("Files and options that are none") {
    CHECK_THROWS_AS(triangulate("/nowhere/part.step"), FileError);
    CHECK_THROWS_AS(triangulate(data + "/mfcad/LICENSE"), FileError);
    const std::filesystem::path file =
        std::filesystem::temp_directory_path() / (std::to_string(getpid()) + "_pavior_broken.step");
    std::ofstream(file) << "ISO-10303-21;\nHEADER;\nENDSEC;\nDATA;\n#1=CARTESIAN_POINT('',(0.,0.\n";
    CHECK_THROWS_AS(triangulate(file), FileError);
    std::filesystem::remove(file);
    TriangulationOptions options;
    options.size = -1.0;
    CHECK_THROWS_AS(triangulate(data + "/mfcad/0-1-19.step", options), InputError);
    options = {};
    options.chord = std::nan("");
    CHECK_THROWS_AS(triangulate(data + "/mfcad/0-1-19.step", options), InputError);
    options = {};
    options.element_size = -1.0;
    CHECK_THROWS_AS(triangulate(data + "/mfcad/0-1-19.step", options), InputError);
    options = {};
    options.per_turn = 2;
    CHECK_THROWS_AS(triangulate(data + "/mfcad/0-1-19.step", options), InputError);
}
