#include "support/catch.hpp"

#include <pavior/contributions/matching_rules.hpp>

using namespace pavior;
using enum Contribution;

TEST_CASE("Algorithm 5.6") {
    CHECK(match_face(EntityClass::free) == none);
    CHECK(match_face(EntityClass::layer) == hard);
}

TEST_CASE("Algorithm 5.7") {
    CHECK(match_edge(EntityClass::free, none) == none);
    CHECK(match_edge(EntityClass::layer, none) == soft);
    CHECK(match_edge(EntityClass::layer, hard) == none);
    CHECK(match_edge(EntityClass::stack, none) == soft);
    CHECK(match_edge(EntityClass::stack, hard) == hard);
}

TEST_CASE("Algorithm 5.8, all reachable cases") {
    struct Row {
        EntityClass node, edge;
        Contribution first, second, printed, repaired;
    };
    using C = EntityClass;
    // A free node has free edges only, a layer node no stack edges.
    const Row rows[] = {
        {C::free, C::free, none, none, none, none},        {C::layer, C::free, none, none, soft, soft},
        {C::layer, C::layer, soft, soft, none, none},      {C::layer, C::layer, soft, none, none, none},
        {C::layer, C::layer, none, none, soft, none},  // both faces of the edge carry face contributions
        {C::stack, C::free, none, none, soft, soft},       {C::stack, C::layer, soft, none, soft, soft},
        {C::stack, C::layer, none, none, soft, soft},      {C::stack, C::stack, soft, soft, soft, soft},
        {C::stack, C::stack, hard, soft, none, none},      {C::stack, C::stack, hard, hard, none, none},
        {C::hexahedron, C::free, none, none, soft, soft},  {C::hexahedron, C::layer, soft, none, soft, soft},
        {C::hexahedron, C::layer, none, none, soft, soft}, {C::hexahedron, C::stack, soft, soft, soft, soft},
        {C::hexahedron, C::stack, soft, hard, hard, hard}, {C::hexahedron, C::stack, hard, hard, hard, hard},
    };
    for (const Row& row : rows) {
        CHECK(match_vertex(row.node, row.edge, row.first, row.second, VertexRule::printed) == row.printed);
        CHECK(match_vertex(row.node, row.edge, row.first, row.second) == row.repaired);
        CHECK(match_vertex(row.node, row.edge, row.second, row.first) == row.repaired);
    }
}
