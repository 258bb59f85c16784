#include <pavior/cad/gmsh_brep.hpp>
#include <pavior/cad/imprint_report.hpp>

#include "support/catch.hpp"
#include "support/occ_solids.hpp"

#include <algorithm>
#include <string>
#include <vector>

using namespace pavior;
using namespace pavior::test;

namespace {

const std::string faults = std::string(PAVIOR_TEST_DATA) + "/faults/";

/// How often each tag of a solid occurs.
std::vector<int> solid_tags(const GmshBrep& model) {
    std::vector<int> tags;
    for (std::size_t s = 0; s < model.solid_count(); ++s) {
        tags.push_back(model.tag(3, s));
    }
    std::sort(tags.begin(), tags.end());
    return tags;
}

}  // namespace

TEST_CASE("Solids that overlap are told with their common volume, and pieces bear the tags of the file") {
    const GmshBrep model = GmshBrep::build([] {
        occ::addBox(0, 0, 0, 4, 4, 4, 1);
        occ::addBox(3, 0, 0, 4, 4, 4, 2);
        occ::addBox(10, 0, 0, 1, 1, 1, 3);
    });
    const ImprintReport& report = model.imprint_report();
    REQUIRE(report.overlaps.size() == 1);
    CHECK(report.overlaps[0].solids == std::array{1, 2});
    CHECK(report.overlaps[0].kind == OverlapKind::overlap);
    CHECK(report.overlaps[0].volume == Approx(16));
    CHECK(report.pieces.size() == 3);
    CHECK(report.gaps.empty());
    CHECK(solid_tags(model) == std::vector{1, 1, 2, 3});
    bool both = false;
    for (std::size_t s = 0; s < model.solid_count(); ++s) {
        both = both || model.all_tags(3, s) == std::vector{1, 2};
    }
    CHECK(both);
    CHECK_THAT(warnings_of(report).at(0), Catch::Contains("solids 1 and 2 overlap"));
}

TEST_CASE("A solid inside another keeps its tag, and so does what is round it") {
    const GmshBrep model = GmshBrep::load(faults + "nested_cylinder.step");
    REQUIRE(model.imprint_report().overlaps.size() == 1);
    const SolidOverlap& nested = model.imprint_report().overlaps[0];
    CHECK(nested.kind == OverlapKind::nested);
    CHECK(solid_tags(model) == std::vector{1, 2});
    for (std::size_t s = 0; s < 2; ++s) {
        const SolidId solid{static_cast<std::int32_t>(s)};
        const bool inner = model.tag(3, s) == nested.solids[1];
        CHECK((model.solid_volume(solid) == Approx(nested.volume)) == inner);
    }
    CHECK_THAT(warnings_of(model.imprint_report()).at(0), Catch::Contains("lies inside solid"));
}

TEST_CASE("Solids that are the same are one, with one tag") {
    const GmshBrep model = GmshBrep::load(faults + "duplicate.step");
    REQUIRE(model.imprint_report().overlaps.size() == 1);
    CHECK(model.imprint_report().overlaps[0].kind == OverlapKind::duplicate);
    CHECK(model.imprint_report().pieces.empty());
    CHECK(solid_tags(model) == std::vector{1});
    CHECK(model.all_tags(3, 0) == std::vector{1, 2});
}

TEST_CASE("Gaps are told with their width, and closed by a tolerance above it") {
    const std::string file = faults + "gap_1e5.step";
    const GmshBrep apart = GmshBrep::load(file);
    REQUIRE(apart.imprint_report().gaps.size() == 1);
    CHECK(apart.imprint_report().gaps[0].solids == std::array{1, 2});
    CHECK(apart.imprint_report().gaps[0].distance == Approx(1e-5).epsilon(0.01));
    CHECK_THAT(warnings_of(apart.imprint_report()).at(0), Catch::Contains("apart"));
    const GmshBrep closed = GmshBrep::load(file, {.imprint_tolerance = 1e-4});
    CHECK(closed.imprint_report().gaps.empty());
    CHECK(closed.face_count() == apart.face_count() - 1);
    CHECK(solid_tags(closed) == std::vector{1, 2});
}

TEST_CASE("Solids that touch leave nothing to tell, and their faces bear the tags of the file") {
    const auto shapes = [] {
        occ::addBox(0, 0, 0, 10, 10, 2, 1);
        occ::addCylinder(5, 5, 2, 0, 0, 3, 1, 2);
    };
    const GmshBrep model = GmshBrep::build(shapes);
    CHECK(warnings_of(model.imprint_report()).empty());
    CHECK(model.imprint_report().pieces.empty());
    const GmshBrep plain = GmshBrep::build(shapes, {.imprint = false});
    std::size_t same = 0;
    for (std::size_t f = 0; f < model.face_count(); ++f) {
        const FaceId face{static_cast<std::int32_t>(f)};
        for (const int tag : model.all_tags(2, f)) {
            const auto at = plain.find(2, tag);
            REQUIRE(at.has_value());
            const FaceId other{static_cast<std::int32_t>(*at)};
            CHECK(model.face_kind(face) == plain.face_kind(other));
            same += model.face_area(face) == Approx(plain.face_area(other)) ? 1 : 0;
        }
    }
    CHECK(same >= 8);  // all but the ones that share a place
}

TEST_CASE("Slices much thinner than the size are refused by the tags of their solids") {
    const GmshBrep model = GmshBrep::build([] {
        occ::addBox(0, 0, 0, 4, 4, 4, 1);
        occ::addBox(3.999, 0, 0, 4, 4, 4, 2);
    });
    CHECK_THROWS_WITH(refuse_slices(model.imprint_report(), 1), Catch::Contains("solids 1, 2: where solids cut"));
    CHECK_NOTHROW(refuse_slices(model.imprint_report(), 0.05));
    CHECK_NOTHROW(refuse_slices(ImprintReport{}, 1));
}
