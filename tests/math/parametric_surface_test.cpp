#include "support/catch.hpp"

#include <pavior/math/parametric_surface.hpp>

namespace {

struct Paraboloid {
    [[nodiscard]] pavior::Vec3 point(const pavior::Vec2& uv) const { return {uv.x(), uv.y(), uv.squaredNorm()}; }
    [[nodiscard]] std::pair<pavior::Vec3, pavior::Vec3> derivatives(const pavior::Vec2& uv) const {
        return {{1.0, 0.0, 2.0 * uv.x()}, {0.0, 1.0, 2.0 * uv.y()}};
    }
};

struct NoDerivatives {
    [[nodiscard]] pavior::Vec3 point(const pavior::Vec2& uv) const { return {uv.x(), uv.y(), 0.0}; }
};

struct NotConst {
    pavior::Vec3 point(const pavior::Vec2& uv) { return {uv.x(), uv.y(), 0.0}; }
    std::pair<pavior::Vec3, pavior::Vec3> derivatives(const pavior::Vec2&) { return {}; }
};

}  // namespace

TEST_CASE("a type with point and derivatives models parametric_surface") {
    STATIC_REQUIRE(pavior::parametric_surface<Paraboloid>);
    STATIC_REQUIRE(pavior::parametric_surface<const Paraboloid&>);
    STATIC_REQUIRE_FALSE(pavior::parametric_surface<NoDerivatives>);
    STATIC_REQUIRE_FALSE(pavior::parametric_surface<NotConst>);
    STATIC_REQUIRE_FALSE(pavior::parametric_surface<int>);
    const Paraboloid surface;
    CHECK(surface.point({1.0, 2.0}).z() == 5.0);
}
