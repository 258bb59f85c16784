#include <pavior/one_to_one/interval_rules.hpp>
#include <pavior/one_to_one/recognition.hpp>

#include "support/catch.hpp"
#include "support/test_brep.hpp"

using namespace pavior;
using namespace pavior::test;

namespace {

std::size_t count(const IntervalSystem& system, IntervalRule::Kind kind) {
    return static_cast<std::size_t>(std::count_if(system.rules.begin(), system.rules.end(),
                                                  [&](const IntervalRule& rule) { return rule.kind == kind; }));
}

}  // namespace

TEST_CASE("A prism with a hole: rules by kind, wishes by length") {
    TestBrep b;
    const SolidId solid = add_prism(b, rectangle(3, 3), 0, 2, {{{1, 1}, {1, 2}, {2, 2}, {2, 1}}});
    const std::vector sweeps{best_sweep(b, solid)};
    IntervalOptions options;
    options.size = 0.5;
    detail::IntervalBuilder<TestBrep> builder(b, sweeps, options);
    const IntervalSystem& system = builder.system();
    REQUIRE(system.edges.size() == b.edge_count());
    for (std::size_t i = 0; i < system.edges.size(); ++i) {
        CHECK(system.edges[i].wish == Approx(b.edge_length(builder.edges()[i]) / 0.5));
        CHECK(system.edges[i].lower == 1);
    }
    CHECK(count(system, IntervalRule::Kind::equal) == 8 * 2 + 1);  // sides, and the layers of hole and outside
    CHECK(count(system, IntervalRule::Kind::even) == 2);
    CHECK(count(system, IntervalRule::Kind::at_least) == 2);
}

TEST_CASE("Seams need no rule, arcs have a least number") {
    TestBrep b;
    const std::vector sweeps{best_sweep(b, add_cylinder(b, 1, 1, 3))};
    IntervalOptions options;
    options.size = 10;
    detail::IntervalBuilder<TestBrep> builder(b, sweeps, options);
    CHECK(count(builder.system(), IntervalRule::Kind::equal) == 1);  // bottom = top; the seam equals itself
    const auto lowest = std::minmax_element(builder.system().edges.begin(), builder.system().edges.end(),
                                            [](const auto& p, const auto& q) { return p.lower < q.lower; });
    CHECK(lowest.first->lower == 1);
    CHECK(lowest.second->lower == 12);  // 30 degrees each
    CHECK(lowest.second->wish == Approx(12).epsilon(0.01));
}

TEST_CASE("Rules name faces and edges by the user's tags") {
    TestBrep b;
    const std::vector sweeps{best_sweep(b, add_prism(b, rectangle(1, 1), 0, 2, {}, 2))};
    IntervalOptions options;
    options.size = 1;
    options.layers = 6;
    detail::IntervalBuilder<TestBrep> builder(b, sweeps, options);
    const auto found = std::find_if(builder.system().rules.begin(), builder.system().rules.end(),
                                    [](const IntervalRule& rule) { return rule.value == 6; });
    REQUIRE(found != builder.system().rules.end());
    CHECK(found->text == "solid 1 has 6 layers");
    CHECK(found->terms.size() == 2);  // one rib of each storey
    CHECK(found->faces.size() == 2);
}
