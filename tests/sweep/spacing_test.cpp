#include "support/catch.hpp"

#include <pavior/sweep/spacing.hpp>

#include <cmath>
#include <limits>
#include <vector>

using pavior::ErrorCode;
using pavior::InputError;
using pavior::Spacing;

namespace {

template <class Make>
ErrorCode code_of(Make&& make) {
    try {
        static_cast<void>(make());
    } catch (const InputError& error) {
        return error.code();
    }
    FAIL("no error");
    return ErrorCode::overflow;
}

}  // namespace

TEST_CASE("a default spacing is one interval") {
    CHECK(Spacing().intervals() == 1);
    CHECK(Spacing() == Spacing::uniform(1));
}

TEST_CASE("uniform spacing is i / n to the last bit") {
    for (const std::size_t n : {1U, 2U, 3U, 7U, 12U, 1000U}) {
        const Spacing spacing = Spacing::uniform(n);
        REQUIRE(spacing.intervals() == n);
        for (std::size_t i = 0; i <= n; ++i) {
            CHECK(spacing[i] == static_cast<double>(i) / static_cast<double>(n));
        }
    }
}

TEST_CASE("geometric spacing has constant ratios and exact ends") {
    for (const double ratio : {0.5, 0.9, 1.0 - 1e-9, 1.0 + 1e-9, 1.1, 2.0, 3.0}) {
        const Spacing spacing = Spacing::geometric(12, ratio);
        CHECK(spacing[0] == 0.0);
        CHECK(spacing[12] == 1.0);
        for (std::size_t i = 1; i < 12; ++i) {
            const double now = spacing[i + 1] - spacing[i];
            CHECK(now / (spacing[i] - spacing[i - 1]) == Approx(ratio).epsilon(1e-8));
        }
    }
    CHECK(Spacing::geometric(9, 1.0) == Spacing::uniform(9));
    const Spacing halves = Spacing::geometric(3, 2.0);
    CHECK(halves[1] == Approx(1.0 / 7.0).epsilon(1e-15));
    CHECK(halves[2] == Approx(3.0 / 7.0).epsilon(1e-15));
}

TEST_CASE("given positions are kept, reversed ones mirrored") {
    const Spacing spacing = Spacing::given({0.0, 0.25, 0.5, 1.0});
    CHECK(spacing.intervals() == 3);
    CHECK(spacing.positions()[1] == 0.25);
    CHECK(spacing.reversed() == Spacing::given({0.0, 0.5, 0.75, 1.0}));
    CHECK(spacing.reversed().reversed() == spacing);
}

TEST_CASE("bad spacings are refused with the ids of the positions") {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    CHECK(code_of([] { return Spacing::uniform(0); }) == ErrorCode::bad_option);
    CHECK(code_of([] { return Spacing::geometric(0, 2.0); }) == ErrorCode::bad_option);
    for (const double ratio : {0.0, -1.0, nan, std::numeric_limits<double>::infinity(), 1e-300}) {
        CHECK(code_of([ratio] { return Spacing::geometric(5, ratio); }) == ErrorCode::bad_option);
    }
    const std::vector<std::vector<double>> bad{{},         {0.0},      {0.0, 0.5},      {0.1, 1.0},
                                               {1.0, 0.0}, {0.0, 2.0}, {0.0, nan, 1.0}, {0.0, -0.5, 1.0}};
    for (const auto& positions : bad) {
        CHECK(code_of([&] { return Spacing::given(positions); }) == ErrorCode::bad_option);
    }
    try {
        static_cast<void>(Spacing::given({0.0, 0.5, 0.5, 0.7, 0.6, 1.0}));
        FAIL("no error");
    } catch (const InputError& error) {
        CHECK(error.ids() == std::vector<std::int64_t>{2, 4});
    }
}
