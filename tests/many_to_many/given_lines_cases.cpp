#include <pavior/many_to_many/detail/given_lines.hpp>

#include "support/catch.hpp"
#include "support/test_brep.hpp"

using namespace pavior;
using namespace pavior::test;

TEST_CASE("the lines of a given mesh are those that do not lie along edges") {
    TestBrep b;
    const FaceId f =
        b.flat_polygon({b.vertex({0, 0, 0}), b.vertex({2, 0, 0}), b.vertex({2, 3, 0}), b.vertex({0, 3, 0})});
    std::vector<int> intervals(b.edge_count(), 2);
    BoundaryMesh given = mesh_edges(b, intervals);
    FaceMesh& face = given.faces[f.index()];
    const auto position = [&](double x, double y) {
        for (Index i = 0; i < face.nodes.size(); ++i) {
            if ((given.nodes[face.nodes[i]] - Vec3(x, y, 0)).norm() < 1e-12) {
                return i;
            }
        }
        return no_index;
    };
    for (Index i = 0; i < given.nodes.size(); ++i) {
        face.nodes.push_back(i);
    }
    face.nodes.push_back(given.add_node({1, 1.5, 0}));
    for (const double x : {0.0, 1.0}) {
        for (const double y : {0.0, 1.5}) {
            face.quads.push_back({position(x, y), position(x + 1, y), position(x + 1, y + 1.5), position(x, y + 1.5)});
        }
    }
    const std::vector<std::array<Index, 2>> lines = detail::lines_inside(b, given, f);
    CHECK(lines.size() == 4);
    for (const auto& [i, k] : lines) {
        CHECK((i == position(1, 1.5) || k == position(1, 1.5)));
    }
}

TEST_CASE("a grid is upright if every quad has two upright edges, opposite each other") {
    const std::vector<Vec3> nodes{{0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {0.2, 0, 1}, {0.5, 0, 0.4}};
    CHECK(detail::is_upright(nodes[0], nodes[3]));
    CHECK_FALSE(detail::is_upright(nodes[0], nodes[4]));
    CHECK(detail::is_upright_grid(nodes, std::vector<QuadCorners>{{0, 1, 2, 3}}));
    CHECK_FALSE(detail::is_upright_grid(nodes, std::vector<QuadCorners>{{0, 1, 2, 3}, {0, 1, 2, 4}}));
}
