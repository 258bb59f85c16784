#include <pavior/brep/boundary_deviation.hpp>
#include <pavior/core/error.hpp>

#include "support/catch.hpp"
#include "support/test_brep.hpp"

#include <cmath>
#include <numbers>
#include <vector>

using namespace pavior;
using namespace pavior::test;

namespace {

/// A wall of n x m quads, their nodes on the cylinder.
struct Wall {
    std::vector<Vec3> nodes;
    std::vector<QuadCorners> quads;
    std::vector<FaceId> faces;

    Wall(FaceId face, Index n, Index m, double radius, double height) : faces(n * m, face) {
        for (Index k = 0; k <= m; ++k) {
            for (Index i = 0; i < n; ++i) {
                const double a = 2 * std::numbers::pi * i / n;
                nodes.emplace_back(radius * std::cos(a), radius * std::sin(a), height * k / m);
            }
        }
        for (Index k = 0; k < m; ++k) {
            for (Index i = 0; i < n; ++i) {
                const Index j = (i + 1) % n;
                quads.push_back({k * n + i, k * n + j, (k + 1) * n + j, (k + 1) * n + i});
            }
        }
    }
};

const auto always = [](const BoundaryDeviation&) { return true; };

}  // namespace

TEST_CASE("The distance is that of the chords, with hardly a projection, and across the seam") {
    TestBrep b;
    const SolidId solid = add_cylinder(b, 1.5, 1.5, 2.0);
    const FaceId side = b.solid_faces(solid)[2].face;
    const Wall wall(side, 24, 10, 1.5, 2.0);
    const BoundaryDeviation found = boundary_deviation(b, wall.nodes, wall.quads, wall.faces, always);
    CHECK(found.distance == Approx(1.5 * (1 - std::cos(std::numbers::pi / 24))).epsilon(1e-6));
    CHECK(found.quads == 240);
    CHECK(found.projections < 10);
    CHECK(found.quad < 240);
    const double missing = 2.0 * 1.5 * 1.5 * (std::numbers::pi - 12 * std::sin(2 * std::numbers::pi / 24));
    CHECK(found.volume > missing);
    CHECK(found.volume < 3 * missing);
}

TEST_CASE("A node off its face is found, and quads that lie far off are projected") {
    TestBrep b;
    const SolidId solid = add_cylinder(b, 1.5, 1.5, 2.0);
    const FaceId side = b.solid_faces(solid)[2].face;
    Wall wall(side, 24, 10, 1.5, 2.0);
    wall.nodes[100] *= 1.2;
    const double off = wall.nodes[100].head<2>().norm() - 1.5;
    const BoundaryDeviation found = boundary_deviation(b, wall.nodes, wall.quads, wall.faces, always);
    CHECK(found.distance == Approx(off).epsilon(1e-3));
    const QuadCorners& at = wall.quads[found.quad];
    CHECK(std::find(at.begin(), at.end(), Index{100}) != at.end());
    const Wall coarse(side, 4, 1, 1.5, 2.0);
    CHECK(boundary_deviation(b, coarse.nodes, coarse.quads, coarse.faces, always).distance ==
          Approx(1.5 * (1 - std::sqrt(0.5))).epsilon(1e-6));
}

TEST_CASE("It ends when told to, and faces must be as many as quads") {
    TestBrep b;
    const SolidId solid = add_cylinder(b, 1.5, 1.5, 2.0);
    const Wall wall(b.solid_faces(solid)[2].face, 24, 10, 1.5, 2.0);
    const auto few = [](const BoundaryDeviation& so_far) { return so_far.quads < 7; };
    CHECK(boundary_deviation(b, wall.nodes, wall.quads, wall.faces, few).quads == 7);
    CHECK_THROWS_AS(boundary_deviation(b, wall.nodes, wall.quads, std::span(wall.faces).first(3), always), InputError);
    const BoundaryDeviation none =
        boundary_deviation(b, wall.nodes, std::vector<QuadCorners>{}, std::vector<FaceId>{}, always);
    CHECK(none.distance == 0);
    CHECK(none.quad == no_position);
}
