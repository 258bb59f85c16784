#include <pavior/part/local_lengths.hpp>

#include "support/catch.hpp"
#include "support/test_brep.hpp"

#include <pavior/core/error.hpp>
#include <pavior/part/any_model.hpp>

#include <cmath>
#include <limits>
#include <vector>

using namespace pavior;
using namespace pavior::test;

namespace {

/// Two boxes that know their volumes and names.
struct NamedBoxes : TestBrep {
    NamedBoxes() {
        add_prism(*this, rectangle(2, 1), 0, 3);
        add_prism(*this, rectangle(1, 1), 10, 11);
    }
    [[nodiscard]] double solid_volume(SolidId s) const { return s.index() == 0 ? 6 : 1; }
    [[nodiscard]] std::string solid_name(SolidId) const { return "box"; }
    [[nodiscard]] std::string face_name(FaceId f) const { return f.index() == 2 ? "wall" : ""; }
};

}  // namespace

TEST_CASE("Names become tags, those of the tags stay") {
    const NamedBoxes b;
    LocalLengths given;
    given.named = {{"box", 0.5}, {"wall", 0.25}};
    given.solid = {{2, 0.75}};
    given.edge = {{1, 0.125}};
    const LocalLengths by_tag = lengths_by_tag(b, given);
    CHECK(by_tag.named.empty());
    CHECK(by_tag.edge == given.edge);
    CHECK(by_tag.face == std::map<int, double>{{3, 0.25}});
    CHECK(by_tag.solid == std::map<int, double>{{1, 0.5}, {2, 0.75}});
}

TEST_CASE("Tags and names that nothing bears, and lengths that are not positive, are refused") {
    const NamedBoxes b;
    const auto refused = [&](const LocalLengths& lengths, const std::string& text) {
        CHECK_THROWS_WITH(lengths_by_tag(b, lengths), Catch::Contains(text));
        CHECK_THROWS_AS(lengths_by_tag(b, lengths), InputError);
    };
    refused({.edge = {{99, 1}}}, "edge 99");
    refused({.face = {{13, 1}}}, "face 13, which the model does not have: its tags go from 1 to 12");
    refused({.solid = {{3, 1}}}, "solid 3");
    refused({.named = {{"lid", 1}}}, "'lid'");
    refused({.named = {{"", 1}}}, "''");
    refused({.face = {{1, 0}}}, "positive");
    refused({.solid = {{1, std::numeric_limits<double>::quiet_NaN()}}}, "positive");
    refused({.named = {{"box", std::numeric_limits<double>::infinity()}}}, "positive");
}

TEST_CASE("Hexahedra are expected by volume, and too many refused with a size that fits") {
    const NamedBoxes b;
    const std::vector<SolidId> solids{SolidId{0}, SolidId{1}};
    CHECK(expected_hexahedra(b, solids, 0.5) == Approx(7 * 8));
    CHECK(expected_hexahedra(b, solids, 0.5, {{1, 0.25}}) == Approx(6 * 64 + 8));
    const TestBrep unknown;
    CHECK(expected_hexahedra(unknown, {}, 0.5) == 0);
    CHECK_NOTHROW(require_expected_at_most(1e12, 0, 1));
    CHECK_NOTHROW(require_expected_at_most(1000, 1000, 1));
    CHECK_THROWS_WITH(require_expected_at_most(8000, 1000, 0.1), Catch::Contains("size 0.2 instead of 0.1"));
    CHECK_THROWS_AS(require_expected_at_most(std::numeric_limits<double>::infinity(), 1000, 0.1), InputError);
}
