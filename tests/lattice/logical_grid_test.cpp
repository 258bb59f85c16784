#include <pavior/lattice/logical_grid.hpp>

#include "support/catch.hpp"

#include <set>

using namespace pavior;

namespace {

/// The boundary of a set of cells.
template <std::size_t D>
std::vector<LatticeFacet<D>> boundary(const std::set<LatticePoint<D>>& cells) {
    std::vector<LatticeFacet<D>> result;
    for (const LatticePoint<D>& c : cells) {
        for (std::size_t a = 0; a < D; ++a) {
            for (const int side : {0, 1}) {
                LatticePoint<D> next = c;
                next[a] += side == 0 ? -1 : 1;
                if (!cells.contains(next)) {
                    LatticePoint<D> low = c;
                    low[a] += side;
                    result.push_back({low, static_cast<int>(a), side == 0 ? -1 : 1, static_cast<Index>(a)});
                }
            }
        }
    }
    return result;
}

template <std::size_t D>
std::set<LatticePoint<D>> cells_of(const LogicalGrid<D>& grid) {
    std::set<LatticePoint<D>> result;
    grid.for_each_cell([&](const LatticePoint<D>& c) { result.insert(c); });
    return result;
}

}  // namespace

TEST_CASE("nodes and cells of an L are numbered along the first axis") {
    const std::set<LatticePoint<2>> cells{{0, 0}, {1, 0}, {0, 1}};
    const auto facets = boundary(cells);
    const LogicalGrid<2> grid(facets);
    REQUIRE(grid.ok());
    CHECK(grid.cell_count() == 3);
    CHECK(grid.node_count() == 8);
    CHECK(grid.node({2, 1}) == 5);
    CHECK(grid.node({0, 2}) == 6);
    CHECK(grid.node({2, 2}) == no_index);
    CHECK(grid.node({-1, 0}) == no_index);
    CHECK(cells_of(grid) == cells);
    CHECK(grid.low() == LatticePoint<2>{0, 0});
    CHECK(grid.high() == LatticePoint<2>{2, 2});
    Index next = 0;
    grid.for_each_node([&](Index n, const LatticePoint<2>& p) {
        CHECK(n == next++);
        CHECK(grid.node(p) == n);
    });
    CHECK(next == 8);
}

TEST_CASE("a hole and negative coordinates") {
    std::set<LatticePoint<2>> cells;
    for (int i = -2; i < 3; ++i) {
        for (int j = -3; j < 1; ++j) {
            cells.insert({i, j});
        }
    }
    cells.erase({0, -2});
    const auto facets = boundary(cells);
    const LogicalGrid<2> grid(facets);
    REQUIRE(grid.ok());
    CHECK(cells_of(grid) == cells);
    CHECK(grid.inner({-1, -1}));
    CHECK_FALSE(grid.inner({0, -2}));
    CHECK_FALSE(grid.inner({-2, 0}));
    CHECK(grid.node_count() == 6 * 5);
}

TEST_CASE("a union of cubes with a tunnel and a void") {
    std::set<LatticePoint<3>> cells;
    for (int i = 0; i < 5; ++i) {
        for (int j = 0; j < 5; ++j) {
            for (int k = 0; k < 5; ++k) {
                cells.insert({i, j, k});
            }
        }
    }
    for (int k = 0; k < 5; ++k) {
        cells.erase({1, 1, k});
    }
    cells.erase({3, 3, 3});
    const auto facets = boundary(cells);
    const LogicalGrid<3> grid(facets);
    REQUIRE(grid.ok());
    CHECK(cells_of(grid) == cells);
    CHECK(grid.cell_count() == 119);
    CHECK(grid.node_count() == 216);
    std::size_t inner = 0;
    grid.for_each_node([&](Index, const LatticePoint<3>& p) { inner += grid.inner(p) ? 1 : 0; });
    CHECK(inner == 64 - 16 - 8);
}

TEST_CASE("cells covered twice and open boundaries are reported with their entities") {
    auto facets = boundary(std::set<LatticePoint<2>>{{0, 0}, {1, 0}});
    auto more = boundary(std::set<LatticePoint<2>>{{1, 0}, {2, 0}});
    for (auto& f : facets) {
        f.entity = 7;
    }
    for (auto& f : more) {
        f.entity = 9;
    }
    auto both = facets;
    both.insert(both.end(), more.begin(), more.end());
    const LogicalGrid<2> twice(both);
    CHECK_FALSE(twice.ok());
    CHECK(twice.overlap() == std::vector<Index>{7, 9});
    std::erase_if(facets, [](const auto& f) { return f.axis == 0 && f.outward > 0; });
    const LogicalGrid<2> open(facets);
    CHECK(open.overlap() == std::vector<Index>{7});
    CHECK_THROWS_AS(LogicalGrid<2>(std::span<const LatticeFacet<2>>{}), InputError);
}

TEST_CASE("a box of too many points is refused before memory is taken") {
    std::vector<LatticeFacet<3>> facets{{{0, 0, 0}, 0, -1, 0}, {{2'000'000, 2'000'000, 2'000'000}, 0, 1, 0}};
    CHECK_THROWS_AS(LogicalGrid<3>(facets), InputError);
}
