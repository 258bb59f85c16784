#include "support/catch.hpp"
#include "support/foreign_meshes.hpp"
#include "support/shapes.hpp"

#include <pavior/mesh/span_mesh.hpp>

#include <array>
#include <cstdint>
#include <deque>
#include <memory_resource>
#include <span>
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

TEST_CASE("points are read from spans, arrays, deques and vectors with any allocator") {
    std::array<Vec3, 3> points{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 2)};
    const auto check = [](const auto& mesh) {
        static_assert(vertex_mesh<decltype(mesh)>);
        CHECK(node_count(mesh) == 3);
        CHECK(node(mesh, 2) == Vec3(0, 1, 2));
    };
    check(points);
    check(std::span<Vec3>(points));
    check(std::span<const Vec3, 3>(points));
    check(std::pmr::vector<Vec3>(points.begin(), points.end()));
    check(std::deque<Vec3>(points.begin(), points.end()));
    const double raw[3][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 2}};
    check(raw);
    check(std::array<const double*, 3>{&raw[0][0], &raw[1][0], &raw[2][0]});
    static_assert(!vertex_mesh<std::vector<Vec2>> && !vertex_mesh<std::vector<double>> && !vertex_mesh<Vec3>);
}

namespace {
template <class... Arrays>
concept viewed = requires(Arrays&&... arrays) {
    QuadMeshView{std::forward<Arrays>(arrays)...};
};
}  // namespace

TEST_CASE("views take their types from the arrays") {
    const std::vector<std::array<float, 3>> nodes{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0.5F}};
    std::vector<std::array<int, 4>> quads{{0, 1, 2, 3}};
    const QuadMeshView cap{nodes, quads};
    static_assert(std::is_same_v<decltype(cap), const QuadMeshView<std::array<float, 3>, std::array<int, 4>>>);
    CHECK(quad(cap, 0) == QuadCorners{0, 1, 2, 3});
    CHECK(node(cap, 3) == Vec3(0, 1, 0.5));

    std::pmr::vector<Vec3> points{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 2), Vec3(0, 0, 1)};
    const std::array<std::array<std::size_t, 8>, 1> hexes{{{0, 1, 2, 3, 3, 2, 1, 0}}};
    CHECK(hex(HexMeshView{points, hexes}, 0) == HexCorners{0, 1, 2, 3, 3, 2, 1, 0});
    std::vector<TriCorners> triangles{{0, 1, 2}};
    CHECK(triangle(TriMeshView{std::span(points), std::span(triangles)}, 0) == TriCorners{0, 1, 2});
    const std::uint16_t tets[1][4] = {{3, 2, 1, 0}};
    CHECK(tet(TetMeshView{points, tets}, 0) == TetCorners{3, 2, 1, 0});

    static_assert(viewed<std::vector<Vec3>&, const std::vector<QuadCorners>&> &&
                  viewed<std::span<Vec3>, std::span<QuadCorners>>);
    static_assert(!viewed<std::vector<Vec3>, std::vector<QuadCorners>&>);  // the temporary would be gone
}

TEST_CASE("any mesh as arrays") {
    const QuadMesh quads = to_quad_mesh(archetype::Quads(shapes::grid_cap(2, 1)));
    CHECK(quads.nodes == shapes::grid_cap(2, 1).nodes);
    CHECK(quads.quads == shapes::grid_cap(2, 1).quads);
    const HexMesh hexes = to_hex_mesh(archetype::Hexes(shapes::hex_box(1, 1, 2)));
    CHECK(hexes.nodes == shapes::hex_box(1, 1, 2).nodes);
    CHECK(hexes.hexes == shapes::hex_box(1, 1, 2).hexes);
}
