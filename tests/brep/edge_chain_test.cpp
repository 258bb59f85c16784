#include "support/catch.hpp"
#include "support/test_brep.hpp"

#include <pavior/brep/edge_chain.hpp>

#include <span>

using namespace pavior;

TEST_CASE("the boundary of each face of a prism is a chain, and so is its reverse") {
    test::TestBrep b;
    test::add_prism(b, test::l_shape(), 0.0, 1.0);
    REQUIRE(b.face_count() == 8);
    for (int f = 0; f < static_cast<int>(b.face_count()); ++f) {
        for (const EdgeLoop& loop : b.face_loops(FaceId{f})) {
            const EdgeChain back = reversed(std::span<const OrientedEdge>(loop));
            REQUIRE(back.size() == loop.size());
            for (std::size_t i = 0; i < loop.size(); ++i) {
                const std::size_t next = (i + 1) % loop.size();
                CHECK(first_vertex(b, loop[next]) == last_vertex(b, loop[i]));
                CHECK(first_vertex(b, back[next]) == last_vertex(b, back[i]));
                const OrientedEdge& same = back[loop.size() - 1 - i];
                CHECK(same.edge == loop[i].edge);
                CHECK(same.forward != loop[i].forward);
                CHECK(first_vertex(b, same) == last_vertex(b, loop[i]));
                CHECK(first_vertex(b, loop[i]) != last_vertex(b, loop[i]));
            }
            CHECK(reversed(back) == loop);
        }
    }
}

TEST_CASE("a closed edge begins where it ends, and no chain stays no chain") {
    test::TestBrep b;
    const EdgeId circle = test::add_circle(b, 2.0, 0.0).e;
    for (const bool forward : {true, false}) {
        CHECK(first_vertex(b, {circle, forward}) == last_vertex(b, {circle, forward}));
    }
    CHECK(reversed({}).empty());
}
