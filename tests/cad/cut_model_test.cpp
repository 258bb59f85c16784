#include <pavior/cad/cut_model.hpp>

#include "cad/brep_checks.hpp"
#include "support/occ_solids.hpp"
#include "support/scratch.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

using namespace pavior;
using namespace pavior::test;

namespace {

/// [0, 4] x [0, 6] x [0, 8].
GmshBrep box() {
    return GmshBrep::build([] { (void)occ::addBox(0, 0, 0, 4, 6, 8); });
}

/// Two boxes [0, 4] x [0, 6] and [4, 7] x [1, 5], both 0 <= z <= 8, which share a face.
GmshBrep two_boxes() {
    return GmshBrep::build([] {
        (void)occ::addBox(0, 0, 0, 4, 6, 8);
        (void)occ::addBox(4, 1, 0, 3, 4, 8);
    });
}

CutPlane across(int axis, double at) {
    Vec3 normal = Vec3::Zero();
    normal[axis] = 1;
    return {at * normal, normal};
}

SolidCut cut_of(int solid, std::vector<CutSurface> surfaces) { return {SolidId{solid}, std::move(surfaces)}; }

std::optional<GmshPieces> pieces_of(const GmshCutter& cutter, const std::vector<SolidCut>& cuts) {
    return cutter(cuts);
}

/// Ascending volumes of the pieces.
std::vector<double> volumes(const GmshPieces& pieces) {
    std::vector<double> result;
    for (std::size_t s = 0; s < pieces.model->solid_count(); ++s) {
        result.push_back(pieces.model->solid_volume(solid_id(s)));
    }
    std::sort(result.begin(), result.end());
    return result;
}

void check_volumes(const GmshPieces& pieces, const std::vector<double>& expected) {
    const std::vector<double> found = volumes(pieces);
    REQUIRE(found.size() == expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
        CHECK(found[i] == Approx(expected[i]).epsilon(1e-6));
    }
}

/// The solids on the two sides of a face.
std::vector<SolidId> users(const GmshBrep& b, FaceId face) {
    std::vector<SolidId> result;
    int sum = 0;
    for (std::size_t s = 0; s < b.solid_count(); ++s) {
        for (const OrientedFace& use : b.solid_faces(solid_id(s))) {
            if (use.face == face) {
                result.push_back(solid_id(s));
                sum += use.outward ? 1 : -1;
            }
        }
    }
    CHECK((result.size() == 1 || (result.size() == 2 && sum == 0)));
    return result;
}

std::size_t shared_faces(const GmshBrep& b) {
    std::size_t count = 0;
    for (std::size_t f = 0; f < b.face_count(); ++f) {
        count += users(b, face_id(f)).size() == 2 ? 1 : 0;
    }
    return count;
}

/// Faces lie on those that they are said to be pieces of, and together are these; new ones lie inside. Tags are those
/// of the model, edges and vertices have one each.
void check_identified(const GmshBrep& model, const GmshCutter& cutter, GmshPieces& pieces) {
    const std::vector<FaceId> faces = cutter.identify(pieces);
    const GmshBrep& cut = *pieces.model;
    REQUIRE(faces.size() == cut.face_count());
    const double near = 1e-6 * model.diagonal();
    std::vector<double> area(model.face_count(), 0);
    std::set<int> old;
    for (std::size_t f = 0; f < model.face_count(); ++f) {
        old.insert(model.tag(2, f));
    }
    for (std::size_t f = 0; f < faces.size(); ++f) {
        const Vec3 x = cut.face_point(face_id(f), cut.face_interior(face_id(f)));
        CAPTURE(f, x.transpose());
        if (faces[f].valid()) {
            REQUIRE(faces[f].index() < model.face_count());
            const Vec3 there = model.face_point(faces[f], model.closest_on_face(faces[f], x));
            CHECK((there - x).norm() < near);
            area[faces[f].index()] += cut.face_area(face_id(f));
            CHECK(cut.all_tags(2, f) == model.all_tags(2, faces[f].index()));
        } else {
            CHECK(users(cut, face_id(f)).size() == 2);
            CHECK(old.count(cut.tag(2, f)) == 0);
        }
    }
    for (std::size_t f = 0; f < area.size(); ++f) {
        CHECK(area[f] == Approx(model.face_area(face_id(f))).epsilon(1e-6));
    }
    for (std::size_t s = 0; s < pieces.solid.size(); ++s) {
        CHECK(cut.tag(3, s) == model.tag(3, pieces.solid[s].index()));
    }
    for (const int dim : {0, 1}) {
        const std::size_t count = dim == 0 ? cut.vertex_count() : cut.edge_count();
        const std::size_t before = dim == 0 ? model.vertex_count() : model.edge_count();
        std::set<int> tags, known;
        for (std::size_t i = 0; i < count; ++i) {
            tags.insert(cut.tag(dim, i));
        }
        CHECK(tags.size() == count);
        for (std::size_t i = 0; i < before; ++i) {  // each is still there, or a piece of it
            CHECK(tags.count(model.tag(dim, i)) == 1);
            known.insert(model.tag(dim, i));
        }
        for (std::size_t v = 0; dim == 0 && v < count; ++v) {
            if (known.count(cut.tag(0, v)) != 0) {
                const std::size_t whole = *model.find(0, cut.tag(0, v));
                CHECK((model.vertex_point(vertex_id(whole)) - cut.vertex_point(vertex_id(v))).norm() < near);
            }
        }
    }
}

}  // namespace

TEST_CASE("Without cuts the pieces are the model") {
    const GmshBrep one = box();
    const GmshBrep two = two_boxes();
    for (const GmshBrep* of : {&one, &two}) {
        const GmshBrep& model = *of;
        const GmshCutter cutter(model);
        std::optional<GmshPieces> pieces = pieces_of(cutter, {});
        REQUIRE(pieces);
        REQUIRE(pieces->model->solid_count() == model.solid_count());
        CHECK(pieces->model->face_count() == model.face_count());
        for (std::size_t s = 0; s < model.solid_count(); ++s) {
            CHECK(pieces->solid[s] == solid_id(s));
            CHECK(pieces->model->solid_volume(solid_id(s)) == Approx(model.solid_volume(solid_id(s))));
        }
        check_identified(model, cutter, *pieces);
    }
}

TEST_CASE("A plane cuts a box in two that share the cut") {
    const GmshBrep model = box();
    const GmshCutter cutter(model);
    std::optional<GmshPieces> pieces = pieces_of(cutter, {cut_of(0, {across(0, 1)})});
    REQUIRE(pieces);
    CHECK(pieces->solid == std::vector{SolidId{0}, SolidId{0}});
    check_volumes(*pieces, {48, 144});
    CHECK(shared_faces(*pieces->model) == 1);
    CHECK(pieces->model->face_count() == 11);
    check_all(*pieces->model);
    check_identified(model, cutter, *pieces);
}

TEST_CASE("A slanting plane cuts, wherever its point is and however far") {
    const GmshBrep model = box();
    const GmshCutter cutter(model);
    const Vec3 normal = Vec3(1, 2, 3).normalized();
    const Vec3 middle(2, 3, 4);
    for (const double away : {0.0, 50.0, -1000.0}) {
        const Vec3 point = middle + away * normal.unitOrthogonal();
        std::optional<GmshPieces> pieces = pieces_of(cutter, {cut_of(0, {CutPlane{point, normal}})});
        REQUIRE(pieces);
        check_volumes(*pieces, {96, 96});
        check_identified(model, cutter, *pieces);
    }
}

TEST_CASE("A half-plane ends at its line: with a plane it leaves three pieces") {
    const GmshBrep model = box();
    const GmshCutter cutter(model);
    const CutHalfPlane upper{{1, 3, 4}, Vec3::UnitY(), Vec3::UnitZ()};
    CHECK_FALSE(pieces_of(cutter, {cut_of(0, {upper})}));  // ends inside
    std::optional<GmshPieces> pieces = pieces_of(cutter, {cut_of(0, {upper, across(2, 4)})});
    REQUIRE(pieces);
    check_volumes(*pieces, {24, 72, 96});
    CHECK(shared_faces(*pieces->model) == 3);
    check_identified(model, cutter, *pieces);
    const CutHalfPlane whole{{1, 3, -4}, Vec3::UnitY(), Vec3::UnitZ()};  // begins below the box
    pieces = pieces_of(cutter, {cut_of(0, {whole})});
    REQUIRE(pieces);
    check_volumes(*pieces, {48, 144});
}

TEST_CASE("A cylinder cuts out a core, a cylinder through a side a part of one") {
    const GmshBrep model = box();
    const GmshCutter cutter(model);
    const double core = std::numbers::pi * 8;
    for (const Vec3& seam : {Vec3(1, 0, 0), Vec3(0, -1, 0), Vec3(0.6, 0.8, 0)}) {
        for (const double sense : {1.0, -1.0}) {
            std::optional<GmshPieces> pieces =
                pieces_of(cutter, {cut_of(0, {CutCylinder{{2, 3, -70}, {0, 0, sense}, 1, seam}})});
            REQUIRE(pieces);
            check_volumes(*pieces, {core, 192 - core});
            check_identified(model, cutter, *pieces);
        }
    }
    std::optional<GmshPieces> half = pieces_of(cutter, {cut_of(0, {CutCylinder{{0, 3, 0}, {0, 0, 1}, 1, {1, 0, 0}}})});
    REQUIRE(half);
    check_volumes(*half, {0.5 * core, 192 - 0.5 * core});
    check_identified(model, cutter, *half);
}

TEST_CASE("Cuts come one after the other, each in a solid that those before it left") {
    const GmshBrep model = box();
    const GmshCutter cutter(model);
    const std::vector<SolidCut> one{cut_of(0, {across(2, 4)})};
    for (const int second : {0, 1}) {
        std::vector<SolidCut> cuts = one;
        cuts.push_back(cut_of(second, {across(0, 1)}));
        std::optional<GmshPieces> pieces = pieces_of(cutter, cuts);
        REQUIRE(pieces);
        check_volumes(*pieces, {24, 72, 96});
        CHECK(shared_faces(*pieces->model) == 3);  // the half that stays whole is told of the cut of its neighbour
        check_solids(*pieces->model);
        check_identified(model, cutter, *pieces);
    }
}

TEST_CASE("A cut in one of two touching solids leaves the other whole") {
    const GmshBrep model = two_boxes();
    REQUIRE(model.solid_count() == 2);
    const GmshCutter cutter(model);
    for (const int solid : {0, 1}) {
        CAPTURE(solid);
        std::optional<GmshPieces> pieces = pieces_of(cutter, {cut_of(solid, {across(2, 2), across(1, 3)})});
        REQUIRE(pieces);
        REQUIRE(pieces->solid.size() == 5);
        CHECK(std::count(pieces->solid.begin(), pieces->solid.end(), SolidId{solid}) == 4);
        for (std::size_t s = 0; s < 5; ++s) {
            if (pieces->solid[s] != SolidId{solid}) {
                CHECK(pieces->model->solid_volume(solid_id(s)) ==
                      Approx(model.solid_volume(pieces->solid[s])).epsilon(1e-6));
            }
        }
        CHECK(shared_faces(*pieces->model) == 4 + 4);
        check_identified(model, cutter, *pieces);
    }
}

TEST_CASE("What does not divide gives nothing: surfaces outside, in a face, on a round face, none at all") {
    const GmshBrep model = box();
    const GmshCutter cutter(model);
    CHECK_FALSE(pieces_of(cutter, {cut_of(0, {across(0, 5)})}));
    CHECK_FALSE(pieces_of(cutter, {cut_of(0, {across(0, 4)})}));
    CHECK_FALSE(pieces_of(cutter, {cut_of(0, {CutCylinder{{2, 3, 0}, {0, 0, 1}, 40, {1, 0, 0}}})}));
    CHECK_FALSE(pieces_of(cutter, {cut_of(0, {})}));
    CHECK_FALSE(pieces_of(cutter, {cut_of(0, {across(0, 1)}), cut_of(0, {across(0, 5)})}));
    const GmshBrep bar = GmshBrep::build([] { (void)occ::addCylinder(0, 0, 0, 0, 0, 3, 1); });
    CHECK_FALSE(pieces_of(GmshCutter(bar), {cut_of(0, {CutCylinder{{0, 0, 0}, {0, 0, 1}, 1, {1, 0, 0}}})}));
}

TEST_CASE("Slivers give nothing") {
    const GmshBrep model = box();
    const GmshCutter cutter(model);
    for (const double at : {1e-5, 1e-3, 4 - 1e-3}) {
        CAPTURE(at);
        CHECK_FALSE(pieces_of(cutter, {cut_of(0, {across(0, at)})}));
    }
    CHECK_FALSE(pieces_of(cutter, {cut_of(0, {across(0, 2), across(0, 2.001)})}));
    CHECK(pieces_of(cutter, {cut_of(0, {across(0, 0.1)})}));
}

TEST_CASE("There is no such solid") {
    const GmshBrep model = box();
    const GmshCutter cutter(model);
    for (const SolidId solid : {SolidId{1}, SolidId{-1}, SolidId{}, SolidId{1000}}) {
        const std::vector<SolidCut> cuts{{solid, {across(0, 1)}}};
        try {
            (void)cutter(cuts);
            FAIL("it was cut");
        } catch (const InputError& error) {
            CHECK(error.code() == ErrorCode::bad_index);
        }
    }
    CHECK_THROWS_AS(pieces_of(cutter, {cut_of(0, {across(0, 1)}), cut_of(2, {across(0, 2)})}), InputError);
    CHECK(pieces_of(cutter, {cut_of(0, {across(0, 1)}), cut_of(1, {across(1, 2)})}));
    CHECK(pieces_of(cutter, {cut_of(0, {across(0, 1)})}));  // the failures left nothing behind
}

TEST_CASE("The same pieces each time, from copies that outlive the first, and the model stays as it is") {
    const GmshBrep model = two_boxes();
    const std::size_t faces = model.face_count();
    std::optional<GmshCutter> first(model);
    const GmshCutter copy = *first;
    const std::vector<SolidCut> cuts{cut_of(1, {CutCylinder{{5.5, 3, 0}, {0, 0, 1}, 0.8, {1, 0, 0}}}),
                                     cut_of(0, {across(1, 2)})};
    std::optional<GmshPieces> one = (*first)(cuts);
    first.reset();
    std::optional<GmshPieces> two = copy(cuts);
    REQUIRE((one && two));
    CHECK(one->solid == two->solid);
    CHECK(one->model->vertex_count() == two->model->vertex_count());
    REQUIRE(one->model->face_count() == two->model->face_count());
    CHECK(copy.identify(*one) == copy.identify(*two));
    for (std::size_t f = 0; f < one->model->face_count(); ++f) {
        CHECK(one->model->face_area(face_id(f)) == two->model->face_area(face_id(f)));
        CHECK(one->model->tag(2, f) == two->model->tag(2, f));
    }
    CHECK(model.solid_count() == 2);
    CHECK(model.face_count() == faces);
    CHECK(model.solid_volume(SolidId{1}) == Approx(96));
}

TEST_CASE("Files: parts with round faces and assemblies are cut and known again") {
    const std::filesystem::path examples = PAVIOR_EXAMPLE_DATA;
    const GmshBrep tee = GmshBrep::load(examples / "solids/pipe_tee.step");
    const GmshCutter cut_tee(tee);
    Vec3 low = tee.vertex_point(VertexId{0});
    Vec3 high = low;
    for (std::size_t e = 0; e < tee.edge_count(); ++e) {
        for (const double s : {0.0, 0.25, 0.5, 0.75}) {
            const Vec3 x = tee.edge_point(edge_id(e), at_fraction(tee.edge_range(edge_id(e)), s));
            low = low.cwiseMin(x);
            high = high.cwiseMax(x);
        }
    }
    const Vec3 middle = 0.5 * (low + high);
    std::size_t cut = 0;
    for (const int axis : {0, 1, 2}) {
        std::optional<GmshPieces> pieces = pieces_of(cut_tee, {cut_of(0, {across(axis, middle[axis])})});
        if (pieces) {
            ++cut;
            check_solids(*pieces->model);
            check_identified(tee, cut_tee, *pieces);
        }
    }
    CHECK(cut >= 2);
    const GmshBrep assembly = GmshBrep::load(examples / "assembly/bolt_plate_washer.step");
    const GmshCutter cut_assembly(assembly);
    const std::optional<GmshPieces> whole = cut_assembly({});
    REQUIRE(whole);
    CHECK(whole->model->solid_count() == 3);
    CHECK(whole->model->face_count() == assembly.face_count());
}

TEST_CASE("Pieces are saved as a file that holds them all") {
    const GmshBrep model = two_boxes();
    const GmshCutter cutter(model);
    const std::vector<SolidCut> cuts{cut_of(0, {across(2, 2), across(1, 3)})};
    const std::string file = scratch_file("pieces.brep");
    cutter.save(cuts, file);
    const GmshBrep read = GmshBrep::load(file);
    CHECK(read.solid_count() == 5);
    CHECK(shared_faces(read) == 8);
    double volume = 0;
    for (std::size_t s = 0; s < read.solid_count(); ++s) {
        volume += read.solid_volume(solid_id(s));
    }
    CHECK(volume == Approx(192 + 96));
    std::filesystem::remove(file);
}

TEST_CASE("What cannot be saved is named") {
    const GmshBrep model = box();
    const GmshCutter cutter(model);
    const std::vector<SolidCut> cuts{cut_of(0, {across(0, 1)})};
    const std::string nowhere = scratch_file("no_such_folder").append("/pieces.brep");
    try {
        cutter.save(cuts, nowhere);
        FAIL("it was saved");
    } catch (const FileError& error) {
        CHECK(error.file() == nowhere);
    }
    CHECK_FALSE(std::filesystem::exists(nowhere));
    const std::string file = scratch_file("none.brep");
    const std::vector<SolidCut> none{cut_of(0, {across(0, 9)})};
    try {
        cutter.save(none, file);
        FAIL("it was saved");
    } catch (const InputError& error) {
        CHECK(error.code() == ErrorCode::bad_option);
    }
    CHECK_FALSE(std::filesystem::exists(file));
    CHECK_THROWS_AS(cutter.save(cuts, scratch_file("pieces.nonsense")), FileError);
}

TEST_CASE("Curves divide the faces that they lie on, and no solid") {
    const GmshBrep model = GmshBrep::build([] { (void)gmsh::model::occ::addCylinder(0, 0, 0, 0, 0, 3, 2); });
    const GmshCutter cutter(model);
    const double half = std::sqrt(2.0);
    SolidCut cut{solid_id(0), {}, CutReason::square, {}};
    for (const double x : {-half, half}) {
        for (const double y : {-half, half}) {
            cut.curves.push_back({{x, y, 0}, {x, y, 1.5}, {x, y, 3}});
        }
    }
    std::optional<GmshPieces> pieces = cutter(std::span(&cut, 1));
    REQUIRE(pieces);
    REQUIRE(pieces->model->solid_count() == 1);
    CHECK(pieces->model->face_count() == model.face_count() + 4);  // four walls, one of them in two at the seam
    CHECK(pieces->model->solid_volume(solid_id(0)) == Approx(model.solid_volume(solid_id(0))));
    const std::vector<FaceId> faces = cutter.identify(*pieces);
    std::map<FaceId, int> parts;
    for (const FaceId f : faces) {
        ++parts[f];
    }
    CHECK(parts.size() == model.face_count());
    const SolidCut arc{solid_id(0), {}, CutReason::square, {{{2, 0, 0}, {half, half, 0}, {0, 2, 0}}}};
    CHECK_FALSE(cutter(std::span(&arc, 1)));  // runs along an edge
    const SolidCut inside{solid_id(0), {}, CutReason::square, {{{0, 0, 1}, {0, 0, 1.5}, {0, 0, 2}}}};
    CHECK_FALSE(cutter(std::span(&inside, 1)));
}
