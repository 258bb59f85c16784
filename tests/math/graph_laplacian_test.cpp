#include "support/catch.hpp"

#include <pavior/math/graph_laplacian.hpp>

#include <cmath>
#include <vector>

using namespace pavior;

TEST_CASE("A chain between two given ends divides their difference by the resistances") {
    // given 5 - unknown 0 - unknown 1 - given 11, weights 1, 2 (as two edges of 1), 4
    const std::vector<GraphLaplacian::Edge> edges{{-1, 0, 1}, {0, 1, 1}, {1, 0, 1}, {1, -2, 4}, {-1, -2, 7}};
    const GraphLaplacian laplacian(2, 2, edges);
    const Eigen::VectorXd x = laplacian.solve(Eigen::Vector2d(5, 11));
    const double resistance = 1 + 0.5 + 0.25;
    CHECK(x[0] == Approx(5 + 6 * 1 / resistance).epsilon(1e-14));
    CHECK(x[1] == Approx(5 + 6 * 1.5 / resistance).epsilon(1e-14));
    CHECK(laplacian.solve(Eigen::Vector2d(3, 3)).isApproxToConstant(3, 1e-14));
}

TEST_CASE("On a grid linear functions are reproduced, and a maximum lies on the boundary") {
    constexpr int n = 12;
    const auto number = [](int i, int j) -> std::int64_t {  // inner nodes row by row, boundary nodes by their place
        const bool inner = i > 0 && j > 0 && i < n && j < n;
        return inner ? (i - 1) + (j - 1) * (n - 1) : -1 - (i + j * (n + 1));
    };
    std::vector<GraphLaplacian::Edge> edges;
    Eigen::VectorXd linear((n + 1) * (n + 1)), wave((n + 1) * (n + 1));
    for (int j = 0; j <= n; ++j) {
        for (int i = 0; i <= n; ++i) {
            linear[i + j * (n + 1)] = 2 * i - 3 * j + 1;
            wave[i + j * (n + 1)] = std::sin(i) * std::cos(2 * j);
            if (i < n) {
                edges.push_back({number(i, j), number(i + 1, j), 1});
            }
            if (j < n) {
                edges.push_back({number(i, j), number(i, j + 1), 1});
            }
        }
    }
    const GraphLaplacian laplacian((n - 1) * (n - 1), linear.size(), edges);
    const Eigen::VectorXd x = laplacian.solve(linear);
    for (int j = 1; j < n; ++j) {
        for (int i = 1; i < n; ++i) {
            CHECK(x[number(i, j)] == Approx(2 * i - 3 * j + 1).margin(1e-12));
        }
    }
    CHECK(laplacian.solve(wave).cwiseAbs().maxCoeff() < wave.cwiseAbs().maxCoeff());
}

TEST_CASE("Nothing unknown: nothing is solved") {
    CHECK(GraphLaplacian().solve(Eigen::VectorXd(0)).size() == 0);
    CHECK(GraphLaplacian(0, 2, {}).solve(Eigen::Vector2d(1, 2)).size() == 0);
}
