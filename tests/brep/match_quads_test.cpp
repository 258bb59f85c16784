#include "support/catch.hpp"

#include <pavior/brep/match_quads.hpp>

#include <numeric>
#include <random>
#include <vector>

using namespace pavior;

namespace {

std::vector<QuadCorners> grid(Index columns, Index rows) {
    std::vector<QuadCorners> quads;
    for (Index k = 0; k < rows; ++k) {
        for (Index i = 0; i < columns; ++i) {
            const Index a = k * (columns + 1) + i;
            quads.push_back({a, a + 1, a + columns + 2, a + columns + 1});
        }
    }
    return quads;
}

/// The same mesh with other node numbers, another order of quads and other first corners.
std::vector<QuadCorners> shuffled(std::vector<QuadCorners> quads, const std::vector<Index>& number, unsigned seed) {
    std::mt19937 random(seed);
    for (QuadCorners& quad : quads) {
        for (Index& node : quad) {
            node = number[node];
        }
        std::rotate(quad.begin(), quad.begin() + random() % 4, quad.end());
    }
    std::shuffle(quads.begin(), quads.end(), random);
    return quads;
}

}  // namespace

TEST_CASE("match_quads finds the renumbering of one mesh") {
    const auto a = grid(5, 3);
    for (unsigned seed = 1; seed <= 20; ++seed) {
        std::vector<Index> number(24);
        std::iota(number.begin(), number.end(), Index{0});
        std::shuffle(number.begin(), number.end(), std::mt19937(seed));
        const auto b = shuffled(a, number, seed);
        const std::vector<std::pair<Index, Index>> seed_edge{{0, number[0]}, {1, number[1]}};
        const auto match = match_quads(a, b, 24, seed_edge);
        REQUIRE(match.has_value());
        CHECK(*match == number);
    }
}

TEST_CASE("match_quads refuses what differs") {
    const auto a = grid(4, 4);
    const std::vector<std::pair<Index, Index>> seed{{0, 0}, {1, 1}};
    SECTION("another number of quads") { CHECK_FALSE(match_quads(a, grid(4, 3), 25, seed)); }
    SECTION("another shape with as many quads") { CHECK_FALSE(match_quads(a, grid(8, 2), 25, seed)); }
    SECTION("a seed that contradicts itself") {
        CHECK_FALSE(match_quads(a, a, 25, std::vector<std::pair<Index, Index>>{{0, 0}, {0, 1}, {1, 2}}));
    }
    SECTION("a seed that turns the mesh the wrong way") {
        CHECK_FALSE(match_quads(a, a, 25, std::vector<std::pair<Index, Index>>{{0, 1}, {1, 0}}));
    }
    SECTION("no seed at all") { CHECK_FALSE(match_quads(a, a, 25, {})); }
}

TEST_CASE("match_quads turns a square onto itself") {
    const auto a = grid(4, 4);
    const auto match = match_quads(a, a, 25, std::vector<std::pair<Index, Index>>{{0, 4}, {1, 9}});
    REQUIRE(match);
    CHECK((*match)[12] == 12);
    CHECK((*match)[24] == 20);
}
