#include "support/catch.hpp"

#include <pavior/decompose/piece_methods.hpp>

using namespace pavior;

TEST_CASE("Any of three methods takes a piece, or none does") {
    CHECK_FALSE(PieceMethods{}.any());
    CHECK(PieceMethods{.submap = true}.any());
    CHECK(PieceMethods{.sweep = true}.any());
    CHECK(PieceMethods{.multi_sweep = true}.any());
    CHECK_FALSE(PieceMethods{.leaning = 0, .cusps = 1}.any());
}

TEST_CASE("Pieces cost the less, the more of them is meshed with what is simple") {
    const double submap = cost({.submap = true});
    const double multi_sweep = cost({.multi_sweep = true});
    CHECK(submap > 0);
    CHECK(cost({.sweep = true}) == submap);
    CHECK(cost({.submap = true, .multi_sweep = true}) == submap);
    CHECK(multi_sweep > submap);
    CHECK(cost({}) > multi_sweep);
    CHECK(cost({.leaning = 1}) >= cost({}));
    CHECK(cost({.leaning = 3}) > cost({.leaning = 2}));
    CHECK(cost({.submap = true, .cusps = 1}) > submap);
    CHECK(cost({.submap = true, .leaning = 5}) == submap);  // what is taken leans to nothing
}

TEST_CASE("Costs are those that are asked for") {
    const CutCosts costs{.piece = 1, .multi_sweep = 10, .refused = 100, .leaning = 1000, .cusp = 10000};
    CHECK(cost({.submap = true}, costs) == 1);
    CHECK(cost({.multi_sweep = true}, costs) == 11);
    CHECK(cost({.leaning = 2}, costs) == 2101);
    CHECK(cost({.sweep = true, .cusps = 3}, costs) == 30001);
    CHECK(cost({.leaning = 1, .cusps = 1}, costs) == 11101);
}

TEST_CASE("What meshing a piece by itself brings counts") {
    CHECK_FALSE(PieceMethods{.submap = true, .quality = -1}.any());
    CHECK(PieceMethods{.multi_sweep = true, .quality = 0.5}.only_multi_sweep());
    CHECK_FALSE(PieceMethods{.sweep = true, .multi_sweep = true}.only_multi_sweep());
    const double good = cost({.sweep = true, .quality = 0.5});
    CHECK(good == cost({.sweep = true}));
    CHECK(cost({.sweep = true, .quality = 0.1}) > good);
    CHECK(cost({.sweep = true, .quality = -1}) > cost({.sweep = true, .quality = 0.1}));
}
