#include "support/catch.hpp"

#include <pavior/dual/dual_report.hpp>

#include <set>

using namespace pavior;

TEST_CASE("names and sentences") {
    std::set<std::string> names;
    std::set<std::string> sentences;
    for (std::size_t i = 0; i < dual_fault_count; ++i) {
        names.insert(std::string(to_string(static_cast<DualFault>(i))));
        sentences.insert(describe({static_cast<DualFault>(i), {0, 1, 2}}));
    }
    CHECK(names.size() == dual_fault_count);
    CHECK(sentences.size() == dual_fault_count);
    CHECK(to_string(DualFault::corner_not_three_valent) == "corner_not_three_valent");
    CHECK(to_string(DualFault::pinched_node) == "pinched_node");
    CHECK(to_string(DualFault::orphan) == "orphan");
    CHECK(describe({DualFault::chain_one_vertex, {4, 2, no_index}}) == "chain 4 has vertex 2 at both ends");
    CHECK(describe({DualFault::orphan, {2, 7, no_index}}) == "patch 7 belongs to no block");
    CHECK(describe({DualFault::corner_not_three_valent, {1, 0, 4}}) ==
          "the corner of cell 0 at vertex 1 meets 4 chains, not 3");
}

TEST_CASE("reports") {
    DualReport report;
    CHECK(report.valid());
    CHECK(report.text().empty());
    CHECK_NOTHROW(report.throw_if_invalid());
    for (Index i = 0; i < 5; ++i) {
        report.violations.push_back({DualFault::chain_closed, {i, no_index, no_index}});
    }
    CHECK(!report.valid());
    CHECK(report.count(DualFault::chain_closed) == 5);
    CHECK(report.count(DualFault::orphan) == 0);
    CHECK(report.text(2) == "chain 0 is closed and has no vertex\nchain 1 is closed and has no vertex\n... 3 more");
    try {
        report.throw_if_invalid();
        FAIL("no exception");
    } catch (const UnmeshableError& error) {
        CHECK(error.code() == ErrorCode::invalid_dual);
        CHECK(error.ids() == Error::Ids{0});
    }
}
