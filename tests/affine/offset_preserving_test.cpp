#include "affine/noise_setups.hpp"
#include "affine/random_loops.hpp"
#include "support/catch.hpp"

#include <pavior/affine/fit.hpp>
#include <pavior/affine/minimizers.hpp>
#include <pavior/affine/offset_preserving.hpp>

#include <cmath>

using namespace pavior;
using test::one_loop;
using test::Points;
using test::Random;

namespace {

constexpr auto h = AffineMethod::h;

Points<3> circle(Eigen::Index m, double (*height)(double)) {
    Points<3> X(3, m);
    for (Eigen::Index i = 0; i < m; ++i) {
        const double t = 2 * M_PI * static_cast<double>(i) / static_cast<double>(m);
        X.col(i) << std::cos(t), std::sin(t), height(t);
    }
    return X;
}

}  // namespace

TEST_CASE("Case 3.a: both loops span space, the vectors are the pseudo-normals") {
    for (int seed = 1; seed <= 20; ++seed) {
        INFO("seed " << seed);
        Random random(seed);
        const Points<3> X = random.loop(20, 0.4);
        const Points<3> Y = random.orthogonal<3>() * random.loop(20, 0.4);
        const auto fit = fit_affine(h, X, Y, one_loop<3>(X));
        REQUIRE(fit.status == FitStatus::ok);
        CHECK(fit.rank == 3);
        CHECK(fit.uX == pseudo_normal(X, one_loop<3>(X)).normal);
        CHECK(fit.uY == pseudo_normal(Y, one_loop<3>(X)).normal);
        const Eigen::Matrix3d AF = minimizer_f(loop_pair(X, Y)).A;
        const Eigen::Vector3d v = random.vector<3>();
        const double lambda = v.dot(fit.uX);
        CHECK((fit.map.A * v - (AF * (v - lambda * fit.uX) + lambda * fit.uY)).norm() < 1e-13);
    }
}

TEST_CASE("Case 3.b, Table 3.1: normals of planar loops, kernel and cokernel otherwise, with aligned signs") {
    for (int seed = 1; seed <= 200; ++seed) {
        INFO("seed " << seed);
        Random random(seed);
        const Points<3> flat = random.orthogonal<3>() * random.loop(20, 0);
        const Points<3> flat_too = random.orthogonal<3>() * random.loop(20, 0);
        const Points<3> bent = random.orthogonal<3>() * random.loop(20, 0.4);
        const auto loop = one_loop<3>(flat);
        const auto normal = [&](const Points<3>& points) { return pseudo_normal(points, loop).normal; };
        const auto check = [&](const Points<3>& X, const Points<3>& Y) {
            const auto fit = fit_affine(h, X, Y, loop);
            REQUIRE(fit.status == FitStatus::ok);
            const Eigen::Matrix3d AF = minimizer_f(loop_pair(X, Y)).A;
            CHECK((AF * fit.uX).norm() < 1e-12);
            CHECK((AF.transpose() * fit.uY).norm() < 1e-12);
            CHECK(fit.uX.dot(normal(X)) > 0);
            CHECK(fit.uY.dot(normal(Y)) > 0);
            CHECK((fit.map.A * fit.uX - fit.uY).norm() < 1e-12);
            CHECK_FALSE(fit.ambiguous_normal);
            return fit;
        };
        const auto both = check(flat, flat_too);
        CHECK((both.uX - normal(flat)).norm() < 1e-13);
        CHECK((both.uY - normal(flat_too)).norm() < 1e-13);
        CHECK(both.rank == 2);
        CHECK((check(flat, bent).uX - normal(flat)).norm() < 1e-13);
        CHECK((check(bent, flat).uY - normal(flat)).norm() < 1e-13);
    }
}

TEST_CASE("Two loops that span space may still have a singular A^F") {
    const Points<3> X = circle(24, [](double t) { return 0.2 * std::cos(2 * t); });
    const Points<3> Y = circle(24, [](double t) { return 0.2 * std::sin(2 * t); });
    const auto ranks = pair_ranks(loop_pair(X, Y));
    CHECK(ranks.source_rank == 3);
    CHECK(ranks.target_rank == 3);
    CHECK(ranks.rank == 2);
    CHECK(std::abs(ranks.kernel()(2)) == Approx(1));
    CHECK(std::abs(ranks.cokernel()(2)) == Approx(1));
    const auto fit = fit_affine(h, X, Y, one_loop<3>(X));
    CHECK((fit.map.A - Eigen::Matrix3d::Identity()).norm() < 1e-13);
}

TEST_CASE("A kernel perpendicular to the pseudo-normal is reported as ambiguous") {
    // Y forgets x and keeps the height instead: the kernel of A^F is the x axis, the pseudo-normal of X the z axis.
    const Points<3> X = circle(24, [](double t) { return 0.5 * std::cos(2 * t); });
    Points<3> Y = X;
    Y.row(0) = X.row(2);
    Y.row(2).setZero();
    for (Eigen::Index i = 0; i < 24; ++i) {
        Y(0, i) += 0.3 * std::cos(3 * 2 * M_PI * static_cast<double>(i) / 24);
        Y(1, i) += 0.8 * std::sin(3 * 2 * M_PI * static_cast<double>(i) / 24);
    }
    const auto fit = fit_affine(h, X, Y, one_loop<3>(X));
    REQUIRE(fit.status == FitStatus::ok);
    CHECK(std::abs(fit.uX(0)) == Approx(1));
    CHECK(fit.ambiguous_normal);
    CHECK_FALSE(fit_affine(h, X, X, one_loop<3>(X)).ambiguous_normal);
}

TEST_CASE("Case 3.c: the status says which loop, or that they are unrelated") {
    Random random(2);
    const Points<3> X = random.loop(24, 0.2);
    Points<3> line = X;
    line.bottomRows(2).setZero();
    const auto loop = one_loop<3>(X);
    CHECK(fit_affine(h, line, X, loop).status == FitStatus::source_degenerate);
    CHECK(fit_affine(h, X, line, loop).status == FitStatus::target_degenerate);
    const Points<3> once = circle(24, [](double) { return 0.0; });
    Points<3> twice = once;
    for (Eigen::Index i = 0; i < 24; ++i) {
        twice.col(i) = once.col((5 * i) % 24);
    }
    const auto unrelated = fit_affine(h, once, twice, loop);
    CHECK(unrelated.status == FitStatus::unrelated_loops);
    CHECK(unrelated.correlation < 1e-10);
    CHECK(unrelated.map.cy.array().isNaN().all());
    Points<3> eight = once;
    for (Eigen::Index i = 0; i < 24; ++i) {
        eight(1, i) = 2 * once(0, i) * once(1, i);
    }
    CHECK(fit_affine(h, eight, eight, loop).status == FitStatus::null_pseudo_area);
}

TEST_CASE("A section of 1e6 : 1 that becomes 1 : 1e6 is not degenerate") {
    Random random(3);
    const Points<3> X = random.loop(20, 0);
    Points<3> thin = X;
    thin.row(0) *= 1e6;
    Points<3> tall = X;
    tall.row(1) *= 1e6;
    const auto fit = fit_affine(h, thin, tall, one_loop<3>(X));
    REQUIRE(fit.status == FitStatus::ok);
    CHECK((fit.map.A.diagonal() - Eigen::Vector3d(1e-6, 1e6, 1)).cwiseQuotient(Eigen::Vector3d(1e-6, 1e6, 1)).norm() <
          1e-9);
}

TEST_CASE("Algorithm 3.1 is not Lipschitz: noise above the tolerance is amplified by misfit / eps") {
    using Noise = test::NoiseSetup::Noise;
    for (const double eps : {1e-15, 1e-12, 1e-9}) {
        CHECK(test::worst_movement(h, Noise::off_the_source_plane, 1e-2, eps) < 2 * eps + 2e-15);
        CHECK(test::worst_movement(h, Noise::cad_like, 1e-2, eps) < 2 * eps + 2e-15);
    }
    CHECK(test::worst_movement(h, Noise::off_the_source_plane, 1e-2, 1e-7) > 1e4);
    CHECK(test::worst_movement(h, Noise::off_the_source_plane, 1e-2, 1e-5) > 1e2);
    CHECK(test::worst_movement(h, Noise::off_the_source_plane, 1e-2, 1e-3) > 1);
    for (const double eps : {1e-7, 1e-5, 1e-3, 1e-1}) {
        INFO("eps " << eps);
        CHECK(test::worst_movement(h, Noise::cad_like, 0, eps) > 0.2);
    }
}

TEST_CASE("In four dimensions kernels serve hyperplanar loops, with det A > 0") {
    for (int seed = 1; seed <= 20; ++seed) {
        INFO("seed " << seed);
        Random random(seed);
        const auto X = random.hyperplanar<4>(20, random.unit<4>(), random.vector<4>());
        const Eigen::Matrix4d Q = random.orthogonal<4>();
        const Points<4> Y = (Q * X).colwise() + random.vector<4>();
        const auto fit = fit_affine(h, X, Y, one_loop<4>(X));
        REQUIRE(fit.status == FitStatus::ok);
        CHECK((fit.map.A - Q).norm() < 1e-13);
        const auto full = random.points<4>(20);
        CHECK(fit_affine(h, full, full, one_loop<4>(full)).status == FitStatus::null_pseudo_area);
    }
}

TEST_CASE("offset_vectors gives the case and the vectors of Table 3.1") {
    for (int seed = 1; seed <= 20; ++seed) {
        INFO("seed " << seed);
        Random random(seed);
        const Points<3> flat = random.orthogonal<3>() * random.loop(20, 0);
        const Points<3> flat_too = random.orthogonal<3>() * random.loop(20, 0);
        const Points<3> bent = random.orthogonal<3>() * random.loop(20, 0.4);
        const Points<3> bent_too = random.orthogonal<3>() * random.loop(20, 0.4);
        const auto loop = one_loop<3>(flat);
        const auto normal = [&](const Points<3>& points) { return pseudo_normal(points, loop).normal; };
        const auto vectors_of = [&](const Points<3>& X, const Points<3>& Y) {
            const auto pair = loop_pair(X, Y);
            const FitOptions options;
            const auto vectors = offset_vectors(pair, loop_normals(pair, X, Y, loop, options), options);
            const auto fit = fit_affine(h, X, Y, loop);
            CHECK(vectors.status == FitStatus::ok);
            CHECK(vectors.uX == fit.uX);
            CHECK(vectors.uY == fit.uY);
            CHECK(vectors.rank == fit.rank);
            CHECK(vectors.correlation == fit.correlation);
            CHECK(vectors.uX.norm() == Approx(1));
            CHECK(vectors.uY.norm() == Approx(1));
            return vectors;
        };
        const auto a = vectors_of(bent, bent_too);
        CHECK(a.which == OffsetCase::pseudo_normals);
        CHECK((!a.source_hyperplanar && !a.target_hyperplanar));
        CHECK(a.uX == normal(bent));
        CHECK(a.uY == normal(bent_too));

        const auto both = vectors_of(flat, flat_too);
        CHECK(both.which == OffsetCase::kernel);
        CHECK((both.source_hyperplanar && both.target_hyperplanar));
        CHECK((both.uX - normal(flat)).norm() < 1e-13);
        CHECK((both.uY - normal(flat_too)).norm() < 1e-13);

        const auto source = vectors_of(flat, bent);
        CHECK(source.which == OffsetCase::kernel);
        CHECK((source.source_hyperplanar && !source.target_hyperplanar));
        CHECK((source.uX - normal(flat)).norm() < 1e-13);
        CHECK((minimizer_f(loop_pair(flat, bent)).A.transpose() * source.uY).norm() < 1e-12);
        CHECK((source.uY - normal(bent)).norm() > 1e-3);  // u_n, not the pseudo-normal

        const auto target = vectors_of(bent, flat);
        CHECK(target.which == OffsetCase::kernel);
        CHECK((!target.source_hyperplanar && target.target_hyperplanar));
        CHECK((minimizer_f(loop_pair(bent, flat)).A * target.uX).norm() < 1e-12);
        CHECK((target.uX - normal(bent)).norm() > 1e-3);  // v_n, not the pseudo-normal
        CHECK((target.uY - normal(flat)).norm() < 1e-13);
    }
}

TEST_CASE("offset_vectors: loops without vectors, the case that Table 3.1 leaves out, higher dimensions") {
    const auto vectors_of = [](const auto& X, const auto& Y) {
        const auto pair = loop_pair(X, Y);
        return offset_vectors(pair, loop_normals(pair, X, Y, test::Offsets{0, static_cast<std::size_t>(X.cols())}, {}));
    };
    const Points<3> flat = circle(24, [](double) { return 0.0; });
    const Points<3> up = circle(24, [](double t) { return 0.2 * std::cos(2 * t); });
    const Points<3> across = circle(24, [](double t) { return 0.2 * std::sin(2 * t); });
    const auto left_out = vectors_of(up, across);  // both span space, A^F does not
    CHECK(left_out.which == OffsetCase::kernel);
    CHECK((!left_out.source_hyperplanar && !left_out.target_hyperplanar));
    CHECK((left_out.uX - Eigen::Vector3d::UnitZ()).norm() < 1e-13);

    Points<3> line = flat;
    line.bottomRows(2).setZero();
    const auto none = vectors_of(line, flat);
    CHECK(none.which == OffsetCase::degenerate);
    CHECK(none.status == FitStatus::source_degenerate);
    CHECK(none.uX.isZero());
    CHECK(vectors_of(flat, line).at_target);
    Points<3> eight = flat;
    for (Eigen::Index i = 0; i < 24; ++i) {
        eight(1, i) = 2 * flat(0, i) * flat(1, i);
    }
    const auto null = vectors_of(eight, eight);
    CHECK(null.which == OffsetCase::kernel);
    CHECK(null.status == FitStatus::null_pseudo_area);
    CHECK(null.uY.isZero());
    Points<3> infinite = flat;
    infinite(0, 0) = HUGE_VAL;
    CHECK(vectors_of(flat, infinite).status == FitStatus::not_finite);
    CHECK(vectors_of(flat, infinite).at_target);
    CHECK(to_string(OffsetCase::pseudo_normals) == "3.a");
    CHECK(to_string(OffsetCase::kernel) == "3.b");
    CHECK(to_string(OffsetCase::degenerate) == "3.c");

    Random random(5);
    Points<4> hyperplane = random.points<4>(20);
    hyperplane.row(3).setZero();
    const Points<4> moved = random.linear<4>() * hyperplane;
    const auto four = vectors_of(hyperplane, moved);
    CHECK(four.which == OffsetCase::kernel);
    const Eigen::Matrix4d AF = minimizer_f(loop_pair(hyperplane, moved)).A;
    CHECK((AF + four.uY * four.uX.transpose()).determinant() > 0);
}
