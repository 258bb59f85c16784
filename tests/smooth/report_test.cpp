#include <pavior/smooth/report.hpp>

#include "support/catch.hpp"

using namespace pavior;

TEST_CASE("names of the outcomes of smoothing", "[report]") {
    STATIC_REQUIRE(to_string(SmoothStatus::unchanged) == "unchanged");
    STATIC_REQUIRE(to_string(SmoothStatus::repaired) == "repaired");
    STATIC_REQUIRE(to_string(SmoothStatus::still_inverted) == "still_inverted");
    STATIC_REQUIRE(to_string(SmoothStatus::improved) == "improved");
}

TEST_CASE("an empty report says that nothing happened", "[report]") {
    const SmoothReport report;
    CHECK(report.status == SmoothStatus::unchanged);
    CHECK(report.inverted_before == 0);
    CHECK(report.inverted_after == 0);
    CHECK(report.inverted_ids.empty());
    CHECK(report.moved_nodes == 0);
}
