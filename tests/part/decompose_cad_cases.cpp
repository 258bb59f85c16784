// Solids that are cut before they are meshed, of CAD files: features, groups, senses of quads, the same bytes each
// time.
#include "support/catch.hpp"
#include "support/feature_checks.hpp"
#include "support/occ_solids.hpp"

#include <pavior/cad/cut_model.hpp>
#include <pavior/cad/gmsh_brep.hpp>
#include <pavior/mesh/verify_hexes.hpp>
#include <pavior/part/mesh_file.hpp>

#include <nlohmann/json.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <variant>
#include <vector>

using namespace pavior;
using namespace pavior::test;

namespace {

GmshBrep example(const std::string& name) {
    return GmshBrep::load(std::string(PAVIOR_EXAMPLE_DATA).append("/solids/").append(name));
}

PartMesh decomposed(const GmshBrep& model, double size = 0, unsigned threads = 1) {
    PartOptions options;
    options.size = size;
    options.methods = {PartMethod::decompose};
    options.seconds = 0;
    options.execution.threads = threads;
    return mesh_model(model, options);
}

/// Quads are those of the faces of the model, all of these, and look outward.
void check_quads(const GmshBrep& model, const PartMesh& part) {
    std::map<FaceId, double> sense;
    for (const OrientedFace& f : model.solid_faces(SolidId{0})) {
        sense[f.face] = f.outward ? 1 : -1;
    }
    std::set<FaceId> seen;
    std::size_t wrong = 0;
    for (std::size_t q = 0; q < part.data.quads.size(); ++q) {
        const FaceId f = part.quad_face[q];
        REQUIRE(f.valid());
        REQUIRE(f.index() < model.face_count());
        CHECK(part.data.quad_groups[q] == model.tag(2, f.index()));
        seen.insert(f);
        const auto& quad = part.data.quads[q];
        const auto& x = part.data.mesh.nodes;
        const Vec3 n = (x[quad[2]] - x[quad[0]]).cross(x[quad[3]] - x[quad[1]]);
        const Vec3 middle = 0.25 * (x[quad[0]] + x[quad[1]] + x[quad[2]] + x[quad[3]]);
        const auto [du, dv] = model.face_derivatives(f, model.closest_on_face(f, middle));
        wrong += sense.at(f) * n.dot(du.cross(dv)) > 0 ? 0 : 1;
    }
    CHECK(wrong == 0);
    CHECK(seen.size() == model.face_count());
}

void check_groups(const GmshBrep& model, const PartMesh& part) {
    std::set<int> solids, faces;
    for (std::size_t s = 0; s < model.solid_count(); ++s) {
        solids.insert(model.tag(3, s));
    }
    for (std::size_t f = 0; f < model.face_count(); ++f) {
        faces.insert(model.tag(2, f));
    }
    CHECK(std::set<int>(part.data.hex_groups.begin(), part.data.hex_groups.end()) == solids);
    CHECK(std::set<int>(part.data.quad_groups.begin(), part.data.quad_groups.end()) == faces);
    for (const MeshGroup& group : part.data.groups) {
        CAPTURE(group.dimension, group.number);
        CHECK((group.dimension == 3 ? solids : faces).count(group.number) == 1);
    }
    for (const SolidId s : part.hex_solid) {
        REQUIRE(s.index() < model.solid_count());
    }
}

void check_cuts(const GmshBrep& model, const MethodTry& taken) {
    REQUIRE_FALSE(taken.cuts.empty());
    const GmshCutter cutter(model);
    const std::optional<GmshPieces> pieces = cutter(taken.cuts);
    REQUIRE(pieces);
    const bool divided =
        std::any_of(taken.cuts.begin(), taken.cuts.end(), [](const SolidCut& cut) { return !cut.surfaces.empty(); });
    CHECK(pieces->model->solid_count() >= model.solid_count() + (divided ? 1 : 0));
    const std::string pieces_note = std::to_string(pieces->model->solid_count()) + " pieces, by ";
    CHECK(std::any_of(taken.notes.begin(), taken.notes.end(),
                      [&](const std::string& note) { return note.find(pieces_note) == 0; }));
    const auto report = nlohmann::json::parse(taken.report);
    REQUIRE(report["cuts"].size() == taken.cuts.size());
    CHECK(report["pieces"].size() == pieces->model->solid_count());
    for (std::size_t c = 0; c < taken.cuts.size(); ++c) {
        CHECK(report["cuts"][c]["solid"] == taken.cuts[c].solid.value);
        CHECK(report["cuts"][c]["reason"] == std::string(to_string(taken.cuts[c].reason)));
        CHECK(report["cuts"][c]["surfaces"].size() == taken.cuts[c].surfaces.size());
        CHECK(report["cuts"][c].value("curves", nlohmann::json::array()).size() == taken.cuts[c].curves.size());
    }
}

bool same_surfaces(const MethodTry& a, const MethodTry& b) {
    return std::equal(a.cuts.begin(), a.cuts.end(), b.cuts.begin(), b.cuts.end(),
                      [](const SolidCut& x, const SolidCut& y) {
                          return x.solid == y.solid && x.reason == y.reason && x.surfaces.size() == y.surfaces.size() &&
                                 x.curves.size() == y.curves.size();
                      });
}

void check_part(const GmshBrep& model, double size) {
    const PartMesh part = decomposed(model, size);
    INFO(reason_of(part));
    REQUIRE(part.valid());
    const MethodTry& taken = part.decisions[0].tries[0];
    CHECK(taken.method == PartMethod::decompose);
    CHECK(part.check.quality.scaled_jacobian.min >= 0.3);
    CHECK(verify_hexes(part.data.mesh).ok());
    CHECK(part.data.quads.size() == part.check.verify.boundary_quads);  // none between pieces
    check_features(model, part, size);
    check_quads(model, part);
    check_groups(model, part);
    check_cuts(model, taken);
    REQUIRE(part.deviation.relative_volume());
    CHECK(std::abs(*part.deviation.relative_volume()) < 0.05);  // a circle of twelve edges lacks 4.5 %
    for (const unsigned threads : {1U, 2U}) {
        const PartMesh again = decomposed(model, size, threads);
        CHECK(again.data.mesh.nodes == part.data.mesh.nodes);
        CHECK(again.data.mesh.hexes == part.data.mesh.hexes);
        CHECK(again.data.quads == part.data.quads);
        CHECK(again.data.quad_groups == part.data.quad_groups);
        CHECK(again.decisions[0].tries[0].notes == taken.notes);
        CHECK(same_surfaces(again.decisions[0].tries[0], taken));
    }
}

}  // namespace

TEST_CASE("A pipe tee is cut at its junction") { check_part(example("pipe_tee.step"), 1); }

TEST_CASE("A sleeve with a flange, a full turn") { check_part(example("flanged_sleeve_full_turn.step"), 2); }

TEST_CASE("A bolt with a fillet at its neck") { check_part(example("bolt_neck_fillet.step"), 0.7); }

TEST_CASE("A peg with a fillet at its neck and a chamfer on its tip") {
    check_part(example("peg_neck_fillet_tip_chamfer.step"), 0.7);
}

TEST_CASE("Coarse meshes are valid, too, and keep all features") {
    for (const char* name : {"pipe_tee.step", "flanged_sleeve_full_turn.step", "bolt_neck_fillet.step"}) {
        CAPTURE(name);
        const GmshBrep model = example(name);
        const PartMesh part = decomposed(model);
        INFO(reason_of(part));
        REQUIRE(part.valid());
        CHECK(part.check.quality.scaled_jacobian.min >= 0.1);
        check_features(model, part, model.diagonal() / 12);
        check_quads(model, part);
        check_groups(model, part);
        check_cuts(model, part.decisions[0].tries[0]);
    }
}

TEST_CASE("What nothing cuts is refused with the reason: a ball, a box") {
    for (const bool ball : {true, false}) {
        const GmshBrep model =
            GmshBrep::build([&] { (void)(ball ? occ::addSphere(0, 0, 0, 1) : occ::addBox(0, 0, 0, 1, 1, 1)); });
        const PartMesh part = decomposed(model);
        CHECK_FALSE(part.complete());
        const MethodTry& refused = part.decisions[0].tries[0];
        CHECK(refused.outcome == TryOutcome::refused);
        CHECK_THAT(refused.reason, Catch::Contains("no cuts were found"));
        CHECK(refused.cuts.empty());
        CHECK_THAT(reason_of(part), Catch::Contains("decompose: "));
    }
}

TEST_CASE("A part that is cut if it may be is not if that is forbidden") {
    const GmshBrep model = example("pipe_tee.step");
    PartOptions options;
    options.decompose = false;
    options.last_resort = false;
    options.seconds = 20;
    const PartMesh part = mesh_model(model, options);
    for (const MethodTry& one : part.decisions[0].tries) {
        CHECK(one.method != PartMethod::decompose);
        CHECK(one.cuts.empty());
    }
}

TEST_CASE("A block whose holes meet is submapped with its holes as squares: one piece, features and groups kept") {
    const GmshBrep model = GmshBrep::build([] {
        const int box = occ::addBox(0, 0, 0, 20, 20, 20);
        cut(box, {{3, occ::addCylinder(10, 10, -1, 0, 0, 22, 4)},
                  {3, occ::addCylinder(-1, 10, 10, 22, 0, 0, 2)},
                  {3, occ::addCylinder(10, -1, 10, 0, 22, 0, 2)}});
    });
    check_part(model, 1.5);
    const PartMesh part = decomposed(model, 1.5);
    const MethodTry& taken = part.decisions.at(0).tries.at(0);
    REQUIRE(taken.cuts.size() == 1);
    CHECK(taken.cuts[0].reason == CutReason::square);
    CHECK(taken.min_jacobian > 0.4);
}

TEST_CASE("A stepped shaft with a cross hole becomes a square bar with layers under its wall") {
    const GmshBrep model = GmshBrep::build([] {
        gmsh::vectorpair shaft;
        std::vector<gmsh::vectorpair> map;
        occ::fuse({{3, occ::addCylinder(0, 0, 0, 0, 0, 10, 4)}}, {{3, occ::addCylinder(0, 0, 10, 0, 0, 10, 6)}}, shaft,
                  map);
        cut(shaft.at(0).second, {{3, occ::addCylinder(-8, 0, 5, 16, 0, 0, 1.2)}});
    });
    check_part(model, 1.5);
}
