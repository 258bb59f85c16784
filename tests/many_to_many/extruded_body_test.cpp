#include "support/catch.hpp"

#include <pavior/many_to_many/extruded_body.hpp>

using namespace pavior;

namespace {
struct Flat {
    [[nodiscard]] Vec3 curve_point(Index, const Vec2& near) const { return {near[0], near[1], 0}; }
    [[nodiscard]] double cap_height(Index, const Vec2&) const { return 0; }
};
struct Mute {
    [[nodiscard]] double cap_height(Index, const Vec2&) const { return 0; }
};
}  // namespace

TEST_CASE("a frame maps space to plane and height, and back") {
    const ExtrusionFrame frame{Vec3::UnitY(), Vec3::UnitZ(), Vec3::UnitX()};
    CHECK(frame.to_frame({1, 2, 3}) == Vec3(2, 3, 1));
    CHECK(frame.to_space({2, 3, 1}) == Vec3(1, 2, 3));
}

TEST_CASE("a geometry evaluates curves and caps") {
    CHECK(extruded_geometry<Flat>);
    CHECK_FALSE(extruded_geometry<Mute>);
}
