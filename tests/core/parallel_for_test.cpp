#include "support/catch.hpp"

#include <pavior/core/execution.hpp>
#include <pavior/core/parallel_for.hpp>

#include <atomic>
#include <stdexcept>
#include <stop_token>
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

TEST_CASE("parallel_for visits every item once when it may be stopped, and begins at multiples of the grain") {
    for (const unsigned threads : {1U, 3U}) {
        for (const std::size_t count : {1U, 64U, 1000U}) {
            const std::stop_source source;
            std::vector<int> visits(count, 0);
            std::atomic<int> pieces{0};
            pavior::parallel_for({threads, source.get_token()}, count, 7, [&](std::size_t begin, std::size_t end) {
                ++pieces;
                visits[begin] += begin % 7 == 0 ? 0 : 1;
                for (std::size_t i = begin; i < end; ++i) {
                    ++visits[i];
                }
            });
            CHECK(visits == std::vector<int>(count, 1));
            CHECK(pieces <= static_cast<int>(64 * threads));
            CHECK((count < 1000 || pieces > 20));
        }
    }
}

TEST_CASE("parallel_for ends between two pieces when it is asked to stop") {
    for (const unsigned threads : {1U, 4U}) {
        std::stop_source source;
        std::atomic<std::size_t> visited{0};
        CHECK_THROWS_AS(pavior::parallel_for({threads, source.get_token()}, 64000, 1,
                                             [&](std::size_t begin, std::size_t end) {
                                                 visited += end - begin;
                                                 source.request_stop();
                                             }),
                        pavior::Stopped);
        CHECK(visited >= 250);
        CHECK(visited <= 1000 * threads);
        CHECK_THROWS_AS(pavior::parallel_for({threads, source.get_token()}, 0, 1, [](std::size_t, std::size_t) {}),
                        pavior::Stopped);
    }
}
