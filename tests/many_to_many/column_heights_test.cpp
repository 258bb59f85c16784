#include "support/catch.hpp"

#include <pavior/many_to_many/column_heights.hpp>

#include <optional>

using namespace pavior;

namespace {
/// A strip of n unit quads.
struct Strip {
    std::vector<Vec2> nodes;
    std::vector<QuadCorners> quads;
    explicit Strip(Index n) {
        for (Index i = 0; i <= n; ++i) {
            nodes.emplace_back(i, 0);
            nodes.emplace_back(i, 1);
        }
        for (Index i = 0; i < n; ++i) {
            quads.push_back({2 * i, 2 * i + 2, 2 * i + 3, 2 * i + 1});
        }
    }
};
}  // namespace

TEST_CASE("ids run level by level over the nodes in use") {
    ColumnNodes nodes(3, 2);
    nodes.use(2, 0);
    nodes.use(0, 1);
    nodes.use(1, 1);
    CHECK(nodes.number() == 3);
    CHECK(nodes(2, 0) == 0);
    CHECK(nodes(0, 1) == 1);
    CHECK(nodes(0, 0) == no_index);
    CHECK(nodes.levels() == 2);
}

TEST_CASE("heights between two given ends are linear on a strip, equal ones stay equal") {
    const Strip strip(4);
    for (const double end : {3.0, 1.0}) {
        std::vector<double> height(10, -1);
        detail::extend_heights(
            strip.nodes, strip.quads, 1e-12,
            [&](Index p) { return p < 2   ? std::optional(1.0)
                                  : p > 7 ? std::optional(end)
                                          : std::nullopt; },
            [&](Index p, double h) { height[p] = h; });
        for (Index p = 2; p < 8; ++p) {
            CHECK(height[p] == Approx(1 + (end - 1) * (p / 2) / 4));
        }
    }
}

TEST_CASE("nodes without a given one in reach are left alone") {
    const Strip strip(2);
    int calls = 0;
    detail::extend_heights(
        strip.nodes, strip.quads, 0, [](Index) { return std::optional<double>(); }, [&](Index, double) { ++calls; });
    CHECK(calls == 0);
}

TEST_CASE("inner nodes follow given ones linearly") {
    std::vector<Vec2> nodes{{0, 0}, {1, 0}, {2, 0}, {2, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}, {1, 1}};
    const std::vector<QuadCorners> quads{{0, 1, 8, 7}, {1, 2, 3, 8}, {8, 3, 4, 5}, {7, 8, 5, 6}};
    const detail::InnerLaplace laplace(nodes, quads, 8);
    Eigen::MatrixX2d given(8, 2);
    for (Eigen::Index i = 0; i < 8; ++i) {
        given.row(i) << 2 * nodes[static_cast<std::size_t>(i)][0], 1 - nodes[static_cast<std::size_t>(i)][1];
    }
    const Eigen::MatrixX2d inner = laplace.solve(given);
    REQUIRE(inner.rows() == 1);
    CHECK(inner(0, 0) == Approx(2));
    CHECK(inner(0, 1) == Approx(0).margin(1e-15));
}

TEST_CASE("a column keeps extended heights that leave room and drops others") {
    ColumnNodes nodes(1, 5);
    for (std::size_t k = 0; k < 5; ++k) {
        nodes.use(0, k);
    }
    (void)nodes.number();
    std::vector<Vec3> places(5, Vec3::Zero());
    std::vector<NodePlace> how(5, NodePlace::none);
    places[4] = {0, 0, 4};
    how[0] = how[4] = NodePlace::cap;
    SECTION("kept") {
        places[1] = {0, 0, 2.5};
        how[1] = NodePlace::extended;
        detail::fill_column(0, 0, 4, nodes, places, how);
        CHECK(places[1][2] == 2.5);
        CHECK(places[2][2] == Approx(3));
    }
    SECTION("dropped") {
        places[1] = {0, 0, 3.9};
        how[1] = NodePlace::extended;
        detail::fill_column(0, 0, 4, nodes, places, how);
        CHECK(places[1][2] == Approx(1));
        CHECK(places[3][2] == Approx(3));
    }
}
