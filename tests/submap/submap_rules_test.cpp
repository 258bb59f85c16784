#include <pavior/glpk/solve_program.hpp>
#include <pavior/lattice/submap_lattice.hpp>
#include <pavior/submap/submap_rules.hpp>

#include "support/catch.hpp"
#include "support/voxel_brep.hpp"

#include <pavior/submap/submap_recognition.hpp>

#include <limits>

using namespace pavior;
using namespace pavior::test;

namespace {

struct Setup {
    explicit Setup(const Voxels& voxels, double size = 1.0) : model(voxels) {
        REQUIRE(model.sound());
        options.size = size;
        submaps = recognise_submaps(model.brep(), model.solids(), {}, GlpkSolver{});
        solids = model.solids();
        builder.emplace(model.brep(), std::span<const SweepTopology>{}, options, solids);
        rules.emplace(model.brep(), submaps, *builder, options);
    }
    VoxelBrep model;
    IntervalOptions options;
    SubmapModel submaps;
    std::vector<SolidId> solids;
    std::optional<detail::IntervalBuilder<TestBrep>> builder;
    std::optional<detail::SubmapRules<TestBrep>> rules;

    /// Whether the lengths in a unit lattice satisfy all rules.
    [[nodiscard]] bool satisfied() const {
        bool result = true;
        for (const IntervalRule& rule : builder->system().rules) {
            int sum = 0;
            for (const auto& [edge, coefficient] : rule.terms) {
                sum += coefficient * static_cast<int>(std::lround(builder->system().edges[edge].wish));
            }
            result = result && (rule.kind == IntervalRule::Kind::equal ? sum == rule.value : sum >= rule.value);
        }
        return result;
    }
};

}  // namespace

TEST_CASE("a box has three independent numbers") {
    Voxels voxels(1, 1, 1);
    voxels.fill({0, 0, 0}, {1, 1, 1}, 1);
    const Setup setup(voxels);
    CHECK(setup.builder->system().edges.size() == 12);
    CHECK(setup.builder->system().rules.size() == 9);
    CHECK(setup.builder->system().rules[0].text.find("opposite sides of face") == 0);
    CHECK(setup.satisfied());
}

TEST_CASE("a boss adds two links, a tunnel two and the rules that tie its ends together") {
    Voxels voxels(3, 3, 2);
    voxels.fill({0, 0, 0}, {3, 3, 1}, 1);
    voxels.fill({1, 1, 1}, {2, 2, 2}, 1);
    const Setup boss(voxels);
    CHECK(boss.builder->system().edges.size() == 24 + 2);
    CHECK(boss.builder->system().rules.size() == 18);
    CHECK(boss.satisfied());
    Voxels drilled(3, 3, 1);
    drilled.fill({0, 0, 0}, {3, 3, 1}, 1);
    drilled.fill({1, 1, 0}, {2, 2, 1}, 0);
    const Setup tunnel(drilled);
    CHECK(tunnel.builder->system().edges.size() == 24 + 4);
    // free: extents of block and tunnel across, place of the tunnel (2 + 2 + 2), one height
    CHECK(tunnel.builder->system().rules.size() == 28 - 7);
    CHECK(tunnel.satisfied());
}

TEST_CASE("levels agree, and ascend where asked") {
    Voxels voxels(4, 3, 2);
    voxels.fill({0, 0, 0}, {4, 3, 1}, 1);
    voxels.fill({1, 0, 1}, {2, 1, 2}, 1);
    voxels.fill({1, 2, 1}, {3, 3, 2}, 1);
    const Setup setup(voxels);
    const double none = std::numeric_limits<double>::infinity();
    const auto agree = setup.rules->level_rules(1e-4, none);
    CHECK(agree.size() == 2);  // the left ends of the two bosses, and their tops
    for (const IntervalRule& rule : agree) {
        CHECK(rule.kind == IntervalRule::Kind::equal);
    }
    std::size_t ascending = 0;
    for (const IntervalRule& rule : setup.rules->level_rules(1e-4, 0.5)) {
        ascending += rule.kind == IntervalRule::Kind::at_least ? 1 : 0;
        CHECK((rule.kind == IntervalRule::Kind::equal || rule.value == 1));
    }
    CHECK(ascending == 4 + 3 + 2);
}

TEST_CASE("layers follow the heights of the vertices") {
    Voxels voxels(3, 1, 2);
    voxels.fill({0, 0, 0}, {3, 1, 1}, 1);
    voxels.fill({1, 0, 1}, {2, 1, 2}, 1);
    voxels.at[0] = {0, 2, 3, 5};
    const Setup setup(voxels);
    std::vector<int> numbers;
    for (const IntervalEdge& edge : setup.builder->system().edges) {
        numbers.push_back(static_cast<int>(std::lround(edge.wish)));
    }
    int first = 0;
    const std::vector<double> widths = setup.rules->layer_widths(0, 0, numbers, first);
    CHECK(widths.size() == 5);
    for (const double w : widths) {
        CHECK(w == Approx(1.0));
    }
}
