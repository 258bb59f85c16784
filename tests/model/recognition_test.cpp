#include <pavior/model/recognition.hpp>

#include "support/catch.hpp"
#include "support/test_brep.hpp"

using namespace pavior;
using namespace pavior::test;

static_assert(brep<TestBrep>);

namespace {

/// Everything that SweepTopology promises, checked against the model.
void verify(const TestBrep& b, const SweepTopology& sweep) {
    const auto chain_ok = [&](const EdgeChain& chain) {
        REQUIRE(!chain.empty());
        for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
            CHECK(last_vertex(b, chain[i]) == first_vertex(b, chain[i + 1]));
        }
    };
    std::size_t faces = 2;
    REQUIRE(sweep.source_loops.size() == sweep.loops.size());
    REQUIRE(sweep.target_loops.size() == sweep.loops.size());
    for (std::size_t i = 0; i < sweep.loops.size(); ++i) {
        const auto& sides = sweep.loops[i];
        faces += sides.size();
        EdgeLoop bottoms, tops;
        for (std::size_t j = 0; j < sides.size(); ++j) {
            const LinkingSide& s = sides[j];
            for (const EdgeChain* chain : {&s.bottom, &s.right, &s.top, &s.left}) {
                chain_ok(*chain);
            }
            CHECK(first_vertex(b, s.bottom.front()) == first_vertex(b, s.left.front()));
            CHECK(last_vertex(b, s.bottom.back()) == first_vertex(b, s.right.front()));
            CHECK(last_vertex(b, s.left.back()) == first_vertex(b, s.top.front()));
            CHECK(last_vertex(b, s.right.back()) == last_vertex(b, s.top.back()));
            bottoms.insert(bottoms.end(), s.bottom.begin(), s.bottom.end());
            tops.insert(tops.end(), s.top.begin(), s.top.end());
            if (!sweep.stacked) {
                CHECK(s.right == sides[(j + 1) % sides.size()].left);
            }
        }
        chain_ok(sweep.source_loops[i]);
        chain_ok(sweep.target_loops[i]);
        CHECK(last_vertex(b, sweep.source_loops[i].back()) == first_vertex(b, sweep.source_loops[i].front()));
        if (!sweep.stacked) {
            CHECK(bottoms == sweep.source_loops[i]);
            CHECK(tops == sweep.target_loops[i]);
        }
    }
    CHECK(faces == b.solid_faces(sweep.solid).size());
}

}  // namespace

TEST_CASE("A box can be swept along each of its axes") {
    TestBrep b;
    const SolidId box = add_prism(b, rectangle(2, 3), 0, 4);
    const Recognition r = recognise_sweeps(b, box);
    REQUIRE(r.candidates.size() == 3);
    CHECK(r.refusals.empty());
    for (const SweepTopology& sweep : r.candidates) {
        verify(b, sweep);
        CHECK(sweep.source < sweep.target);
        CHECK_FALSE(sweep.stacked);
    }
    CHECK(r.candidates[0].source == FaceId{0});
    CHECK(r.candidates[0].target == FaceId{1});
}
