#include <pavior/lattice/grid_laplace.hpp>

#include "support/catch.hpp"

#include <pavior/math/point.hpp>

#include <Eigen/LU>

#include <cstring>
#include <set>

using namespace pavior;

namespace {

/// An n x n x n block without an octant, in facets.
std::vector<LatticeFacet<3>> notched_block(int n) {
    const auto cell = [&](const LatticePoint<3>& c) {
        const bool inside = std::min({c[0], c[1], c[2]}) >= 0 && std::max({c[0], c[1], c[2]}) < n;
        return inside && std::min({c[0], c[1], c[2]}) < n / 2;
    };
    std::vector<LatticeFacet<3>> result;
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
            for (int k = 0; k < n; ++k) {
                for (std::size_t a = 0; a < 3 && cell({i, j, k}); ++a) {
                    LatticePoint<3> below{i, j, k}, above{i, j, k};
                    --below[a];
                    ++above[a];
                    if (!cell(below)) {
                        result.push_back({{i, j, k}, static_cast<int>(a), -1, 0});
                    }
                    if (!cell(above)) {
                        result.push_back({above, static_cast<int>(a), 1, 0});
                    }
                }
            }
        }
    }
    return result;
}

/// Layers of uneven widths.
LatticeLayers<3> uneven_layers(int n) {
    LatticeLayers<3> layers;
    for (std::size_t a = 0; a < 3; ++a) {
        for (int i = 0; i < n; ++i) {
            layers.width[a].push_back(1.0 + 0.3 * static_cast<double>(a) + (i < n / 2 ? 0.0 : 0.7));
        }
        layers.planes[a] = {0, n / 2, n};
    }
    return layers;
}

Vec3 place(const LatticeLayers<3>& layers, const LatticePoint<3>& p) {
    Vec3 x = Vec3::Zero();
    for (std::size_t a = 0; a < 3; ++a) {
        for (int i = 0; i < p[a]; ++i) {
            x[static_cast<Eigen::Index>(a)] += layers.width[a][static_cast<std::size_t>(i)];
        }
    }
    return x;
}

}  // namespace

TEST_CASE("rectilinear grids, turned and sheared, come back") {
    for (const int n : {2, 6, 16}) {
        const LogicalGrid<3> grid(notched_block(n));
        const LatticeLayers<3> layers = uneven_layers(n);
        const Eigen::Matrix3d map = (Eigen::Matrix3d() << 1, 0.3, -0.2, 0.1, 2, 0.4, -0.3, 0.2, 1.5).finished();
        std::vector<Vec3> wanted(grid.node_count()), nodes(grid.node_count());
        grid.for_each_node([&](Index v, const LatticePoint<3>& p) {
            wanted[v] = map * place(layers, p);
            nodes[v] = grid.inner(p) ? Vec3(1e3, -1e3, 0) : wanted[v];
        });
        place_inner_nodes(grid, layers, nodes);
        double worst = 0.0;
        for (std::size_t v = 0; v < nodes.size(); ++v) {
            worst = std::max(worst, (nodes[v] - wanted[v]).norm());
        }
        CHECK(worst < 1e-7);
    }
}

TEST_CASE("every inner node is the weighted mean of its neighbours") {
    const int n = 12;
    const LogicalGrid<3> grid(notched_block(n));
    const LatticeLayers<3> layers = uneven_layers(n);
    std::vector<Vec3> nodes(grid.node_count());
    grid.for_each_node([&](Index v, const LatticePoint<3>& p) {
        const Vec3 x = place(layers, p);
        nodes[v] = x + Vec3(std::sin(x[1]), 0.2 * x[0] * x[2], std::cos(x[0] + x[1]));
    });
    place_inner_nodes(grid, layers, nodes);
    double worst = 0.0;
    grid.for_each_node([&](Index v, const LatticePoint<3>& p) {
        if (!grid.inner(p)) {
            return;
        }
        Vec3 sum = Vec3::Zero();
        double weights = 0.0;
        for (std::size_t a = 0; a < 3; ++a) {
            const auto i = static_cast<std::size_t>(p[a]);
            for (const int side : {-1, 1}) {
                LatticePoint<3> q = p;
                q[a] += side;
                const double width = layers.width[a][side < 0 ? i - 1 : i];
                const double weight = 2.0 / (width * (layers.width[a][i - 1] + layers.width[a][i]));
                sum += weight * nodes[grid.node(q)];
                weights += weight;
            }
        }
        worst = std::max(worst, (nodes[v] - sum / weights).norm());
    });
    CHECK(worst < 2e-4);
    CHECK(worst > 0.0);
}

TEST_CASE("boundary nodes stay, bit by bit, and the result repeats itself") {
    const LogicalGrid<3> grid(notched_block(8));
    const LatticeLayers<3> layers = uneven_layers(8);
    std::vector<Vec3> nodes(grid.node_count(), Vec3::Zero());
    grid.for_each_node([&](Index v, const LatticePoint<3>& p) {
        if (!grid.inner(p)) {
            nodes[v] = place(layers, p).cwiseProduct(Vec3(1.0 / 3, 1.0 / 7, 1.0 / 11));
        }
    });
    std::vector<Vec3> first = nodes, second = nodes;
    place_inner_nodes(grid, layers, first);
    place_inner_nodes(grid, layers, second);
    CHECK(std::memcmp(first.data(), second.data(), first.size() * sizeof(Vec3)) == 0);
    grid.for_each_node([&](Index v, const LatticePoint<3>& p) { CHECK((grid.inner(p) || first[v] == nodes[v])); });
}

TEST_CASE("arrays that do not fit") {
    const LogicalGrid<3> grid(notched_block(4));
    std::vector<Vec3> nodes(grid.node_count(), Vec3::Zero());
    LatticeLayers<3> layers = uneven_layers(4);
    std::vector<Vec3> few(3);
    CHECK_THROWS_AS(place_inner_nodes(grid, layers, few), InputError);
    layers.width[1].pop_back();
    CHECK_THROWS_AS(place_inner_nodes(grid, layers, nodes), InputError);
    layers = uneven_layers(4);
    layers.width[2][1] = 0.0;
    CHECK_THROWS_AS(place_inner_nodes(grid, layers, nodes), InputError);
    layers = uneven_layers(4);
    layers.planes[0] = {0, 2};
    CHECK_THROWS_AS(place_inner_nodes(grid, layers, nodes), InputError);
}
