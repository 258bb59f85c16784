#include "support/catch.hpp"

#include <pavior/core/progress.hpp>

#include <string>
#include <vector>

TEST_CASE("progress goes to the sink, and nowhere without one") {
    std::vector<std::string> seen;
    const pavior::Progress sink = [&](std::string_view stage, double fraction) {
        seen.push_back(std::string(stage) + " " + std::to_string(static_cast<int>(100.0 * fraction)));
    };
    pavior::report(sink, "levels", 0.25);
    pavior::report(sink, "levels", 1.0);
    CHECK(seen == std::vector<std::string>{"levels 25", "levels 100"});
    CHECK_NOTHROW(pavior::report({}, "levels", 0.5));
}

TEST_CASE("a stage of several reports its share of the whole") {
    std::vector<double> seen;
    const pavior::Progress whole = [&](std::string_view, double fraction) { seen.push_back(fraction); };
    const pavior::Progress half = pavior::stage_of(whole, 0.5, 1.0);
    const pavior::Progress quarter = pavior::stage_of(half, 0.0, 0.5);
    pavior::report(quarter, "first", 0.0);
    pavior::report(quarter, "first", 1.0);
    pavior::report(half, "second", 1.0);
    CHECK(seen == std::vector<double>{0.5, 0.75, 1.0});
    CHECK_FALSE(pavior::stage_of({}, 0.0, 1.0));
}
