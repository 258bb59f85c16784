#include "support/catch.hpp"
#include "support/test_brep.hpp"

#include <pavior/part/model_extras.hpp>

using namespace pavior;
using namespace pavior::test;

namespace {

/// A model that knows more than the concept asks for.
struct Knowing : TestBrep {
    [[nodiscard]] std::string face_kind(FaceId f) const { return f.value == 0 ? "Plane" : "Cylinder"; }
    [[nodiscard]] Vec2 face_interior(FaceId) const { return {0.25, 0.25}; }
    [[nodiscard]] double solid_volume(SolidId) const { return 7; }
    [[nodiscard]] double diagonal() const { return 9; }
    [[nodiscard]] std::string face_name(FaceId) const { return "lid"; }
    [[nodiscard]] std::string solid_name(SolidId) const { return "box"; }
};

}  // namespace

TEST_CASE("What a model does not know has a substitute, or is left open") {
    TestBrep b;
    const SolidId solid = add_prism(b, rectangle(3, 4), 0, 12);
    CHECK(diagonal_of(b) == Approx(13));
    CHECK_FALSE(volume_of(b, solid).has_value());
    CHECK_FALSE(is_plane(b, FaceId{0}));
    CHECK_FALSE(plane_of(b, FaceId{0}).has_value());
    CHECK(name_of(b, FaceId{0}).empty());
    CHECK(name_of(b, solid).empty());
    CHECK(all_solids(b) == std::vector{solid});
    TestBrep round;
    add_cylinder(round, 1, 1, 2);
    CHECK(diagonal_of(round) == Approx(std::sqrt(12.0)));
}

TEST_CASE("What a model knows is asked of it") {
    Knowing b;
    const SolidId solid = add_prism(b, rectangle(3, 4), 0, 12);
    CHECK(diagonal_of(b) == 9);
    CHECK(volume_of(b, solid) == 7);
    CHECK(is_plane(b, FaceId{0}));
    CHECK_FALSE(is_plane(b, FaceId{1}));
    CHECK(name_of(b, FaceId{1}) == "lid");
    CHECK(name_of(b, solid) == "box");
    const auto plane = plane_of(b, FaceId{0});
    REQUIRE(plane.has_value());
    const auto d = b.face_derivatives(FaceId{0}, {0.25, 0.25});
    CHECK((plane->normal - d.first.cross(d.second).normalized()).norm() < 1e-15);
    CHECK_FALSE(plane_of(b, FaceId{1}).has_value());
}
