#include "support/catch.hpp"
#include "support/shapes.hpp"

#include <pavior/mesh/span_mesh.hpp>

#include <array>
#include <vector>

using namespace pavior;

TEST_CASE("plain arrays are meshes") {
    using P = std::array<float, 3>;
    using C = std::array<int, 4>;
    const std::vector<P> nodes{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0.5F}};
    const std::vector<C> quads{{0, 1, 2, 3}};
    const QuadMeshView<P, C> view{nodes, quads};
    static_assert(quad_mesh<QuadMeshView<P, C>>);
    CHECK(node_count(view) == 4);
    CHECK(node(view, 3) == Vec3(0, 1, 0.5));
    CHECK(quad_count(view) == 1);
    CHECK(quad(view, 0) == QuadCorners{0, 1, 2, 3});

    using H = std::array<std::size_t, 8>;
    const std::vector<H> hexes{{0, 1, 2, 3, 3, 2, 1, 0}};
    const HexMeshView<P, H> solid{nodes, hexes};
    static_assert(hex_mesh<HexMeshView<P, H>>);
    CHECK(hex_count(solid) == 1);
    CHECK(hex(solid, 0) == HexCorners{0, 1, 2, 3, 3, 2, 1, 0});
}

TEST_CASE("owning meshes, and points alone") {
    const QuadMesh quads = shapes::grid_cap(3, 2);
    CHECK(node_count(quads) == 12);
    CHECK(quad_count(quads) == 6);
    const HexMesh hexes = shapes::hex_box(3, 2, 1);
    CHECK(node_count(hexes) == 24);
    CHECK(hex_count(hexes) == 6);
    static_assert(vertex_mesh<std::vector<Vec3>> && vertex_mesh<std::span<const Vec3>>);
    static_assert(!quad_mesh<std::vector<Vec3>>);
    CHECK(node_count(quads.nodes) == 12);
    CHECK(node(std::span<const Vec3>(quads.nodes), 11) == Vec3(1, 1, 0));
}
