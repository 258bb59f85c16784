#include "support/catch.hpp"

#include <pavior/core/error.hpp>
#include <pavior/core/stop.hpp>

#include <string>
#include <type_traits>

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

TEST_CASE("a stop is no error") {
    CHECK_FALSE(std::is_base_of_v<pavior::Error, pavior::Stopped>);
    CHECK(std::string(pavior::Stopped().what()).substr(0, 8) == "stopped:");
}
