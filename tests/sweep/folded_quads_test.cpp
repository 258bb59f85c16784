#include "support/catch.hpp"
#include "sweep/surfaces.hpp"

#include <pavior/sweep/folded_quads.hpp>

#include <numbers>
#include <span>
#include <vector>

using namespace pavior;

namespace {

std::vector<Vec2> plane_grid(std::size_t m, std::size_t r, const Vec2& low, const Vec2& high) {
    std::vector<Vec2> uv;
    for (std::size_t k = 0; k <= r; ++k) {
        for (std::size_t i = 0; i <= m; ++i) {
            const Vec2 t(static_cast<double>(i) / static_cast<double>(m),
                         static_cast<double>(k) / static_cast<double>(r));
            uv.emplace_back(low + (high - low).cwiseProduct(t));
        }
    }
    return uv;
}

template <class S>
std::vector<Vec3> evaluate(const S& surface, const std::vector<Vec2>& uv) {
    std::vector<Vec3> nodes;
    for (const Vec2& p : uv) {
        nodes.push_back(surface.point(p));
    }
    return nodes;
}

template <class S>
std::vector<Index> folded(const S& surface, const std::vector<Vec2>& uv, bool reversed = false) {
    return folded_surface_quads(surface, std::span<const Vec3>(evaluate(surface, uv)), std::span<const Vec2>(uv),
                                structured_quads(4, 3), reversed);
}

}  // namespace

TEST_CASE("signed area of polygons") {
    const std::vector<Vec2> square{{0.0, 0.0}, {2.0, 0.0}, {2.0, 1.0}, {0.0, 1.0}};
    const std::vector<Vec2> clockwise(square.rbegin(), square.rend());
    CHECK(signed_area(square) == 2.0);
    CHECK(signed_area(clockwise) == -2.0);
    CHECK(signed_area({}) == 0.0);
}

TEST_CASE("a moved node folds the quads round it, and only those") {
    auto uv = plane_grid(4, 3, {0.0, 0.0}, {4.0, 3.0});
    const auto quads = structured_quads(4, 3);
    CHECK(folded_plane_quads(uv, quads).empty());
    CHECK(folded_plane_quads(uv, quads, true).size() == quads.size());
    uv[6] += Vec2(1.2, 0.0);  // node (1, 1), past (2, 1)
    CHECK(folded_plane_quads(uv, quads) == std::vector<Index>{1, 5});
    uv[6] = uv[7];
    CHECK(folded_plane_quads(uv, quads) == std::vector<Index>{1, 5});
}

TEST_CASE("grids on curved surfaces are not folded, coarse or fine") {
    const double pi = std::numbers::pi;
    CHECK(folded(surfaces::Cylinder{}, plane_grid(4, 3, {0.0, 0.0}, {2.0 * pi, 1.0})).empty());
    CHECK(folded(surfaces::Cylinder{2.0, true}, plane_grid(4, 3, {0.0, 0.0}, {1.0, 1.9 * pi})).empty());
    CHECK(folded(surfaces::Cylinder{}, plane_grid(4, 3, {1.0, 0.0}, {0.0, 1.0}), true).empty());
    CHECK(folded(surfaces::Cylinder{}, plane_grid(4, 3, {1.0, 0.0}, {0.0, 1.0})).size() == 12);
    CHECK(folded(surfaces::Torus{}, plane_grid(4, 3, {0.0, 0.0}, {6.0, 4.0})).empty());
    CHECK(folded(surfaces::Saddle{}, plane_grid(4, 3, {-1.0, -1.0}, {1.0, 1.0})).empty());
    CHECK(folded(surfaces::Sphere{}, plane_grid(4, 3, {0.0, -1.5}, {6.0, 1.5})).empty());
}

TEST_CASE("a quad folded in space alone is found") {
    const surfaces::FlatPlane plane;
    const auto uv = plane_grid(4, 3, {0.0, 0.0}, {4.0, 3.0});
    auto nodes = evaluate(plane, uv);
    const auto quads = structured_quads(4, 3);
    nodes[6].x() += 1.2;
    CHECK(folded_surface_quads(plane, std::span<const Vec3>(nodes), std::span<const Vec2>(uv), quads) ==
          std::vector<Index>{1, 5});
}

TEST_CASE("folds of a grid in space without a surface") {
    StructuredGrid<Vec3> grid(4, 3);
    grid.nodes = evaluate(surfaces::Cylinder{}, plane_grid(4, 3, {0.0, 0.0}, {4.0, 3.0}));
    CHECK(folded_grid_quads(grid).empty());
    std::swap(grid(1, 1), grid(2, 1));
    CHECK_FALSE(folded_grid_quads(grid).empty());
    StructuredGrid<Vec3> coarse(3, 1);
    coarse.nodes = evaluate(surfaces::Cylinder{}, plane_grid(3, 1, {0.0, 0.0}, {2.0 * std::numbers::pi, 3.0}));
    CHECK(folded_grid_quads(coarse).empty());
    StructuredGrid<Vec3> back(3, 1);
    back.nodes = evaluate(surfaces::FlatPlane{}, plane_grid(3, 1, {0.0, 0.0}, {3.0, 1.0}));
    for (const std::size_t k : {0U, 1U}) {
        std::swap(back(1, k), back(2, k));
    }
    CHECK(folded_grid_quads(back) == std::vector<Index>{1});
}
