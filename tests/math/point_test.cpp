#include "support/catch.hpp"

#include <pavior/math/point.hpp>

#include <array>
#include <deque>
#include <span>
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

namespace {
struct PlanePoint {  // as CGAL::Point_2
    struct Ambient_dimension {
        static constexpr int value = 2;
    };
    double operator[](int axis) const { return axis; }
};
struct OwnExtent {  // a member of that name that is no number of coordinates
    std::size_t extent() const { return 7; }
    double operator[](int axis) const { return axis; }
};
}  // namespace

TEST_CASE("points that tell another number of coordinates than three are refused") {
    static_assert(!point_like<std::array<double, 2>> && !point_like<std::array<float, 4>> && !point_like<double[2]>);
    static_assert(!point_like<Eigen::Vector2d> && !point_like<const Eigen::Vector4f&> && !point_like<Eigen::Matrix3d>);
    static_assert(!point_like<std::span<double, 2>> && !point_like<PlanePoint>);
    static_assert(point_like<std::span<const double, 3>> && point_like<std::span<double>> && point_like<OwnExtent>);
    static_assert(point_like<Eigen::VectorXd> && point_like<Eigen::RowVector3d> && point_like<double[3]>);
    static_assert(point_like<decltype(Eigen::Matrix3Xd().col(0))> && !point_like<decltype(Eigen::Matrix2Xd().col(0))>);
    CHECK(to_vec3(std::span<const double>(std::array{1.0, 2.0, 3.0})) == Vec3(1, 2, 3));
}

TEST_CASE("what is a range of points") {
    using pavior::point_range;
    static_assert(point_range<std::vector<Vec3>> && point_range<std::array<Vec3, 4>> && point_range<Vec3[4]>);
    static_assert(point_range<std::span<Vec3>> && point_range<const std::deque<Archetype>&>);
    static_assert(!point_range<std::vector<pavior::Vec2>> && !point_range<std::vector<double>> && !point_range<Vec3>);
    static_assert(!point_range<Eigen::Matrix3Xd> && !point_range<const Vec3*>);
    CHECK(pavior::detail::count_of(std::vector<Vec3>(3)) == 3);
}
