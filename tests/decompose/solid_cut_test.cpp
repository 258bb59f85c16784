#include "support/archetypes.hpp"
#include "support/catch.hpp"
#include "support/test_brep.hpp"

#include <pavior/decompose/solid_cut.hpp>

#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

using namespace pavior;
using namespace pavior::test;

namespace {

/// Pieces of a model that is kept elsewhere.
struct BorrowedPieces {
    const archetype::Brep<TestBrep>* model;
    std::vector<SolidId> solid;
};

/// Pieces that can be moved alone.
struct OwnedPieces {
    std::unique_ptr<TestBrep> model;
    std::vector<SolidId> solid;
};

struct NoModel {
    std::unique_ptr<int> model;
    std::vector<SolidId> solid;
};

struct NoSolids {
    std::unique_ptr<TestBrep> model;
};

/// Cuts nothing, counts surfaces; cannot be copied, and not be called where it is const.
struct ForeignCutter {
    std::size_t surfaces = 0;
    std::unique_ptr<int> own = nullptr;

    std::optional<OwnedPieces> operator()(std::span<const SolidCut> cuts) {
        for (const SolidCut& cut : cuts) {
            surfaces += cut.surfaces.size();
        }
        if (!cuts.empty()) {
            return std::nullopt;
        }
        OwnedPieces pieces{std::make_unique<TestBrep>(), {}};
        pieces.solid.push_back(add_prism(*pieces.model, rectangle(1, 1), 0, 1));
        return pieces;
    }
};

struct CutterOfNothing {
    bool operator()(std::span<const SolidCut>) { return false; }
};

static_assert(solid_pieces<BorrowedPieces>);
static_assert(solid_pieces<OwnedPieces>);
static_assert(!solid_pieces<NoModel>);
static_assert(!solid_pieces<NoSolids>);
static_assert(!solid_pieces<int>);
static_assert(solid_cutter<ForeignCutter, OwnedPieces>);
static_assert(!solid_cutter<const ForeignCutter, OwnedPieces>);
static_assert(!solid_cutter<ForeignCutter, BorrowedPieces>);
static_assert(!solid_cutter<ForeignCutter, NoSolids>);
static_assert(!solid_cutter<CutterOfNothing, OwnedPieces>);
static_assert(
    solid_cutter<archetype::Callable<std::optional<BorrowedPieces>(std::span<const SolidCut>)>, BorrowedPieces>);

}  // namespace

TEST_CASE("Reasons for cuts have different names") {
    std::set<std::string_view> names;
    for (const CutReason reason :
         {CutReason::blend_foot, CutReason::concave_edge, CutReason::junction, CutReason::axis_plane,
          CutReason::round_hole, CutReason::slab, CutReason::step, CutReason::between}) {
        names.insert(to_string(reason));
    }
    CHECK(names == std::set<std::string_view>{"foot of a blend", "concave edge", "junction of cylinders",
                                              "plane through an axis", "cylinder round a hole", "slab round a hole",
                                              "step", "between holes"});
    CHECK(to_string(static_cast<CutReason>(200)) == "unknown");
}

TEST_CASE("A cutter of one's own has cuts as data, of any kind of surface") {
    ForeignCutter cutter;
    const std::optional<OwnedPieces> whole = cutter({});
    REQUIRE(whole);
    CHECK(whole->model->solid_count() == 1);
    const std::vector<SolidCut> cuts{
        {SolidId{0}, {CutPlane{Vec3::Zero(), Vec3::UnitX()}, CutHalfPlane{Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY()}}},
        {SolidId{1}, {CutCylinder{Vec3::Zero(), Vec3::UnitZ(), 0.5, Vec3::UnitX()}}, CutReason::round_hole}};
    CHECK(cuts[0].reason == CutReason::step);
    CHECK_FALSE(cutter(cuts));
    CHECK(cutter.surfaces == 3);
    CHECK_FALSE(SolidCut{}.solid.valid());
}
