#include "support/catch.hpp"

#include <pavior/core/execution.hpp>

using pavior::Execution;

TEST_CASE("by default one thread works and nobody can stop it") {
    const Execution execution;
    CHECK(execution.threads == 1);
    CHECK_FALSE(execution.stop.stop_possible());
    CHECK(pavior::sequential.threads == 1);
    CHECK_FALSE(pavior::sequential.stop.stop_possible());
    CHECK(pavior::parallel.threads == 0);  // one per hardware thread
    CHECK_FALSE(pavior::parallel.stop.stop_possible());
}

TEST_CASE("an execution carries the token of its source, copies too") {
    std::stop_source source;
    const Execution execution{3, source.get_token()};
    const Execution copy = execution;
    CHECK(copy.threads == 3);
    CHECK(copy.stop.stop_possible());
    CHECK_FALSE(copy.stop.stop_requested());
    source.request_stop();
    CHECK(execution.stop.stop_requested());
    CHECK(copy.stop.stop_requested());
}
