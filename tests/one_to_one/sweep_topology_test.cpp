#include <pavior/one_to_one/recognition.hpp>
#include <pavior/one_to_one/sweep_topology.hpp>

#include "support/catch.hpp"
#include "support/test_brep.hpp"

using namespace pavior;
using namespace pavior::test;

TEST_CASE("Chains run backwards, and know their ends") {
    TestBrep b;
    const VertexId p = b.vertex({0, 0, 0}), q = b.vertex({1, 0, 0}), r = b.vertex({1, 1, 0});
    const EdgeChain chain{{b.line(p, q), true}, {b.line(r, q), false}};
    CHECK(first_vertex(b, chain.front()) == p);
    CHECK(last_vertex(b, chain.back()) == r);
    const EdgeChain back = reversed(chain);
    CHECK(first_vertex(b, back.front()) == r);
    CHECK(last_vertex(b, back.back()) == p);
    CHECK(reversed(back) == chain);
    CHECK(reversed(EdgeChain{}).empty());
    CHECK(chain_intervals(chain, std::vector{3, 4}) == 7);
}

TEST_CASE("Sides side by side are placed one after the other") {
    TestBrep b;
    const SweepTopology sweep = best_sweep(b, add_prism(b, l_shape(), 0, 1));
    std::vector<int> intervals(b.edge_count(), 5);
    for (std::size_t j = 0; j < 6; ++j) {
        const LinkingSide& side = sweep.loops[0][j];
        intervals[side.bottom[0].edge.index()] = intervals[side.top[0].edge.index()] = static_cast<int>(j) + 1;
    }
    const auto placed = place_sides(sweep, intervals);
    int column = 0;
    for (std::size_t j = 0; j < 6; ++j) {
        CHECK(placed[0][j] == SidePlacement{column, 0, static_cast<int>(j) + 1, 5});
        column += static_cast<int>(j) + 1;
    }
}

TEST_CASE("A round wall covers all columns") {
    TestBrep b;
    const SweepTopology sweep = best_sweep(b, add_cylinder(b, 2, 2, 3, 1));
    const auto placed = place_sides(sweep, std::vector<int>(b.edge_count(), 9));
    CHECK(placed == std::vector<std::vector<SidePlacement>>{{{0, 0, 9, 9}}, {{0, 0, 9, 9}}});
}

TEST_CASE("Storeys fill the grid of their loop exactly once") {
    TestBrep b;
    const SweepTopology sweep = best_sweep(b, add_prism(b, l_shape(), 0, 3, {}, 3));
    std::vector<int> intervals(b.edge_count());
    for (const LinkingSide& side : sweep.loops[0]) {
        const double z = b.vertex_point(first_vertex(b, side.left[0]))[2];
        intervals[side.left[0].edge.index()] = intervals[side.right[0].edge.index()] = z < 0.5 ? 1 : z < 1.5 ? 2 : 3;
        intervals[side.bottom[0].edge.index()] = intervals[side.top[0].edge.index()] =
            static_cast<int>(std::lround(2 * b.edge_length(side.bottom[0].edge)));
    }
    const auto placed = place_sides(sweep, intervals);
    const int columns = chain_intervals(sweep.source_loops[0], intervals);
    CHECK(columns == 16);
    std::vector<int> covered(static_cast<std::size_t>(columns * 6), 0);
    for (const SidePlacement& side : placed[0]) {
        for (int i = 0; i < side.columns; ++i) {
            for (int k = 0; k < side.rows; ++k) {
                ++covered.at(static_cast<std::size_t>((side.row + k) * columns + (side.column + i) % columns));
            }
        }
    }
    CHECK(std::all_of(covered.begin(), covered.end(), [](int n) { return n == 1; }));
}

TEST_CASE("Numbers that do not fit are refused with the face") {
    TestBrep b;
    const SweepTopology sweep = best_sweep(b, add_prism(b, rectangle(1, 2), 0, 1));
    std::vector<int> intervals(b.edge_count(), 2);
    const LinkingSide& side = sweep.loops[0][2];
    intervals[side.bottom[0].edge.index()] = 3;
    try {
        (void)place_sides(sweep, intervals);
        FAIL("accepted");
    } catch (const InputError& e) {
        CHECK(e.code() == ErrorCode::bad_index);
        CHECK(e.ids() == Error::Ids{side.face.value});
    }
    CHECK_THROWS_AS(place_sides(sweep, std::vector<int>(b.edge_count(), 0)), InputError);
}
