#include <pavior/brep/chord_volume.hpp>
#include <pavior/core/error.hpp>

#include "support/catch.hpp"
#include "support/test_brep.hpp"

#include <cmath>
#include <numbers>
#include <vector>

using namespace pavior;
using namespace pavior::test;

namespace {

/// n quads round a cylinder, their nodes on circles of the radius.
struct Wall {
    std::vector<Vec3> nodes;
    std::vector<QuadCorners> quads;
    std::vector<FaceId> faces;

    Wall(FaceId face, Index n, double radius, double height) : faces(n, face) {
        for (Index i = 0; i < n; ++i) {
            const double a = 2 * std::numbers::pi * i / n;
            nodes.emplace_back(radius * std::cos(a), radius * std::sin(a), 0.0);
            nodes.emplace_back(radius * std::cos(a), radius * std::sin(a), height);
            const Index j = (i + 1) % n;
            quads.push_back({2 * i, 2 * j, 2 * j + 1, 2 * i + 1});
        }
    }
    [[nodiscard]] double chords(const TestBrep& b) const { return chord_volume(b, nodes, quads, faces); }
};

}  // namespace

TEST_CASE("The volume between chords and a cylinder is not underestimated, nor by much overestimated") {
    TestBrep b;
    const SolidId solid = add_cylinder(b, 1.5, 1.5, 2.0);
    const FaceId side = b.solid_faces(solid)[2].face;
    for (const Index n : {5U, 8U, 16U, 64U}) {
        const double missing = 2.0 * 1.5 * 1.5 * (std::numbers::pi - 0.5 * n * std::sin(2 * std::numbers::pi / n));
        const double estimate = Wall(side, n, 1.5, 2.0).chords(b);
        CHECK(estimate > missing);
        CHECK(estimate < 3 * missing);
    }
    const Wall inside(side, 64, 1.4, 2.0);  // nodes off the face count too
    CHECK(inside.chords(b) > std::numbers::pi * (1.5 * 1.5 - 1.4 * 1.4) * 2.0);
    CHECK(chord_volume(b, inside.nodes, inside.quads, inside.faces, 0.1) < 0.2);
    CHECK_THROWS_AS(chord_volume(b, inside.nodes, inside.quads, std::span(inside.faces).first(3)), InputError);
}

TEST_CASE("Quads on flat faces leave no volume") {
    TestBrep b;
    const SolidId solid = add_prism(b, rectangle(3, 2), 0, 1);
    const FaceId bottom = b.solid_faces(solid)[0].face;
    const std::vector<Vec3> nodes{{0.1, 0.2, 0}, {2.5, 0.3, 0}, {2.8, 1.9, 0}, {0.4, 1.2, 0}};
    CHECK(chord_volume(b, nodes, std::vector<QuadCorners>{{0, 1, 2, 3}}, std::vector<FaceId>{bottom}) < 1e-14);
}
