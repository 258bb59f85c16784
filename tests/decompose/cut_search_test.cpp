#include "support/catch.hpp"

#include <pavior/decompose/cut_search.hpp>

using namespace pavior;

TEST_CASE("A search that found nothing has no cuts and no quality") {
    const CutSearch none;
    CHECK(none.cuts.empty());
    CHECK(none.quality < 0);
    CHECK(none.tried == 0);
    CHECK(none.meshed == 0);
}

TEST_CASE("Limits of a search let it work, and nothing stops it unasked") {
    const CutSearchOptions options;
    CHECK(options.max_cuts > 0);
    CHECK(options.max_meshes > 0);
    CHECK(options.max_pieces > 1);
    CHECK(options.sufficient > 0);
    CHECK(options.sufficient < 1);
    CHECK_FALSE(options.stop.stop_requested());
    CHECK(cost({}, options.costs) == cost({}));
}
