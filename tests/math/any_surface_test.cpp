#include "support/archetypes.hpp"
#include "support/catch.hpp"

#include <pavior/math/any_surface.hpp>

#include <Eigen/Geometry>

#include <type_traits>
#include <utility>

using namespace pavior;

namespace {

struct Saddle {
    [[nodiscard]] Vec3 point(const Vec2& uv) const { return {uv[0], uv[1], uv[0] * uv[1]}; }
    [[nodiscard]] std::pair<Vec3, Vec3> derivatives(const Vec2& uv) const { return {{1, 0, uv[1]}, {0, 1, uv[0]}}; }
};

Vec3 normal_of(const AnySurface& surface, const Vec2& uv) {
    const auto [du, dv] = surface.derivatives(uv);
    return du.cross(dv);
}

}  // namespace

TEST_CASE("A view of any surface evaluates it, a temporary and an archetype, too") {
    static_assert(!std::is_convertible_v<int, AnySurface>);
    const Saddle saddle;
    const AnySurface view = saddle;
    const AnySurface copy = view;
    CHECK(copy.point({2, 3}) == Vec3(2, 3, 6));
    CHECK(normal_of(Saddle{}, {2, 3}) == Vec3(-3, -2, 1));
    CHECK(normal_of(archetype::Surface(saddle), {2, 3}) == Vec3(-3, -2, 1));
}
