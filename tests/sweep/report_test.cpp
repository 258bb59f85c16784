#include "support/catch.hpp"

#include <pavior/sweep/report.hpp>

using namespace pavior;

TEST_CASE("notices have stable names") {
    CHECK(to_string(SweepNotice::ambiguous_normal) == "ambiguous_normal");
    CHECK(to_string(SweepNotice::loops_reversed) == "loops_reversed");
    CHECK(to_string(SweepNotice::against_front) == "against_front");
    CHECK(to_string(SweepNotice::many_sheets) == "many_sheets");
}

TEST_CASE("a warning is found by its kind") {
    SweepReport report;
    CHECK(report.find(SweepNotice::many_sheets) == nullptr);
    report.warnings = {{SweepNotice::ambiguous_normal, {3}}, {SweepNotice::many_sheets, {0, 7}}};
    REQUIRE(report.find(SweepNotice::many_sheets) != nullptr);
    CHECK(report.find(SweepNotice::many_sheets)->ids == Error::Ids{0, 7});
    CHECK(report.find(SweepNotice::against_front) == nullptr);
}
