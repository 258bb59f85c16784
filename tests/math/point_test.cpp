#include "support/catch.hpp"

#include <pavior/math/point.hpp>

#include <array>
#include <string>
#include <vector>

using pavior::point_like;
using pavior::to_vec3;
using pavior::Vec3;

namespace {
struct Archetype {
    float operator[](int axis) const { return static_cast<float>(axis) + 0.5F; }
};
struct NoBracket {
    double x, y, z;
};
}  // namespace

TEST_CASE("what is a point") {
    static_assert(point_like<std::array<double, 3>> && point_like<const double*> && point_like<Eigen::Vector3f>);
    static_assert(point_like<const Vec3&> && point_like<Archetype> && point_like<std::vector<float>>);
    static_assert(!point_like<NoBracket> && !point_like<double> && !point_like<std::array<std::string, 3>>);
    const double raw[3] = {1.0, 2.0, 3.0};
    CHECK(to_vec3(&raw[0]) == Vec3(1, 2, 3));
    CHECK(to_vec3(std::array{1.0, 2.0, 3.0}) == Vec3(1, 2, 3));
    CHECK(to_vec3(Eigen::Vector3f(1, 2, 3)) == Vec3(1, 2, 3));
    CHECK(to_vec3(Archetype{}) == Vec3(0.5, 1.5, 2.5));
}
