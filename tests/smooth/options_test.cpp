#include <pavior/core/error.hpp>
#include <pavior/smooth/options.hpp>

#include "support/catch.hpp"

#include <cmath>

using namespace pavior;

TEST_CASE("the default options of untangling are valid, others are checked", "[options]") {
    const auto refused = [](auto spoil) {
        UntangleOptions options;
        spoil(options);
        try {
            detail::check_options(options);
        } catch (const InputError& error) {
            return error.code() == ErrorCode::bad_option;
        }
        return false;
    };
    CHECK_FALSE(refused([](UntangleOptions&) {}));
    CHECK(refused([](UntangleOptions& o) { o.max_iterations = 0; }));
    CHECK(refused([](UntangleOptions& o) { o.inner_iterations = -1; }));
    CHECK(refused([](UntangleOptions& o) { o.theta = -1.0; }));
    CHECK(refused([](UntangleOptions& o) { o.theta = INFINITY; }));
    CHECK(refused([](UntangleOptions& o) { o.sufficient_det = -0.1; }));
    CHECK(refused([](UntangleOptions& o) { o.sufficient_det = NAN; }));
    CHECK_FALSE(refused([](UntangleOptions& o) { o.sufficient_det = 0.0; }));
}
