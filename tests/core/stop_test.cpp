#include "support/catch.hpp"

#include <pavior/core/error.hpp>
#include <pavior/core/index.hpp>
#include <pavior/core/stop.hpp>

#include <cstddef>
#include <span>
#include <stop_token>
#include <string>
#include <type_traits>
#include <vector>

TEST_CASE("check_stop throws once the source asks for it, and never without a source") {
    std::stop_source source;
    const std::stop_token token = source.get_token();
    CHECK_NOTHROW(pavior::check_stop(token));
    CHECK_NOTHROW(pavior::check_stop({}));
    source.request_stop();
    CHECK_THROWS_AS(pavior::check_stop(token), pavior::Stopped);
    CHECK_THROWS_AS(pavior::check_stop(token), std::exception);
    CHECK_NOTHROW(pavior::check_stop({}));
}

TEST_CASE("a stoppable range gives its items and ends between them") {
    std::vector<pavior::Index> seen;
    const std::stop_token nobody;
    for (const pavior::Index i : pavior::stoppable(pavior::IndexRange(3000), nobody)) {
        seen.push_back(i);
    }
    REQUIRE(seen.size() == 3000);
    CHECK(seen.front() == 0);
    CHECK(seen.back() == 2999);

    std::stop_source source;
    const std::stop_token stop = source.get_token();
    std::size_t count = 0;
    const auto run = [&](std::size_t ask_at) {
        for (const pavior::Index i : pavior::stoppable(std::span<const pavior::Index>(seen), stop)) {
            count = i;
            if (i == ask_at) {
                source.request_stop();
            }
        }
    };
    CHECK_NOTHROW(run(4000));
    CHECK_THROWS_AS(run(1500), pavior::Stopped);
    CHECK(count == 2047);
    count = 7;
    CHECK_THROWS_AS(run(4000), pavior::Stopped);
    CHECK(count == 7);
}

TEST_CASE("a stop is no error") {
    CHECK_FALSE(std::is_base_of_v<pavior::Error, pavior::Stopped>);
    CHECK(std::string(pavior::Stopped().what()).substr(0, 8) == "stopped:");
}
