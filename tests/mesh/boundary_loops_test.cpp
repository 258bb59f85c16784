#include "support/catch.hpp"
#include "support/foreign_meshes.hpp"
#include "support/shapes.hpp"

#include <pavior/mesh/boundary_loops.hpp>
#include <pavior/mesh/eigen_access.hpp>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

using namespace pavior;

namespace {
using List = std::vector<std::vector<Index>>;

List list(const Loops& loops) {
    List all;
    for (std::size_t l = 0; l < loops.size(); ++l) {
        all.emplace_back(loops[l].begin(), loops[l].end());
    }
    return all;
}

double signed_area(const QuadMesh& mesh, std::span<const Index> loop) {
    double area = 0.0;
    for (std::size_t k = 0; k < loop.size(); ++k) {
        const Vec3& a = mesh.nodes[loop[k]];
        const Vec3& b = mesh.nodes[loop[(k + 1) % loop.size()]];
        area += (a.x() * b.y() - a.y() * b.x()) / 2.0;
    }
    return area;
}

ErrorCode code_of(const QuadMesh& mesh, Error::Ids& ids) {
    try {
        static_cast<void>(boundary_loops(mesh));
    } catch (const InputError& error) {
        ids = error.ids();
        return error.code();
    }
    FAIL("did not throw");
    return ErrorCode::overflow;
}
}  // namespace

TEST_CASE("the loop of a grid runs counter-clockwise from its smallest node") {
    CHECK(list(boundary_loops(shapes::grid_cap(2, 2))) == List{{0, 1, 2, 5, 8, 7, 6, 3}});
    CHECK(list(boundary_loops(shapes::grid_cap(1, 1))) == List{{0, 1, 3, 2}});
    CHECK(list(boundary_loops(shapes::l_shape(1))) == List{{0, 1, 2, 5, 4, 7, 6, 3}});
}

TEST_CASE("a hole runs clockwise") {
    const QuadMesh ring = shapes::square_ring(1);
    const Loops loops = boundary_loops(ring);
    CHECK(list(loops) ==
          List{{0, 1, 2, 3, 4, 9, 13, 18, 23, 22, 21, 20, 19, 14, 10, 5}, {6, 11, 15, 16, 17, 12, 8, 7}});
    CHECK(signed_area(ring, loops[0]) == Approx(4.0));
    CHECK(signed_area(ring, loops[1]) == Approx(-1.0));
}

TEST_CASE("three holes, in the order of their smallest nodes, wherever the outer loop starts") {
    const QuadMesh plate = shapes::subset(shapes::grid_cap(14, 14), [](const Vec3& c) {
        const bool hole = std::abs(std::abs(c.x()) - 0.5) < 0.14 && std::abs(std::abs(c.y()) - 0.5) < 0.14;
        return !hole || (c.x() > 0 && c.y() > 0);
    });
    const Loops loops = boundary_loops(plate);
    REQUIRE(loops.size() == 4);
    CHECK(loops[0].size() == 56);
    CHECK(signed_area(plate, loops[0]) == Approx(4.0));
    for (std::size_t l = 1; l < 4; ++l) {
        CHECK(signed_area(plate, loops[l]) == Approx(-4.0 / 196.0));
        CHECK(loops[l - 1][0] < loops[l][0]);
    }
    const Loops annulus = boundary_loops(shapes::annulus(5, 2));  // node 0 lies on the hole
    CHECK(list(annulus) == List{{0, 12, 9, 6, 3}, {2, 5, 8, 11, 14}});
}

TEST_CASE("turned quads give turned loops") {
    QuadMesh mesh = shapes::grid_cap(2, 2);
    for (QuadCorners& q : mesh.quads) {
        std::swap(q[1], q[3]);
    }
    CHECK(list(boundary_loops(mesh)) == List{{0, 3, 6, 7, 8, 5, 2, 1}});
}

TEST_CASE("the order of the quads and their first corners do not matter") {
    QuadMesh mesh = shapes::square_ring(2);
    const Loops wanted = boundary_loops(mesh);
    std::reverse(mesh.quads.begin(), mesh.quads.end());
    for (std::size_t q = 0; q < mesh.quads.size(); ++q) {
        QuadCorners& c = mesh.quads[q];
        std::rotate(c.begin(), c.begin() + static_cast<std::ptrdiff_t>(q % 4), c.end());
    }
    CHECK(boundary_loops(mesh) == wanted);
}

TEST_CASE("closed, empty and disconnected meshes") {
    const QuadMesh cube{std::vector<Vec3>(8, Vec3::Zero()),
                        {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}};
    CHECK(boundary_loops(cube).size() == 0);
    CHECK(boundary_loops(QuadMesh{}).size() == 0);
    const QuadMesh two{std::vector<Vec3>(9, Vec3::Zero()), {{5, 6, 7, 8}, {0, 1, 2, 3}}};
    CHECK(list(boundary_loops(two)) == List{{0, 1, 2, 3}, {5, 6, 7, 8}});
}

TEST_CASE("foreign meshes give the same loops") {
    const QuadMesh ring = shapes::square_ring(2);
    const Loops wanted = boundary_loops(ring);
    CHECK(boundary_loops(archetype::Quads(ring)) == wanted);
    CHECK(boundary_loops(QuadMeshView<Vec3, QuadCorners>{ring.nodes, ring.quads}) == wanted);
    Eigen::MatrixXd v(ring.nodes.size(), 3);
    Eigen::MatrixXi f(ring.quads.size(), 4);
    for (std::size_t i = 0; i < ring.nodes.size(); ++i) {
        v.row(static_cast<Eigen::Index>(i)) = ring.nodes[i].transpose();
    }
    for (std::size_t q = 0; q < ring.quads.size(); ++q) {
        for (std::size_t k = 0; k < 4; ++k) {
            f(static_cast<Eigen::Index>(q), static_cast<Eigen::Index>(k)) = static_cast<int>(ring.quads[q][k]);
        }
    }
    CHECK(boundary_loops(EigenQuadMesh(v, f)) == wanted);
}

TEST_CASE("what is no surface throws, with the ids") {
    const std::vector<Vec3> nodes(12, Vec3::Zero());
    Error::Ids ids;
    CHECK(code_of({nodes, {{0, 1, 2, 3}, {0, 1, 2, 12}}}, ids) == ErrorCode::bad_index);
    CHECK(ids == Error::Ids{1});
    CHECK(code_of({nodes, {{0, 1, 2, 0}}}, ids) == ErrorCode::bad_index);
    CHECK(ids == Error::Ids{0});
    CHECK(code_of({nodes, {{0, 1, 2, 3}, {0, 1, 5, 4}}}, ids) == ErrorCode::bad_orientation);
    CHECK(ids == Error::Ids{0, 1});
    CHECK(code_of({nodes, {{0, 1, 2, 3}, {1, 0, 4, 5}, {0, 1, 6, 7}}}, ids) == ErrorCode::non_manifold);
    CHECK(ids == Error::Ids{0, 1});
    CHECK(code_of({nodes, {{0, 1, 2, 3}, {2, 4, 5, 6}}}, ids) == ErrorCode::non_manifold);
    CHECK(ids == Error::Ids{2});
}

TEST_CASE("a node of very many quads costs no more than its edges") {
    // A fan of k quads about node 0: spokes 0, 2 i + 1, tips 2 i + 2.
    const Index k = 100000;
    QuadMesh fan;
    fan.nodes.assign(2 * std::size_t{k} + 1, Vec3::Zero());
    for (Index i = 0; i < k; ++i) {
        fan.quads.push_back({0, 2 * i + 1, 2 * i + 2, i + 1 < k ? 2 * i + 3 : 1});
    }
    const Loops loops = boundary_loops(fan);
    REQUIRE(loops.size() == 1);
    CHECK(loops[0].size() == 2 * std::size_t{k});
}
