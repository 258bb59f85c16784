#include "support/catch.hpp"

#include <pavior/one_to_one/cap_order.hpp>

#include <vector>

using namespace pavior;

namespace {

SweepTopology between(int source, int target) {
    SweepTopology sweep;
    sweep.source = FaceId{source};
    sweep.target = FaceId{target};
    return sweep;
}

std::vector<SweepStep> order(const std::vector<SweepTopology>& sweeps, int meshed = -1) {
    return cap_order(sweeps, [&](FaceId face) { return face.value == meshed; });
}

}  // namespace

TEST_CASE("a single sweep starts at its source") {
    CHECK(order({between(4, 2)}) == std::vector<SweepStep>{{0, false}});
}

TEST_CASE("a cap that is meshed already is where a sweep starts") {
    CHECK(order({between(4, 2)}, 2) == std::vector<SweepStep>{{0, true}});
    CHECK(order({between(1, 2), between(3, 2)}, 2) == std::vector<SweepStep>{{0, true}, {1, true}});
}

TEST_CASE("a chain is walked from one end, whatever way its sweeps point") {
    const std::vector<SweepTopology> sweeps{between(2, 3), between(2, 1), between(4, 3)};
    CHECK(order(sweeps) == std::vector<SweepStep>{{1, true}, {0, false}, {2, true}});
}

TEST_CASE("a closed chain ends with both caps meshed") {
    const std::vector<SweepTopology> sweeps{between(1, 2), between(2, 3), between(3, 1)};
    CHECK(order(sweeps) == std::vector<SweepStep>{{0, false}, {1, false}, {2, false}});
}

TEST_CASE("reversed twice is the same sweep, and reversed once swaps its ends") {
    SweepTopology sweep = between(1, 2);
    sweep.source_outward = false;
    const EdgeChain bottom{{EdgeId{1}, true}, {EdgeId{2}, false}};
    const EdgeChain right{{EdgeId{3}, true}};
    const EdgeChain top{{EdgeId{4}, true}};
    const EdgeChain left{{EdgeId{5}, false}};
    sweep.source_loops = {bottom};
    sweep.target_loops = {top};
    sweep.loops = {{LinkingSide{FaceId{7}, true, bottom, right, top, left}}};
    const SweepTopology back = reversed(sweep);
    CHECK(back.source.value == 2);
    CHECK_FALSE(back.target_outward);
    const LinkingSide& side = back.loops[0][0];
    CHECK(side.bottom == EdgeChain{{EdgeId{4}, false}});
    CHECK(side.right == EdgeChain{{EdgeId{5}, true}});
    CHECK(side.top == EdgeChain{{EdgeId{2}, true}, {EdgeId{1}, false}});
    CHECK(side.left == EdgeChain{{EdgeId{3}, false}});
    CHECK(back.source_loops[0] == side.bottom);
    const SweepTopology again = reversed(back);
    CHECK(again.loops == sweep.loops);
    CHECK(again.source_loops == sweep.source_loops);
    CHECK(again.target_loops == sweep.target_loops);
    CHECK(again.source_outward == sweep.source_outward);
}
