#include "support/catch.hpp"

#include <pavior/math/affine_map.hpp>

using pavior::AffineMap;

TEST_CASE("An affine map takes its centre to the image of the centre and turns about it") {
    AffineMap<> map;
    map.A << 0, -1, 0, 1, 0, 0, 0, 0, 2;
    map.cx << 1, 2, 3;
    map.cy << -1, 0, 5;
    CHECK(map(map.cx) == map.cy);
    CHECK(map(Eigen::Vector3d(2, 2, 4)) == Eigen::Vector3d(-1, 1, 7));
    CHECK(map.direction(Eigen::Vector3d::UnitX()) == Eigen::Vector3d::UnitY());
    const Eigen::Vector3d x(0.5, -1, 2);
    CHECK((map.A * x + map.offset() - map(x)).norm() < 1e-14);
}

TEST_CASE("Composition applies the inner map first") {
    const AffineMap<double, 2> turn{(Eigen::Matrix2d() << 0, -1, 1, 0).finished(), {1, 0}, {2, 0}};
    const AffineMap<double, 2> stretch{(Eigen::Matrix2d() << 3, 0, 0, 1).finished(), {0, 1}, {0, 0}};
    const Eigen::Vector2d x(0.25, 4);
    CHECK((compose(turn, stretch)(x) - turn(stretch(x))).norm() < 1e-14);
    CHECK((compose(stretch, turn)(x) - stretch(turn(x))).norm() < 1e-14);
    CHECK(compose(turn, stretch)(x) != compose(stretch, turn)(x));
}

TEST_CASE("The identity, fixed and dynamic, float and double") {
    CHECK(AffineMap<float, 3>::identity()(Eigen::Vector3f(1, 2, 3)) == Eigen::Vector3f(1, 2, 3));
    const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(5, 0, 4);
    CHECK(AffineMap<double, Eigen::Dynamic>::identity(5)(x) == x);
}

TEST_CASE("The centred form is precise far from the origin") {
    const AffineMap<> map{2 * Eigen::Matrix3d::Identity(), Eigen::Vector3d::Constant(1e15), Eigen::Vector3d::Ones()};
    CHECK(map(Eigen::Vector3d::Constant(1e15 + 1)) == Eigen::Vector3d::Constant(3));
}
