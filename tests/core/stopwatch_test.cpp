#include "support/catch.hpp"

#include <pavior/core/stopwatch.hpp>

#include <chrono>
#include <thread>

using namespace pavior;

TEST_CASE("laps add up to the total") {
    const Stopwatch untouched;
    Stopwatch watch;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    const double first = watch.lap();
    CHECK(first >= 0.005);
    const double second = watch.lap();
    CHECK(second >= 0.0);
    const double total = watch.total();
    CHECK(total >= first);
    CHECK(first + second <= watch.total());
    CHECK(untouched.total() >= total);
}
