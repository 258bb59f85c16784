#include "affine/random_loops.hpp"
#include "support/catch.hpp"

#include <pavior/affine/pseudo_area.hpp>
#include <pavior/core/error.hpp>

#include <Eigen/Geometry>

#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

using namespace pavior;
using test::Offsets;
using test::Points;
using test::Random;

namespace {

/// The signed area of a multi-loop in the plane with axes e and f, by the shoelace formula.
double projected_area(const Points<3>& X, const Offsets& offsets, const Eigen::Vector3d& e, const Eigen::Vector3d& f) {
    double area = 0;
    for (std::size_t loop = 0; loop + 1 < offsets.size(); ++loop) {
        const std::size_t count = offsets[loop + 1] - offsets[loop];
        for (std::size_t i = 0; i < count; ++i) {
            const Eigen::Vector3d a = X.col(static_cast<Eigen::Index>(offsets[loop] + i));
            const Eigen::Vector3d b = X.col(static_cast<Eigen::Index>(offsets[loop] + (i + 1) % count));
            area += (a.dot(e) * b.dot(f) - a.dot(f) * b.dot(e)) / 2;
        }
    }
    return area;
}

/// Two axes of the plane perpendicular to v, right-handed with it.
std::pair<Eigen::Vector3d, Eigen::Vector3d> plane_axes(const Eigen::Vector3d& v) {
    const Eigen::Vector3d e = v.unitOrthogonal();
    return {e, v.cross(e)};
}

}  // namespace

TEST_CASE("The pseudo-areas of the case file") {
    const auto data = test::read_case("h27_pseudo_area");
    const double tolerance = data["tol_abs"];
    for (const auto& run : data["runs"]) {
        INFO(run["name"]);
        const Points<3> points = test::to_points(run["points"]);
        Points<3> X(3, 0);
        Offsets offsets{0};
        for (const auto& loop : run["loops"]) {
            for (const Eigen::Index node : loop) {
                X.conservativeResize(3, X.cols() + 1);
                X.rightCols(1) = points.col(node);
            }
            offsets.push_back(static_cast<std::size_t>(X.cols()));
        }
        const auto normal = pseudo_normal(X, offsets);
        CHECK(normal.null == run.contains("error"));
        if (!run.contains("error")) {
            for (int k = 0; k < 3; ++k) {
                const auto i = static_cast<std::size_t>(k);
                CHECK(std::abs(pseudo_area(X, offsets)(k) - run["pseudo_area"][i].get<double>()) <= tolerance);
                CHECK(std::abs(normal.normal(k) - run["pseudo_normal"][i].get<double>()) <= tolerance);
            }
        }
    }
}

TEST_CASE("Proposition 3.4: invariance of the pseudo-area, with det N for reflections") {
    for (int seed = 1; seed <= 50; ++seed) {
        INFO("seed " << seed);
        Random random(seed);
        const Points<3> X = random.multi_loop(16, 0.4);
        const Offsets offsets = Random::offsets(16);
        const Eigen::Vector3d area = pseudo_area(X, offsets);
        Eigen::Vector3d about_c = Eigen::Vector3d::Zero();
        const Eigen::Vector3d c = 3 * random.vector<3>();
        for (Eigen::Index i = 0; i < 24; ++i) {
            const Eigen::Index next = i == 15 ? 0 : i == 23 ? 16 : i + 1;
            about_c += (X.col(i) - c).cross(X.col(next) - c) / 2;
        }
        CHECK((area - about_c).norm() < 1e-13);
        CHECK((pseudo_area(X.colwise() + c, offsets) - area).norm() < 1e-13);
        for (const int sign : {1, -1}) {
            const Eigen::Matrix3d Q = random.orthogonal<3>(sign);
            CHECK((pseudo_area(Q * X, offsets) - sign * Q * area).norm() < 1e-13);
        }
    }
}

TEST_CASE("Proposition 3.5: the projection along the pseudo-area encloses its length") {
    for (int seed = 1; seed <= 50; ++seed) {
        INFO("seed " << seed);
        Random random(seed);
        const Points<3> X = random.orthogonal<3>() * random.multi_loop(20, 0.5);
        const Offsets offsets = Random::offsets(20);
        const auto [e, f] = plane_axes(pseudo_normal(X, offsets).normal);
        CHECK(projected_area(X, offsets, e, f) == Approx(pseudo_area(X, offsets).norm()).epsilon(1e-12));
    }
}

TEST_CASE("Proposition 3.7: no direction sees more signed area than the pseudo-normal") {
    for (int seed = 1; seed <= 50; ++seed) {
        INFO("seed " << seed);
        Random random(seed);
        const Points<3> X = random.orthogonal<3>() * random.multi_loop(20, 0.5);
        const Offsets offsets = Random::offsets(20);
        const Eigen::Vector3d area = pseudo_area(X, offsets);
        const Eigen::Vector3d normal = pseudo_normal(X, offsets).normal;
        for (int repeat = 0; repeat < 20; ++repeat) {
            const Eigen::Vector3d v =
                repeat < 10 ? random.unit<3>() : (normal + 0.05 * random.vector<3>()).normalized();
            const auto [e, f] = plane_axes(v);
            const double seen = projected_area(X, offsets, e, f);
            CHECK(seen == Approx(area.dot(v)).margin(1e-13));
            CHECK(seen <= area.norm() * (1 + 1e-14));
        }
    }
}

TEST_CASE("In the plane the normal of a curve is its chord turned by +90 degrees") {
    Points<2> X(2, 3);
    X << 0, 1, 3, 0, 5, 4;
    CHECK(pseudo_area(X, Offsets{0, 3}) == Eigen::Vector2d(-4, 3));
    CHECK((pseudo_normal(X, Offsets{0, 3}).normal - Eigen::Vector2d(-0.8, 0.6)).norm() < 1e-15);
    X.col(2) = X.col(0);
    CHECK(pseudo_normal(X, Offsets{0, 3}).null);
}

TEST_CASE("First node, order of loops and orientation") {
    Random random(4);
    const Points<3> X = random.multi_loop(12, 0.3);
    const Offsets offsets = Random::offsets(12);
    const Eigen::Vector3d area = pseudo_area(X, offsets);
    Points<3> turned = X;
    turned.leftCols(5) = X.middleCols(7, 5);
    turned.middleCols(5, 7) = X.leftCols(7);
    CHECK((pseudo_area(turned, offsets) - area).norm() < 1e-15);
    Points<3> swapped(3, 18);
    swapped << X.rightCols(6), X.leftCols(12);
    CHECK((pseudo_area(swapped, Offsets{0, 6, 18}) - area).norm() < 1e-15);
    CHECK((pseudo_area(swapped.rowwise().reverse(), Offsets{0, 12, 18}) + area).norm() < 1e-15);
}

TEST_CASE("Offset 1e7, sizes 1e-200 and 1e200, float, thin loops") {
    Random random(6);
    const Points<3> X = random.orthogonal<3>() * random.loop(30, 0.2);
    const Offsets offsets{0, 30};
    const Eigen::Vector3d normal = pseudo_normal(X, offsets).normal;
    const double area = pseudo_area(X, offsets).norm();
    const Points<3> far = X.array() + 1e7;
    const Points<3> exact = far.array() - 1e7;
    CHECK((pseudo_area(far, offsets) - pseudo_area(exact, offsets)).norm() < 1e-14);
    for (const double scale : {1e-200, 1e-6, 1e6, 1e200}) {
        CHECK((pseudo_normal(X * scale, offsets).normal - normal).norm() < 1e-14);
    }
    CHECK(pseudo_area(X * 1e100, offsets).stableNorm() == Approx(area * 1e200).epsilon(1e-12));
    const Eigen::Matrix3Xf single = X.cast<float>();
    CHECK((pseudo_normal(single, offsets).normal.cast<double>() - normal).norm() < 1e-6);
    const Eigen::MatrixXd dynamic = X;
    CHECK(pseudo_normal(dynamic, offsets).normal == normal);
    Points<3> thin = X;
    thin.row(0) *= 1e-7;
    CHECK_FALSE(pseudo_normal(thin, offsets).null);
}

TEST_CASE("Loops without area have no normal, also when rotated and far away") {
    Random random(8);
    Points<3> eight(3, 4);
    eight << -1, 1, 1, -1, -1, 1, -1, 1, 0, 0, 0, 0;
    Points<3> line(3, 5);
    line << 0, 1, 2, 3, 1.5, 0, 1, 2, 3, 1.5, 0, 1, 2, 3, 1.5;
    for (int repeat = 0; repeat < 20; ++repeat) {
        INFO("repeat " << repeat);
        const Eigen::Matrix3d Q = random.orthogonal<3>();
        for (const double offset : {0.0, 10.0, 1e7}) {
            CHECK(pseudo_normal(((Q * eight).array() + offset).matrix(), Offsets{0, 4}).null);
            CHECK(pseudo_normal(((Q * line).array() + offset).matrix(), Offsets{0, 5}).null);
        }
    }
    const Points<3> point = Eigen::Vector3d(1, 2, 3).replicate(1, 3);
    CHECK(pseudo_normal(point, Offsets{0, 3}).null);
    line(0, 0) = std::numeric_limits<double>::quiet_NaN();
    CHECK(pseudo_normal(line, Offsets{0, 5}).null);
}

TEST_CASE("In four dimensions only hyperplanar sets have a normal") {
    Random random(9);
    const Eigen::Vector4d normal = random.unit<4>();
    const auto X = random.hyperplanar<4>(20, normal, random.vector<4>());
    const auto found = pseudo_normal(X, Offsets{0, 20});
    REQUIRE_FALSE(found.null);
    CHECK(std::abs(found.normal.dot(normal)) == Approx(1).epsilon(1e-14));
    CHECK(found.normal.maxCoeff() == found.normal.cwiseAbs().maxCoeff());
    CHECK(pseudo_normal(random.points<4>(20), Offsets{0, 20}).null);
}

TEST_CASE("Errors of callers") {
    const Points<3> X = Random(1).loop(6, 0);
    for (const Offsets& offsets : {Offsets{}, Offsets{0}, Offsets{0, 5}, Offsets{1, 6}, Offsets{0, 4, 2, 6}}) {
        CHECK_THROWS_AS(pseudo_area(X, offsets), InputError);
        CHECK_THROWS_AS(pseudo_normal(X, offsets), InputError);
    }
    CHECK_THROWS_AS(pseudo_area(Points<3>(3, 0), Offsets{0, 0}), InputError);
    CHECK_THROWS_AS(pseudo_area(Eigen::MatrixXd::Random(4, 6), Offsets{0, 6}), InputError);
}

TEST_CASE("Ranges of points have the pseudo-area and pseudo-normal of the matrix") {
    const double ring[4][3] = {{0, 0, 0}, {2, 0, 1}, {2, 1, 0}, {0, 1, 1}};
    const std::vector<std::array<float, 3>> single{{0, 0, 0}, {2, 0, 1}, {2, 1, 0}, {0, 1, 1}};
    const Eigen::Map<const Points<3>> X(&ring[0][0], 3, 4);
    const Offsets loop{0, 4};
    CHECK(pseudo_area(ring, loop) == pseudo_area(X, loop));
    CHECK(pseudo_area(single, loop) == pseudo_area(X, loop));
    CHECK(pseudo_normal(ring, loop).normal == pseudo_normal(X, loop).normal);
    CHECK(pseudo_normal(single, loop).relative_area == pseudo_normal(X, loop).relative_area);
    CHECK_THROWS_AS(pseudo_normal(single, Offsets{0, 5}), InputError);
    CHECK_THROWS_AS(pseudo_area(std::vector<Eigen::Vector3d>(), Offsets{0, 0}), InputError);
}
