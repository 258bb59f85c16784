#include <pavior/core/error.hpp>
#include <pavior/lattice/submap_corners.hpp>

#include "support/catch.hpp"

#include <random>

using namespace pavior;

namespace {

std::vector<int> turns(const LoopClasses& loop) {
    std::vector<int> result;
    for (const CornerClass c : loop.classes) {
        result.push_back(quarter_turns(c));
    }
    return result;
}

/// Least cost of all combinations, infinity if none sums up.
double brute_force(const std::vector<double>& angles, int turning, const CornerOptions& options) {
    double best = std::numeric_limits<double>::infinity();
    std::vector<std::size_t> at(angles.size(), 0);
    for (;;) {
        int sum = 0;
        double cost = 0.0;
        for (std::size_t i = 0; i < angles.size(); ++i) {
            const std::vector<CornerClass> allowed = corner_classes(angles[i], options);
            if (allowed.empty()) {
                return best;
            }
            sum += quarter_turns(allowed[at[i]]);
            cost += corner_cost(angles[i], allowed[at[i]]);
        }
        best = sum == turning ? std::min(best, cost) : best;
        std::size_t i = 0;
        while (i < angles.size() && ++at[i] == corner_classes(angles[i], options).size()) {
            at[i++] = 0;
        }
        if (i == angles.size()) {
            return best;
        }
    }
}

}  // namespace

TEST_CASE("right angles take their own classes") {
    const std::vector<double> l_shape{90, 90, 180, 90, 270, 90, 90};
    const auto found = classify_loop(l_shape, 4);
    REQUIRE(found);
    CHECK(turns(*found) == std::vector<int>{1, 1, 0, 1, -1, 1, 1});
    CHECK(found->cost == 0.0);
    CHECK(turns(*classify_loop(std::vector<double>{270, 270, 180, 270, 270}, -4)) ==
          std::vector<int>{-1, -1, 0, -1, -1});
}

TEST_CASE("a loop is judged as a whole: the corner that must give way is the one nearest to it") {
    // rounded one by one, 133 and 134 would both be ends and the loop would turn by five right angles
    const auto found = classify_loop(std::vector<double>{90, 90, 90, 133, 134, 183}, 4);
    REQUIRE(found);
    CHECK(turns(*found) == std::vector<int>{1, 1, 1, 1, 0, 0});
    // one by one 137 is a side; here four ends are needed
    const auto square = classify_loop(std::vector<double>{137, 80, 70, 73}, 4);
    REQUIRE(square);
    CHECK(turns(*square) == std::vector<int>{1, 1, 1, 1});
}

TEST_CASE("loops that no classes fit") {
    CHECK_FALSE(classify_loop(std::vector<double>{60, 60, 60}, 4));
    CHECK_FALSE(classify_loop(std::vector<double>{90, 90, 90, 10, 270}, 4));  // 10 degrees admits no class
    CHECK_FALSE(classify_loop(std::vector<double>{180}, -4));
    CHECK_FALSE(classify_loop(std::vector<double>{}, 4));
    CHECK(classify_loop(std::vector<double>{}, 0));
}

TEST_CASE("reversals count only where asked for") {
    const std::vector<double> notch{90, 90, 90, 90, 90, 350, 90};
    CHECK_FALSE(classify_loop(notch, 4));
    const auto found = classify_loop(notch, 4, {60.0, true});
    REQUIRE(found);
    CHECK(found->classes[5] == CornerClass::reversal);
}

TEST_CASE("the cost is the least of all combinations") {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> angle(40, 340);
    int solved = 0;
    for (int round = 0; round < 300; ++round) {
        std::vector<double> angles(3 + static_cast<std::size_t>(round) % 5);
        for (double& a : angles) {
            a = angle(random);
        }
        const CornerOptions options{round % 2 == 0 ? 60.0 : 90.0, round % 3 == 0};
        for (const int turning : {4, -4, 0}) {
            const auto found = classify_loop(angles, turning, options);
            const double best = brute_force(angles, turning, options);
            REQUIRE(found.has_value() == std::isfinite(best));
            if (found) {
                ++solved;
                CHECK(found->cost == Approx(best).margin(1e-12));
                int sum = 0;
                for (const int t : turns(*found)) {
                    sum += t;
                }
                CHECK(sum == turning);
            }
        }
    }
    CHECK(solved > 50);
}

TEST_CASE("options and angles out of range") {
    CHECK_THROWS_AS(classify_loop(std::vector<double>{90}, 4, {0.0, false}), InputError);
    CHECK_THROWS_AS(classify_loop(std::vector<double>{90}, 4, {91.0, false}), InputError);
    CHECK_THROWS_AS(classify_loop(std::vector<double>{90, std::nan("")}, 4), InputError);
}
