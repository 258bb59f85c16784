#include "support/catch.hpp"

#include <pavior/core/execution.hpp>
#include <pavior/core/parallel_for.hpp>

#include <stdexcept>
#include <vector>

TEST_CASE("parallel_for visits every item once, whatever the threads and the grain") {
    for (const unsigned threads : {1U, 2U, 3U, 8U}) {
        for (const std::size_t grain : {1U, 7U, 64U}) {
            std::vector<int> visits(101, 0);
            pavior::parallel_for({threads}, visits.size(), grain, [&](std::size_t begin, std::size_t end) {
                const bool aligned = begin % grain == 0;
                if (!aligned) {
                    ++visits[begin];
                }
                for (std::size_t i = begin; i < end; ++i) {
                    ++visits[i];
                }
            });
            CHECK(visits == std::vector<int>(101, 1));
        }
    }
}

TEST_CASE("parallel_for of nothing calls nothing") {
    pavior::parallel_for({2}, 0, 1, [](std::size_t, std::size_t) { FAIL("called"); });
}

TEST_CASE("parallel_for rethrows the exception of the lowest piece") {
    const auto throwing = [](std::size_t begin, std::size_t) { throw std::runtime_error(std::to_string(begin)); };
    CHECK_THROWS_WITH(pavior::parallel_for({4}, 100, 1, throwing), "0");
}
