#include <pavior/glpk/solve_program.hpp>
#include <pavior/submap/submap_distances.hpp>

#include "support/catch.hpp"
#include "support/voxel_brep.hpp"

#include <pavior/submap/submap_recognition.hpp>
#include <pavior/submap/submap_rules.hpp>

using namespace pavior;
using namespace pavior::test;

namespace {

/// The distance rules of a voxel solid when every edge has as many intervals as `number` says of its length.
template <class F>
std::vector<IntervalRule> rules(const Voxels& voxels, double margin, F&& number) {
    const VoxelBrep model(voxels);
    REQUIRE(model.sound());
    IntervalOptions options;
    options.size = 1.0;
    const SubmapModel submaps = recognise_submaps(model.brep(), model.solids(), {}, GlpkSolver{});
    const std::vector<SolidId> solids = model.solids();
    detail::IntervalBuilder<TestBrep> builder(model.brep(), {}, options, solids);
    const detail::SubmapRules<TestBrep> all(model.brep(), submaps, builder, options);
    std::vector<int> numbers;
    for (const IntervalEdge& edge : builder.system().edges) {
        numbers.push_back(number(edge.wish));
    }
    return detail::SubmapDistances<TestBrep>(model.brep(), submaps, all.solids()).rules(numbers, margin);
}

int rounded(double length) { return static_cast<int>(std::lround(length)); }

}  // namespace

TEST_CASE("nothing to say where the lattice is that of the solid") {
    Voxels voxels(5, 3, 3);
    voxels.fill({0, 0, 0}, {5, 3, 3}, 1);
    voxels.fill({1, 1, 0}, {2, 2, 1}, 0);
    voxels.fill({1, 1, 2}, {2, 2, 3}, 0);
    voxels.fill({3, 1, 0}, {4, 2, 3}, 0);
    CHECK(rules(voxels, 0.0, rounded).empty());
}

TEST_CASE("pockets from both sides that meet on the lattice are told by their floors") {
    Voxels voxels(3, 3, 3);
    voxels.fill({0, 0, 0}, {3, 3, 3}, 1);
    voxels.fill({1, 1, 0}, {2, 2, 1}, 0);
    voxels.fill({1, 1, 2}, {2, 2, 3}, 0);
    voxels.at[2] = {0, 2, 3, 5};
    const auto found = rules(voxels, 0.0, [](double length) { return length > 4 ? 4 : rounded(length); });
    REQUIRE(found.size() == 1);
    CHECK(found[0].kind == IntervalRule::Kind::at_least);
    CHECK(found[0].value == 1);
    CHECK(found[0].faces.size() == 2);
    CHECK(found[0].text.find("lie at least one element apart") != std::string::npos);
}

TEST_CASE("pockets past each other may overlap in depth") {
    Voxels voxels(5, 3, 3);
    voxels.fill({0, 0, 0}, {5, 3, 3}, 1);
    voxels.fill({1, 1, 0}, {2, 2, 2}, 0);
    voxels.fill({3, 1, 1}, {4, 2, 3}, 0);
    CHECK(rules(voxels, 0.0, rounded).empty());
}

TEST_CASE("a hole pushed out of its face is told by edges of the face") {
    Voxels voxels(4, 3, 2);
    voxels.fill({0, 0, 0}, {4, 3, 1}, 1);
    voxels.fill({1, 1, 1}, {3, 2, 2}, 1);  // a boss: no faces look at each other across the top face
    const auto found = rules(voxels, 0.0, [](double length) { return length > 3.5 ? 3 : rounded(length); });
    REQUIRE(!found.empty());
    for (const IntervalRule& rule : found) {
        CHECK(rule.faces.size() == 1);
        CHECK(rule.text.find("of face") != std::string::npos);
    }
}

TEST_CASE("the margin brings in what lies beside") {
    Voxels voxels(5, 3, 3);
    voxels.fill({0, 0, 0}, {5, 3, 3}, 1);
    voxels.fill({1, 1, 0}, {2, 2, 1}, 0);  // a pocket from below and one from above, 2 apart
    voxels.fill({3, 1, 2}, {4, 2, 3}, 0);
    voxels.at[0] = {0, 1, 2, 4, 5, 6};
    voxels.at[2] = {0, 2, 3, 5};
    const auto found = [&](double margin) {
        return rules(voxels, margin, [](double length) {
            return length > 5.5 ? 6 : length > 4.5 ? 4 : rounded(length);
        });
    };
    CHECK(found(0.0).empty());
    CHECK(found(1.9).empty());
    const std::vector<IntervalRule> beside = found(2.1);
    REQUIRE(beside.size() == 1);
    CHECK(beside[0].faces.size() == 2);
}

TEST_CASE("outlines meet where they have common inner points") {
    detail::SideOutline a, b;
    const auto square = [](double x, double y, double size) {
        detail::SideOutline outline;
        outline.loops = {{{x, y}, {x + size, y}, {x + size, y + size}, {x, y + size}}};
        outline.low = {x, y};
        outline.high = {x + size, y + size};
        outline.cuts = {std::vector<double>{x, x, x + size, x + size}, std::vector<double>{y, y, y + size, y + size}};
        return outline;
    };
    CHECK(square(0, 0, 2).meets(square(1, 1, 2), 0.0));
    CHECK_FALSE(square(0, 0, 2).meets(square(2, 0, 2), 0.0));
    CHECK(square(0, 0, 2).meets(square(2, 0, 2), 0.1));
    CHECK_FALSE(square(0, 0, 2).meets(square(3, 0, 2), 0.5));
    detail::SideOutline framed = square(0, 0, 4);
    framed.loops.push_back({{1, 1}, {1, 3}, {3, 3}, {3, 1}});
    framed.cuts = {std::vector<double>{0, 0, 1, 1, 3, 3, 4, 4}, std::vector<double>{0, 0, 1, 1, 3, 3, 4, 4}};
    CHECK_FALSE(framed.meets(square(1.5, 1.5, 1), 0.0));
    CHECK(framed.meets(square(1.5, 1.5, 2), 0.0));
}
