#include <pavior/intervals/interval_system.hpp>

#include "support/catch.hpp"

using namespace pavior;

TEST_CASE("The cost is the relative deviation, the same for too few as for too many") {
    CHECK(interval_cost(4, 4.0) == 0.0);
    CHECK(interval_cost(8, 4.0) == Approx(1.0));
    CHECK(interval_cost(2, 4.0) == Approx(1.0));
    CHECK(interval_cost(1, 10.0) == Approx(9.0));
    for (const double wish : {1.0, 2.5, 7.3}) {  // convex
        for (int n = 2; n < 20; ++n) {
            CHECK(interval_cost(n - 1, wish) + interval_cost(n + 1, wish) >= 2 * interval_cost(n, wish) - 1e-12);
        }
    }
}
