#include "affine/random_loops.hpp"
#include "support/catch.hpp"

#include <pavior/affine/loop_normals.hpp>

#include <Eigen/Geometry>

using namespace pavior;

TEST_CASE("The normals of a pair are those of its loops") {
    for (int seed = 1; seed <= 10; ++seed) {
        INFO("seed " << seed);
        test::Random random(seed);
        const test::Points<3> X = random.orthogonal<3>() * random.multi_loop(12, 0.3);
        const test::Points<3> Y = random.orthogonal<3>(-1) * random.multi_loop(12, 0.3);
        const auto offsets = test::Random::offsets(12);
        const auto normals = loop_normals(loop_pair(X, Y), X, Y, offsets, {});
        CHECK(normals.source.normal == pseudo_normal(X, offsets).normal);
        CHECK(normals.target.normal == pseudo_normal(Y, offsets).normal);
        CHECK_FALSE(normals.signed_by_orientation);
    }
}

TEST_CASE("In four dimensions normals exist for hyperplanar loops only") {
    test::Random random(3);
    const Eigen::Vector4d normal = random.unit<4>();
    const auto X = random.hyperplanar<4>(20, normal, random.vector<4>());
    const auto Y = random.points<4>(20);
    const auto normals = loop_normals(loop_pair(X, Y), X, Y, test::Offsets{0, 20}, {});
    CHECK(std::abs(normals.source.normal.dot(normal)) == Approx(1).epsilon(1e-14));
    CHECK(normals.target.null);
    CHECK(normals.signed_by_orientation);
}
