#include <pavior/lattice/submap_topology.hpp>

#include "support/catch.hpp"

using namespace pavior;

TEST_CASE("the outward direction of a side follows its axes and its sense") {
    const SignedAxis i{1}, j{2}, k{3};
    const LogicalSide top{{FaceId{0}, true}, i, j};
    CHECK(top.outward() == k);
    const LogicalSide bottom{{FaceId{0}, false}, i, j};
    CHECK(bottom.outward() == -k);
    CHECK(top.direction(0) == i);
    CHECK(top.direction(1) == j);
    CHECK(top.direction(2) == -i);
    CHECK(top.direction(3) == -j);
}

TEST_CASE("entities are listed in one manner") {
    CHECK(detail::list({3}, "face", "faces") == "face 3");
    CHECK(detail::list({7, 3}, "face", "faces") == "faces 3, 7");
    CHECK(LogicalFace{}.empty());
}
