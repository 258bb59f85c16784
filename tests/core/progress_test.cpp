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
