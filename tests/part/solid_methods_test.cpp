#include <pavior/part/solid_methods.hpp>

#include "support/catch.hpp"
#include "support/occ_solids.hpp"

#include <pavior/cad/gmsh_brep.hpp>
#include <pavior/glpk/solve_program.hpp>

using namespace pavior;
using namespace pavior::test;

namespace {

/// A stepped block, which can only be submapped, a plate with a blind hole, a box beside the block, a cylinder.
void make_kinds() {
    const int block = cut(occ::addBox(0, 0, 0, 4, 4, 4), {{3, occ::addBox(2, 0, 2, 2, 2, 2)},
                                                          {3, occ::addBox(2.5, 3, 0, 1.5, 1, 1)},
                                                          {3, occ::addBox(0, 2, 3, 1, 2, 1)}});
    const int plate = cut(occ::addBox(9, 0, 0, 4, 4, 2), {{3, occ::addCylinder(11, 2, 1, 0, 0, 1, 1)}});
    const int box = occ::addBox(4, 0, 0, 2, 1.5, 1.5);
    const int cylinder = occ::addCylinder(0, 0, 9, 2, 0, 0, 0.4);
    share_faces({{3, block}, {3, plate}, {3, box}, {3, cylinder}});
}

const auto solver = [](const IntegerProgram& program) { return solve(program, {5, {}}); };

/// The face of a solid at x.
FaceId face_at(const GmshBrep& model, SolidId solid, double x) {
    for (const OrientedFace& f : model.solid_faces(solid)) {
        bool all = true;
        for (const EdgeLoop& loop : model.face_loops(f.face)) {
            for (const OrientedEdge& use : loop) {
                for (const VertexId v : model.edge_vertices(use.edge)) {
                    all = all && std::abs(model.vertex_point(v)[0] - x) < 1e-9;
                }
            }
        }
        if (all) {
            return f.face;
        }
    }
    return {};
}

/// Quads that are no grid on face f: all that the choice looks at.
BoundaryMesh unstructured_on(const GmshBrep& model, FaceId f) {
    BoundaryMesh given = mesh_edges(model, std::vector<int>(model.edge_count(), 0));
    given.faces[f.index()].quads.resize(1);
    given.faces[f.index()].nodes.resize(4);
    given.faces[f.index()].uv.resize(4);
    return given;
}

}  // namespace

TEST_CASE("what solids admit, and what is chosen") {
    const GmshBrep model = GmshBrep::build(make_kinds);
    std::vector<SolidWays> ways = solid_ways(model, all_solids(model), solver);
    REQUIRE(ways.size() == 4);
    const SolidWays& block = ways[0];
    const SolidWays& plate = ways[1];
    const SolidWays& box = ways[2];
    const SolidWays& cylinder = ways[3];
    CHECK((block.submap && block.sweeps.empty()));
    CHECK(plate.only_multi_sweep());
    CHECK((box.submap && box.sweeps.size() == 3));
    CHECK((!cylinder.submap && cylinder.sweeps.size() == 1));
    ways.erase(ways.begin() + 1);
    BoundaryMesh none = mesh_edges(model, std::vector<int>(model.edge_count(), 0));
    const MethodChoice choice = choose_methods(model, ways, none, true);
    CHECK(choice.submaps == std::vector{SolidId{0}, SolidId{2}});
    CHECK(choice.sweeps.size() == 1);
    const MethodChoice swept = choose_methods(model, ways, none, false);
    CHECK(swept.submaps == std::vector{SolidId{0}});
    CHECK(swept.sweeps.size() == 2);
}

TEST_CASE("a mesh that is no grid is handed on from cap to cap") {
    const GmshBrep model = GmshBrep::build([] {
        const int a = occ::addBox(0, 0, 0, 1, 3, 2);
        const int b = occ::addBox(1, 0, 0, 1, 3, 2);
        const int c = occ::addBox(2, 0, 0, 5, 3, 2);
        share_faces({{3, a}, {3, b}, {3, c}});
    });
    const std::vector<SolidWays> ways = solid_ways(model, all_solids(model), solver);
    BoundaryMesh given = unstructured_on(model, face_at(model, SolidId{0}, 0));
    const MethodChoice choice = choose_methods(model, ways, given, true);
    CHECK(choice.submaps.empty());
    REQUIRE(choice.sweeps.size() == 3);
    for (std::size_t s = 0; s < 3; ++s) {
        const double x = static_cast<double>(s);
        const std::set<FaceId> caps{choice.sweeps[s].source, choice.sweeps[s].target};
        CHECK(caps == std::set<FaceId>{face_at(model, SolidId{static_cast<std::int32_t>(s)}, x),
                                       face_at(model, SolidId{static_cast<std::int32_t>(s)}, s == 2 ? 7 : x + 1)});
    }
}

TEST_CASE("a solid with no sweep that fits is refused, and the face named") {
    const GmshBrep model = GmshBrep::build(make_kinds);
    std::vector<SolidWays> ways = solid_ways(model, all_solids(model), solver);
    const SolidWays cylinder = ways[3];
    BoundaryMesh given = mesh_edges(model, std::vector<int>(model.edge_count(), 0));
    FaceId wall;
    for (const OrientedFace& f : model.solid_faces(cylinder.solid)) {
        wall = model.face_kind(f.face) == "Plane" ? wall : f.face;
    }
    given = unstructured_on(model, wall);
    CHECK_THROWS_WITH(
        choose_methods(model, std::span(&cylinder, 1), given, true),
        Catch::Contains("no sweep that fits") && Catch::Contains("face " + std::to_string(model.tag(2, wall.index()))));
}
