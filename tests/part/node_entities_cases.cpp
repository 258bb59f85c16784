#include <pavior/brep/node_entities.hpp>
#include <pavior/glpk/solve_program.hpp>

#include "support/catch.hpp"
#include "support/entity_checks.hpp"
#include "support/occ_solids.hpp"
#include "support/voxel_brep.hpp"

#include <pavior/cad/cap_mesh.hpp>
#include <pavior/cad/gmsh_brep.hpp>
#include <pavior/cad/region_quads.hpp>
#include <pavior/imprint/imprint.hpp>
#include <pavior/part/mixed_solids.hpp>
#include <pavior/submap/submap_model.hpp>

#include <numbers>

using namespace pavior;
using namespace pavior::test;

namespace {

constexpr double pi = std::numbers::pi;

MixedSolids meshed(const GmshBrep& model, double size) {
    const std::vector<SolidId> solids = all_solids(model);
    const auto solver = [](const IntegerProgram& program) { return solve(program, {5, {}}); };
    MixedOptions options;
    options.size = size;
    options.min_loop = 8;
    return mixed_solids(model, solids, options, {imprint, solver, GmshRegionMesher{}, GmshCapMesher{&model}, {}},
                        [] { return false; });
}

FaceId face_of_kind(const GmshBrep& model, const std::string& kind) {
    for (std::size_t f = 0; f < model.face_count(); ++f) {
        const FaceId id{static_cast<std::int32_t>(f)};
        if (model.face_kind(id) == kind) {
            return id;
        }
    }
    throw std::logic_error("no " + kind);
}

/// Parameters of nodes on periodic faces lie in the box of the face.
void check_ranges(const GmshBrep& model, const NodeEntities& entities) {
    int outside = 0;
    for (const NodeEntity& entity : entities.of_node) {
        if (entity.dimension == 2) {
            const auto [low, high] = model.face_bounds(FaceId{entity.id});
            const Vec2 room = 1e-9 * Vec2::Ones() + 1e-9 * (high - low);
            outside += !((entity.uv - low + room).minCoeff() >= 0 && (high + room - entity.uv).minCoeff() >= 0);
        }
    }
    CHECK(outside == 0);
}

NodeEntities checked(const GmshBrep& model, double size, double within) {
    const MixedSolids mesh = meshed(model, size);
    const NodeEntities entities = checked_entities(model, mesh, within);
    check_ranges(model, entities);
    return entities;
}

struct FacesOnly {
    HexMesh mesh;
    std::vector<SolidId> hex_solid;
    std::vector<QuadCorners> quads;
    std::vector<FaceId> quad_face;
};

}  // namespace

TEST_CASE("entities of swept CAD solids: a block with a hole, a cylinder, one of two halves, an elbow") {
    const GmshBrep block = GmshBrep::build([] {
        (void)cut(occ::addBox(0, 0, 0, 4, 3, 2), {{3, occ::addCylinder(2, 1.5, -1, 0, 0, 4, 0.7)}});
    });
    CHECK(dimensions(checked(block, 0.5, 1e-9))[0] == 8 + 2);
    const GmshBrep cylinder = GmshBrep::build([] { (void)occ::addCylinder(1, 2, 3, 0.4, 0.3, 2, 1); });
    CHECK(dimensions(checked(cylinder, 0.4, 1e-9))[0] == 2);
    const GmshBrep halves = GmshBrep::build([] {
        const int upper = occ::addCircle(0, 0, 0, 1, -1, 0, pi), lower = occ::addCircle(0, 0, 0, 1, -1, pi, 2 * pi);
        const int disc = occ::addPlaneSurface({occ::addCurveLoop({upper, lower})});
        gmsh::vectorpair out;
        occ::extrude({{2, disc}}, 0, 0, 2, out);
    });
    CHECK(dimensions(checked(halves, 0.4, 1e-9))[0] == 4);
    const GmshBrep elbow = GmshBrep::build([] {
        gmsh::vectorpair out;
        occ::revolve({{2, occ::addDisk(0, 0, 0, 1, 1)}}, 4, 0, 0, 0, 1, 0, pi / 2, out);
    });
    CHECK(dimensions(checked(elbow, 0.4, 1e-7))[0] == 2);
}

TEST_CASE("entities of touching CAD solids, each meshed by its own method") {
    const GmshBrep model = GmshBrep::build([] {
        const int plate = cut(occ::addBox(0, 0, 0, 6, 6, 2), {{3, occ::addCylinder(2.2, 2, 1, 0, 0, 1, 1)}});
        const int stepped = cut(occ::addBox(6, 0, 0, 4, 6, 4), {{3, occ::addBox(8, 0, 2, 2, 2, 2)}});
        share_faces({{3, plate}, {3, stepped}, {3, occ::addCone(4.5, 4.2, 2, 0, 0, 2, 0.9, 0.6)}});
    });
    const MixedSolids mesh = meshed(model, 0.5);
    std::set<PartMethod> methods;
    for (const auto& [solid, method] : mesh.methods) {
        methods.insert(method);
    }
    CHECK(methods.size() == 3);
    const NodeEntities entities = checked_entities(model, mesh, 1e-7);
    check_ranges(model, entities);
    CHECK(dimensions(entities)[0] == static_cast<int>(model.vertex_count()));
}

TEST_CASE("the apex of a CAD cone, and the poles and the seam of a sphere") {
    const GmshBrep cone = GmshBrep::build([] { (void)occ::addCone(0, 0, 0, 0, 0, 2, 1, 0); });
    FacesOnly faces;
    faces.mesh.nodes.emplace_back(0, 0, 2);
    for (int i = 0; i < 16; ++i) {
        const double radius = i < 8 ? 0.5 : 1;
        faces.mesh.nodes.emplace_back(radius * std::cos(i * pi / 4), radius * std::sin(i * pi / 4), 2 - 2 * radius);
    }
    for (Index i = 0; i < 8; ++i) {
        const auto high = [&](Index k) { return 1 + k % 8; };
        faces.quads.push_back({high(i) + 8, high(i + 1) + 8, high(i + 1), high(i)});
        if (i % 2 == 0) {
            faces.quads.push_back({high(i), high(i + 1), high(i + 2), 0});
        }
    }
    faces.quad_face.assign(faces.quads.size(), face_of_kind(cone, "Cone"));
    const NodeEntities entities = checked_entities(cone, faces, 1e-9);
    CHECK(entities.of_node[0].dimension == 0);
    CHECK(dimensions(entities) == std::array{2, 7 + 1, 7, 0});

    const GmshBrep sphere = GmshBrep::build([] { (void)occ::addSphere(0, 0, 0, 2); });
    FacesOnly shell;
    std::map<std::array<int, 3>, Index> at;
    const auto node = [&](std::array<int, 3> p) {
        const auto [found, fresh] = at.try_emplace(p, static_cast<Index>(at.size()));
        if (fresh) {
            shell.mesh.nodes.push_back(2 * Vec3(p[0], p[1], p[2]).normalized());
        }
        return found->second;
    };
    for (std::size_t axis = 0; axis < 3; ++axis) {
        for (const int side : {-2, 2}) {
            for (int i = -2; i < 2; ++i) {
                for (int j = -2; j < 2; ++j) {
                    const auto corner = [&](int u, int v) {
                        std::array<int, 3> p{};
                        p[axis] = side;
                        p[(axis + 1) % 3] = side > 0 ? u : v;
                        p[(axis + 2) % 3] = side > 0 ? v : u;
                        return node(p);
                    };
                    shell.quads.push_back({corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)});
                }
            }
        }
    }
    shell.quad_face.assign(shell.quads.size(), FaceId{0});
    const NodeEntities round = checked_entities(sphere, shell, 1e-9);
    check_ranges(sphere, round);
    CHECK(dimensions(round) == std::array{2, 7, 98 - 9, 0});
}

TEST_CASE("entities of submapped boxes with a boss, a pocket and a tunnel") {
    Voxels voxels(7, 6, 5);
    voxels.fill({0, 0, 0}, {7, 6, 4}, 1);
    voxels.fill({1, 1, 4}, {3, 3, 5}, 2);
    voxels.fill({4, 3, 2}, {5, 5, 4}, 0);
    voxels.fill({1, 4, 0}, {2, 5, 4}, 0);
    const VoxelBrep model(voxels, true);
    REQUIRE(model.sound());
    IntervalOptions options;
    options.size = 0.5;
    const SubmappedMesh mesh = submap_model(model.brep(), model.solids(), options, GlpkSolver{});
    const NodeEntities entities = checked_entities(model.brep(), mesh, 1e-9);
    CHECK(dimensions(entities)[0] == static_cast<int>(model.brep().vertex_count()));
}
