// Angles, shapes, circles, candidates and recognition on what a CAD kernel makes: blends, tees, spheres.
#include "decompose/candidate_checks.hpp"
#include "support/catch.hpp"
#include "support/occ_solids.hpp"

#include <pavior/cad/cut_model.hpp>
#include <pavior/cad/gmsh_brep.hpp>
#include <pavior/decompose/cut_candidates.hpp>
#include <pavior/decompose/recognise_piece.hpp>
#include <pavior/glpk/solve_program.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <variant>
#include <vector>

using namespace pavior;
using namespace pavior::test;

namespace {

const SolidId only{0};

GmshBrep example(const std::string& name) {
    return GmshBrep::load(std::string(PAVIOR_EXAMPLE_DATA).append("/solids/").append(name));
}

/// A disc of radius 6 and height 2 with a pin of radius 2, a fillet of radius 1 at its foot; one solid.
void make_filleted_pin() {
    const int disc = occ::addCylinder(0, 0, 0, 0, 0, 2, 6);
    const int pin = occ::addCylinder(0, 0, 2, 0, 0, 5, 2);
    gmsh::vectorpair fused;
    std::vector<gmsh::vectorpair> map;
    occ::fuse({{3, disc}}, {{3, pin}}, fused, map);
    occ::synchronize();
    gmsh::vectorpair edges;
    gmsh::model::getEntities(edges, 1);
    std::vector<int> foot;
    for (const auto& [dim, tag] : edges) {
        double x0 = 0, y0 = 0, z0 = 0, x1 = 0, y1 = 0, z1 = 0;
        gmsh::model::getBoundingBox(1, tag, x0, y0, z0, x1, y1, z1);
        if (std::abs(z0 - 2) < 1e-3 && std::abs(z1 - 2) < 1e-3 && x1 < 3) {
            foot.push_back(tag);
        }
    }
    gmsh::vectorpair out;
    occ::fillet({fused.at(0).second}, foot, {1.0}, out);
}

/// Two round bars that meet at right angles, the second one ends in the first.
void make_tee(double run, double branch) {
    const int a = occ::addCylinder(-5, 0, 0, 10, 0, 0, run);
    const int b = occ::addCylinder(0, 0, 0, 0, 0, 5, branch);
    gmsh::vectorpair fused;
    std::vector<gmsh::vectorpair> map;
    occ::fuse({{3, a}}, {{3, b}}, fused, map);
}

std::vector<FaceShape> shapes_of(const GmshBrep& b) {
    std::vector<FaceShape> shapes;
    for (const OrientedFace& f : b.solid_faces(only)) {
        shapes.push_back(face_shape(b, f));
    }
    return shapes;
}

std::size_t count_of(const std::vector<FaceShape>& shapes, FaceKind kind, bool hollow = false) {
    return static_cast<std::size_t>(std::count_if(
        shapes.begin(), shapes.end(), [&](const FaceShape& s) { return s.kind == kind && s.hollow == hollow; }));
}

PieceMethods methods_of(const GmshBrep& b) { return recognise_piece(b, only, GlpkSolver{}); }

}  // namespace

TEST_CASE("Shapes of faces: a torus is revolved, a sphere is not, planes of a box are planes") {
    const GmshBrep ring = GmshBrep::build([] { (void)occ::addTorus(1, 2, 3, 4, 1); });
    const std::vector<FaceShape> torus = shapes_of(ring);
    REQUIRE(torus.size() == 1);
    CHECK(torus[0].kind == FaceKind::revolved);
    CHECK(torus[0].axis.direction.cross(Vec3::UnitZ()).norm() < 1e-6);
    CHECK(distance_to_line({1, 2, -7}, torus[0].axis) < 1e-6);
    const std::vector<FaceShape> ball = shapes_of(GmshBrep::build([] { (void)occ::addSphere(1, 2, 3, 4); }));
    CHECK(count_of(ball, FaceKind::other) == ball.size());
    CHECK(count_of(shapes_of(GmshBrep::build([] { (void)occ::addBox(1, 2, 3, 4, 5, 6); })), FaceKind::plane) == 6);
    const std::vector<FaceShape> cone = shapes_of(GmshBrep::build([] { (void)occ::addCone(0, 0, 0, 1, 2, 2, 2, 1); }));
    CHECK(count_of(cone, FaceKind::revolved) == 1);
    CHECK(count_of(cone, FaceKind::plane) == 2);
}

TEST_CASE("Shapes of faces: holes are hollow, whatever the CAD kernel does with normals") {
    const GmshBrep block = GmshBrep::build([] {
        const int box = occ::addBox(0, 0, 0, 10, 10, 10);
        cut(box, {{3, occ::addCylinder(5, 5, -1, 0, 0, 12, 2)}});
    });
    const std::vector<FaceShape> shapes = shapes_of(block);
    CHECK(count_of(shapes, FaceKind::plane) == 6);
    REQUIRE(count_of(shapes, FaceKind::cylinder, true) == 1);
    const auto hole =
        std::find_if(shapes.begin(), shapes.end(), [](const FaceShape& s) { return s.kind == FaceKind::cylinder; });
    CHECK(hole->radius == Approx(2).epsilon(1e-6));
    CHECK(distance_to_line({5, 5, 0}, hole->axis) < 1e-6);
    for (const FaceShape& s : shapes) {
        if (s.kind == FaceKind::plane) {  // their normals leave the box
            CHECK(s.axis.direction.dot(s.axis.origin - Vec3(5, 5, 5)) == Approx(5));
        }
    }
}

TEST_CASE("Ellipses and splines are neither straight nor circles") {
    const GmshBrep disc = GmshBrep::build([] {
        const int ellipse = occ::addEllipse(0, 0, 0, 3, 2);
        gmsh::vectorpair out;
        occ::extrude({{2, occ::addPlaneSurface({occ::addCurveLoop({ellipse})})}}, 0, 0, 1, out);
    });
    std::size_t round = 0, straight = 0;
    for (std::size_t e = 0; e < disc.edge_count(); ++e) {
        const EdgeId edge{static_cast<std::int32_t>(e)};
        round += circle_of(disc, edge) ? 1 : 0;
        straight += is_straight(disc, edge) ? 1 : 0;
    }
    CHECK(round == 0);
    CHECK(straight == 1);  // the seam
}

TEST_CASE("The angle between crossing bars changes along the edge, and is concave all along it") {
    const GmshBrep tee = GmshBrep::build([] { make_tee(2, 1); });
    std::size_t concave = 0;
    for (const EdgeAngle& angle : edge_angles(tee, only)) {
        CHECK(angle.least <= angle.most);
        if (angle.concave()) {
            ++concave;
            CHECK(angle.most < 270 + 1e-3);
            CHECK(angle.least > 180 + 59);  // 240 on the flanks: acos(1/2) beyond a half turn
            CHECK(angle.most - angle.least > 1);
        } else {
            CHECK(angle.least == Approx(90).margin(1e-4));
            CHECK(angle.most == Approx(90).margin(1e-4));
        }
    }
    CHECK(concave >= 1);
}

TEST_CASE("A fillet is smooth on both sides, and its foot gives an upright cylinder") {
    const GmshBrep pin = GmshBrep::build([] { make_filleted_pin(); });
    const std::vector<EdgeAngle> angles = edge_angles(pin, only);
    CHECK(std::count_if(angles.begin(), angles.end(), [](const EdgeAngle& a) { return a.smooth(); }) == 2);
    CHECK(std::none_of(angles.begin(), angles.end(), [](const EdgeAngle& a) { return a.concave(); }));
    const std::vector<CutCandidate> candidates = checked_candidates(pin, only);
    CHECK(has_single(candidates, CutCylinder{Vec3::Zero(), Vec3::UnitZ(), 3, Vec3::UnitX()}));
    CHECK(count_of(candidates, CutReason::blend_foot) >= 1);
    CHECK(has_single(candidates, CutPlane{{0, 0, 3}, Vec3::UnitZ()}));  // where it reaches the pin
}

TEST_CASE("A convex blend has no foot") {
    const GmshBrep block = GmshBrep::build([] {
        const int box = occ::addBox(0, 0, 0, 6, 4, 2);
        occ::synchronize();
        gmsh::vectorpair edges, out;
        gmsh::model::getEntities(edges, 1);
        occ::fillet({box}, {edges.at(0).second}, {0.8}, out);
    });
    CHECK(count_of(checked_candidates(block, only), CutReason::blend_foot) == 0);
}

TEST_CASE("A tee gives sets of planes through its saddle, bounded by the line where they meet") {
    for (const double branch : {1.0, 1.5, 2.0}) {
        CAPTURE(branch);
        const GmshBrep tee = GmshBrep::build([&] { make_tee(2, branch); });
        const std::vector<CutCandidate> candidates = checked_candidates(tee, only);
        CHECK(count_of(candidates, CutReason::junction) >= 1);
        for (const CutCandidate& c : candidates) {
            if (c.reason != CutReason::junction) {
                continue;
            }
            CHECK(c.surfaces.size() >= 2);
            for (const CutSurface& surface : c.surfaces) {
                CHECK(signed_distance(surface, Vec3::Zero()) == Approx(0).margin(1e-6));  // where the axes meet
            }
        }
        CHECK(std::any_of(candidates.begin(), candidates.end(), [](const CutCandidate& c) {
            return c.reason == CutReason::junction && any_is<CutHalfPlane>(c.surfaces);
        }));
    }
}

TEST_CASE("The planes of a junction come once, in whatever order they are found again") {
    const GmshBrep finned = GmshBrep::build([] {  // the fin makes planes normal to z come first
        const int run = occ::addCylinder(-5, 0, 0, 10, 0, 0, 2);
        const int branch = occ::addCylinder(0, 0, 0, 0, 5, 0, 1);
        const int fin = occ::addWedge(2.5, 1, -0.2, 1.2, 2.5, 0.4, -1, 0);
        gmsh::vectorpair fused;
        std::vector<gmsh::vectorpair> map;
        occ::fuse({{3, run}}, {{3, branch}, {3, fin}}, fused, map);
    });
    const std::vector<CutCandidate> candidates = checked_candidates(finned, only);
    CHECK(count_of(candidates, CutReason::junction) >= 1);
}

TEST_CASE("A block with a hole gives slabs and a cylinder round it, two holes a plane between them") {
    const GmshBrep block = GmshBrep::build([] {
        const int box = occ::addBox(0, 0, 0, 20, 20, 20);
        cut(box, {{3, occ::addCylinder(10, -1, 5, 0, 22, 0, 2)}, {3, occ::addCylinder(-1, 10, 15, 22, 0, 0, 1)}});
    });
    const std::vector<CutCandidate> candidates = checked_candidates(block, only);
    CHECK(count_of(candidates, CutReason::slab) >= 2);
    CHECK(count_of(candidates, CutReason::round_hole) >= 1);
    REQUIRE(count_of(candidates, CutReason::between) == 1);
    for (const CutCandidate& c : candidates) {
        if (c.reason == CutReason::between) {
            const double z = std::get<CutPlane>(c.surfaces.at(0)).point.z();
            CHECK(z > 7);
            CHECK(z < 14);
        }
    }
}

TEST_CASE("Nothing cuts a ball or a box, and candidates of parts are sound") {
    CHECK(cut_candidates(GmshBrep::build([] { (void)occ::addSphere(0, 0, 0, 1); }), only).empty());
    CHECK(cut_candidates(GmshBrep::build([] { (void)occ::addBox(0, 0, 0, 1, 2, 3); }), only).empty());
    for (const char* name : {"pipe_tee.step", "bolt_neck_fillet.step", "peg_neck_fillet_tip_chamfer.step",
                             "flanged_sleeve_full_turn.step", "table_round_edge.step", "top_fillet.step"}) {
        CAPTURE(name);
        const GmshBrep part = example(name);
        CHECK_FALSE(checked_candidates(part, only).empty());
    }
}

TEST_CASE("Recognition of parts: a tee is for no method, half a turn of a sleeve is for the many-to-many sweep") {
    const PieceMethods tee = methods_of(example("pipe_tee.step"));
    CHECK_FALSE(tee.any());
    CHECK(tee.leaning > 0);
    CHECK_FALSE(methods_of(example("bolt_neck_fillet.step")).any());
    CHECK_FALSE(methods_of(example("flanged_sleeve_full_turn.step")).any());
    CHECK(methods_of(example("flanged_sleeve_half_turn.step")).any());
    const PieceMethods ball = methods_of(GmshBrep::build([] { (void)occ::addSphere(0, 0, 0, 1); }));
    CHECK_FALSE(ball.submap);
    CHECK_FALSE(ball.sweep);
    CHECK_FALSE(ball.multi_sweep);
    const PieceMethods box = methods_of(GmshBrep::build([] { (void)occ::addBox(0, 0, 0, 1, 2, 3); }));
    CHECK(box.submap);
    CHECK(box.sweep);
}

TEST_CASE("Drilled holes are seen as squares: four lines each, clear of holes that enter them") {
    const GmshBrep block = GmshBrep::build([] {
        const int box = occ::addBox(0, 0, 0, 20, 20, 20);
        cut(box, {{3, occ::addCylinder(10, 10, -1, 0, 0, 22, 4)}, {3, occ::addCylinder(10, 12.5, 10, 11, 0, 0, 1)}});
    });
    const std::vector<CutCandidate> candidates = checked_candidates(block, only);
    REQUIRE(count_of(candidates, CutReason::square) == 1);
    const CutCandidate& squares = *std::find_if(candidates.begin(), candidates.end(),
                                                [](const CutCandidate& c) { return c.reason == CutReason::square; });
    CHECK(squares.surfaces.empty());
    REQUIRE(squares.curves.size() == 8);
    std::size_t moved = 0;
    for (const CutCurve& curve : squares.curves) {
        const bool upright = std::abs((curve.to - curve.from).z()) > 19;
        const Vec3 arm = upright ? Vec3(curve.middle - Vec3(10, 10, 0)) : Vec3(curve.middle - Vec3(0, 12.5, 10));
        const Vec2 across = upright ? Vec2(arm.head<2>()) : Vec2(arm.tail<2>());
        CHECK(across.norm() == Approx(upright ? 4 : 1));
        const double degrees = std::atan2(std::abs(across[1]), std::abs(across[0])) * 180 / std::acos(-1.0);
        // the small hole enters the great one between 22 and 61 degrees
        moved += std::abs(degrees - 45) > 1 ? 1 : 0;
        CHECK((std::abs(degrees - 45) < 1 || (upright && arm.x() > 0 && arm.y() > 0 && degrees > 61)));
    }
    CHECK(moved == 1);
}

TEST_CASE("With its lines a block whose holes cross is for submap, without it is for nothing") {
    const GmshBrep block = GmshBrep::build([] {
        const int box = occ::addBox(0, 0, 0, 20, 20, 20);
        cut(box, {{3, occ::addCylinder(10, 10, -1, 0, 0, 22, 4)},
                  {3, occ::addCylinder(-1, 10, 10, 22, 0, 0, 2)},
                  {3, occ::addCylinder(10, -1, 10, 0, 22, 0, 1)}});
    });
    const std::vector<CutCandidate> candidates = checked_candidates(block, only);
    const CutCandidate& squares = *std::find_if(candidates.begin(), candidates.end(),
                                                [](const CutCandidate& c) { return c.reason == CutReason::square; });
    const SolidCut cut{only, {}, squares.reason, squares.curves};
    const std::optional<GmshPieces> pieces = GmshCutter(block)(std::span(&cut, 1));
    REQUIRE(pieces);
    REQUIRE(pieces->model->solid_count() == 1);
    CHECK(pieces->model->face_count() > block.face_count() + 8);
    const GlpkSolver solver;
    CHECK_FALSE(methods_of(block).any());
    const std::vector<EdgeId> turns = edges_on_curves(*pieces->model, std::span(&cut, 1));
    CHECK(turns.size() >= 12);
    CHECK(recognise_piece(*pieces->model, only, solver, turns).submap);
    CHECK_FALSE(recognise_piece(*pieces->model, only, solver).submap);
}
