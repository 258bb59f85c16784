#include "support/catch.hpp"
#include "support/foreign_meshes.hpp"
#include "support/shapes.hpp"

#include <pavior/mesh/edge_table.hpp>

#include <array>
#include <vector>

using namespace pavior;

namespace {
template <quad_mesh M>
std::vector<std::vector<Index>> listing(const M& mesh, std::span<const char> skip = {}) {
    std::vector<std::vector<Index>> edges;
    EdgeTable(mesh, skip).for_each([&](Index low, Index high, std::span<const EdgeTable::Use> uses) {
        edges.push_back({low, high});
        for (const EdgeTable::Use& use : uses) {
            edges.back().push_back(use.quad);
        }
    });
    return edges;
}
}  // namespace

TEST_CASE("two quads have seven edges") {
    const std::vector<std::vector<Index>> wanted{{0, 1, 0}, {0, 3, 0}, {1, 2, 1}, {1, 4, 0, 1},
                                                 {2, 5, 1}, {3, 4, 0}, {4, 5, 1}};
    CHECK(listing(shapes::grid_cap(2, 1)) == wanted);
    CHECK(listing(archetype::Quads(shapes::grid_cap(2, 1))) == wanted);
    const std::vector<char> skip{1, 0};
    CHECK(listing(shapes::grid_cap(2, 1), skip) ==
          std::vector<std::vector<Index>>{{1, 2, 1}, {1, 4, 1}, {2, 5, 1}, {4, 5, 1}});
    CHECK(listing(QuadMesh{}).empty());
}

TEST_CASE("the sense of an edge in a quad") {
    CHECK(runs_along({3, 7, 5, 1}, 3, 7));
    CHECK_FALSE(runs_along({3, 7, 5, 1}, 7, 3));
    CHECK(runs_along({3, 7, 5, 1}, 1, 3));
    CHECK_FALSE(runs_along({3, 7, 5, 1}, 3, 1));
}

TEST_CASE("a grid of m by n quads has 2 m n + m + n edges") {
    CHECK(listing(shapes::grid_cap(7, 5)).size() == 82);
    CHECK(listing(shapes::annulus(9, 3)).size() == 9 * (3 + 4));
}
