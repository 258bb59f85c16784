#include "affine/random_loops.hpp"
#include "support/catch.hpp"

#include <pavior/affine/centring.hpp>

#include <limits>

using pavior::centring;

TEST_CASE("Local coordinates have mean zero and size one, wherever the points are") {
    test::Random random(2);
    const test::Points<3> base = random.points<3>(50);
    for (const double offset : {0.0, 1e3, 1e7}) {
        for (const double size : {1e-200, 1e-6, 1.0, 1e6, 1e200}) {
            INFO("offset " << offset << ", size " << size);
            const test::Points<3> X = (base.array() + offset).matrix() * size;
            const auto local = centring(X);
            REQUIRE(local.finite);
            test::Points<3> points(3, X.cols());
            for (Eigen::Index i = 0; i < X.cols(); ++i) {
                points.col(i) = local.local(X.col(i));
            }
            CHECK(points.rowwise().mean().norm() < 1e-15);
            CHECK(points.cwiseAbs().maxCoeff() <= 1.01);
            CHECK(points.cwiseAbs().maxCoeff() > 0.4);
            int exponent = 0;
            CHECK(std::frexp(local.scale, &exponent) == 0.5);
            CHECK(local.extent == X.cwiseAbs().maxCoeff());
        }
    }
}

TEST_CASE("Centring degenerate and bad input") {
    const test::Points<3> same = Eigen::Vector3d(1, 2, 3).replicate(1, 4);
    CHECK(centring(same).scale == 1);
    CHECK(centring(same).centre == Eigen::Vector3d(1, 2, 3));
    test::Points<3> bad = same;
    bad(1, 2) = std::numeric_limits<double>::quiet_NaN();
    CHECK_FALSE(centring(bad).finite);
    bad(1, 2) = std::numeric_limits<double>::infinity();
    CHECK_FALSE(centring(bad).finite);
    test::Points<2> huge(2, 2);
    huge << 1.5e308, -1.5e308, 0, 0;
    CHECK(centring(huge).centre.allFinite());
}
