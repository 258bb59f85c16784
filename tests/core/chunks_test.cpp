#include "support/catch.hpp"

#include <pavior/core/chunks.hpp>

#include <numeric>
#include <stdexcept>
#include <utility>

using Pieces = std::vector<std::pair<std::size_t, std::size_t>>;

TEST_CASE("the pieces depend on the grain alone and come in order") {
    for (const unsigned threads : {1U, 2U, 5U}) {
        const auto pieces = pavior::map_chunks(
            {threads}, 10, 4, [](std::size_t begin, std::size_t end) { return std::pair(begin, end); });
        CHECK(pieces == Pieces{{0, 4}, {4, 8}, {8, 10}});
    }
    CHECK(pavior::map_chunks({2}, 0, 4, [](std::size_t, std::size_t) { return 1; }).empty());
}

TEST_CASE("sums of doubles are the same bits for any number of threads") {
    std::vector<double> values(10000);
    for (std::size_t i = 0; i < values.size(); ++i) {
        values[i] = 1.0 / (1.0 + static_cast<double>(i));
    }
    const auto sum = [&](unsigned threads) {
        const auto parts = pavior::map_chunks({threads}, values.size(), 64, [&](std::size_t begin, std::size_t end) {
            const auto at = values.begin();
            return std::accumulate(at + static_cast<std::ptrdiff_t>(begin), at + static_cast<std::ptrdiff_t>(end), 0.0);
        });
        return std::accumulate(parts.begin(), parts.end(), 0.0);
    };
    CHECK(sum(1) == Approx(9.787606036044348).epsilon(1e-13));
    CHECK(sum(1) == sum(2));
    CHECK(sum(1) == sum(7));
}

TEST_CASE("exceptions come out") {
    const auto body = [](std::size_t begin, std::size_t) -> int { throw std::runtime_error(std::to_string(begin)); };
    CHECK_THROWS_WITH(pavior::map_chunks({2}, 100, 10, body), "0");
}
