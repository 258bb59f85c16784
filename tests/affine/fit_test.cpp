#include "affine/random_loops.hpp"
#include "support/catch.hpp"

#include <pavior/affine/affinity.hpp>
#include <pavior/affine/detail/point_columns.hpp>
#include <pavior/affine/fit.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <deque>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

using namespace pavior;
using test::Offsets;
using test::one_loop;
using test::Points;
using test::Random;

namespace {

constexpr AffineMethod methods[] = {AffineMethod::constrained, AffineMethod::h, AffineMethod::g, AffineMethod::f};
constexpr AffineMethod offset_preserving[] = {AffineMethod::constrained, AffineMethod::h};

/// Two multi-loops that correspond, planar or not, and some nodes near the source.
struct Scene {
    Random random;
    Points<3> X;
    Points<3> Y;
    Points<3> nodes;
    Offsets offsets = Random::offsets(16);

    explicit Scene(int seed, double height = 0.4) : random(seed) {
        X = random.orthogonal<3>() * random.multi_loop(16, height);
        Y = random.linear<3>() * X;
        if (height > 0) {
            Y += 0.1 * random.points<3>(24);
        }
        Y.colwise() += Eigen::Vector3d(3, -1, 2);
        nodes = 0.5 * random.points<3>(10);
    }
};

template <class Map>
Points<3> images(const Map& map, const Points<3>& nodes) {
    Points<3> result(3, nodes.cols());
    for (Eigen::Index j = 0; j < nodes.cols(); ++j) {
        result.col(j) = map(nodes.col(j));
    }
    return result;
}

double distance(const Points<3>& a, const Points<3>& b) { return (a - b).colwise().norm().maxCoeff(); }

/// Calls check(scene, method, phi, description) for planar and non-planar scenes.
template <class Check>
void for_scenes(const Check& check) {
    for (const double height : {0.4, 0.0}) {
        for (int seed = 1; seed <= 15; ++seed) {
            for (const auto method : methods) {
                Scene scene(seed, height);
                INFO("height " << height << ", seed " << seed << ", method " << to_string(method));
                const auto fit = fit_affine(method, scene.X, scene.Y, scene.offsets);
                REQUIRE(fit.status == FitStatus::ok);
                check(scene, method, fit);
            }
        }
    }
}

}  // namespace

TEST_CASE("Inner levels of the case files, direct, without correction") {
    for (const auto* name : {"h01_translation", "h05_one_hole", "h07_nonparallel_caps", "h20_cad_noise",
                             "s35_flattening", "s35_flipping", "s35_offset_scaling", "s35_skewing"}) {
        const auto data = test::read_case(name);
        const double tolerance = data["tol_abs"];
        const Points<3> source = test::to_points(data["source_nodes"]);
        const Points<3> target = test::to_points(data["target_nodes"]);
        const auto inner = data["inner"].get<std::vector<Eigen::Index>>();
        const auto r = data["layers"].get<std::size_t>();
        Offsets offsets{0};
        for (const auto& loop : data["loops"]) {
            offsets.push_back(offsets.back() + loop.size());
        }
        const auto& levels = data["boundary_levels"];
        const Points<3> first = test::to_points(levels[0]);
        const Points<3> last = test::to_points(levels[r]);
        const std::pair<const char*, AffineMethod> runs[] = {{"F", AffineMethod::f},
                                                             {"G", AffineMethod::g},
                                                             {"H31", AffineMethod::h},
                                                             {"HC", AffineMethod::constrained}};
        for (const auto& [key, method] : runs) {
            double worst = 0;
            for (std::size_t k = 1; k < r; ++k) {
                const Points<3> level = test::to_points(levels[k]);
                const auto from_source = fit_affine(method, first, level, offsets);
                const auto from_target = fit_affine(method, last, level, offsets);
                const Points<3> expected = test::to_points(data["expected"]["direct"][key][k - 1]);
                const double t = static_cast<double>(k) / static_cast<double>(r);
                for (std::size_t i = 0; i < inner.size(); ++i) {
                    const Eigen::Vector3d z =
                        (1 - t) * from_source.map(source.col(inner[i])) + t * from_target.map(target.col(inner[i]));
                    worst = std::max(worst, (z - expected.col(static_cast<Eigen::Index>(i))).cwiseAbs().maxCoeff());
                }
            }
            INFO(name << " " << key << " " << worst);
            CHECK(worst <= tolerance);
        }
    }
}

TEST_CASE("The centre goes to the centre, and offsets along uX to offsets along uY") {
    for_scenes([](const Scene& s, AffineMethod method, const auto& fit) {
        const Eigen::Vector3d z = s.nodes.col(0);
        if (method != AffineMethod::g) {
            CHECK((fit.map(s.X.rowwise().mean()) - s.Y.rowwise().mean()).norm() < 1e-13);
        }
        if (method == AffineMethod::constrained || method == AffineMethod::h) {
            CHECK((fit.map(z + 0.7 * fit.uX) - fit.map(z) - 0.7 * fit.uY).norm() < 1e-12);
        }
        double residual = 0;
        for (Eigen::Index i = 0; i < s.X.cols(); ++i) {
            residual = std::max(residual, (s.Y.col(i) - fit.map(s.X.col(i))).norm());
        }
        CHECK(fit.residual == Approx(residual).margin(1e-13));
    });
}

TEST_CASE("Rigid motions and reflections of source and target move the result along") {
    for_scenes([](Scene& s, AffineMethod method, const auto& fit) {
        for (const int sign : {1, -1}) {
            const Eigen::Matrix3d R1 = s.random.template orthogonal<3>(sign);
            const Eigen::Matrix3d R2 = s.random.template orthogonal<3>(sign);
            const Eigen::Vector3d t1 = s.random.template vector<3>();
            const Eigen::Vector3d t2 = s.random.template vector<3>();
            const Points<3> X1 = (R1 * s.X).colwise() + t1;
            const Points<3> nodes1 = (R1 * s.nodes).colwise() + t1;
            const Points<3> before = images(fit.map, s.nodes);
            const Points<3> common = (R1 * s.Y).colwise() + t1;
            const auto together = fit_affine(method, X1, common, s.offsets);
            CHECK(distance(images(together.map, nodes1), (R1 * before).colwise() + t1) < 1e-11);
            if (method != AffineMethod::g) {
                const Points<3> Y2 = (R2 * s.Y).colwise() + t2;
                const auto apart = fit_affine(method, X1, Y2, s.offsets);
                CHECK(distance(images(apart.map, nodes1), (R2 * before).colwise() + t2) < 1e-11);
            }
        }
    });
}

TEST_CASE("Common scaling by 1e-200 to 1e200") {
    for_scenes([](const Scene& s, AffineMethod method, const auto& fit) {
        const Points<3> before = images(fit.map, s.nodes);
        for (const double scale : {1e-200, 1e-6, 1e-3, 1e3, 1e6, 1e200}) {
            INFO("scale " << scale);
            const auto scaled = fit_affine(method, scale * s.X, scale * s.Y, s.offsets);
            REQUIRE(scaled.status == FitStatus::ok);
            CHECK(distance(images(scaled.map, scale * s.nodes) / scale, before) < 1e-11);
            CHECK(scaled.residual / scale == Approx(fit.residual).margin(1e-12));
        }
        const auto power = fit_affine(method, 1024 * s.X, 1024 * s.Y, s.offsets);
        CHECK(power.map.A == fit.map.A);
    });
}

TEST_CASE("Y = X gives the identity") {
    for (int seed = 1; seed <= 15; ++seed) {
        for (const auto method : methods) {
            INFO("seed " << seed << ", method " << to_string(method));
            const Scene s(seed);
            const auto fit = fit_affine(method, s.X, s.X, s.offsets);
            CHECK(distance(images(fit.map, s.nodes), s.nodes) < 1e-13);
            CHECK(fit.residual < 1e-13);
        }
        const Scene planar(seed, 0);
        for (const auto method : offset_preserving) {
            const auto fit = fit_affine(method, planar.X, planar.X, planar.offsets);
            CHECK(distance(images(fit.map, planar.nodes), planar.nodes) < 1e-13);
        }
    }
}

TEST_CASE("First node, order of the loops and their common direction do not matter") {
    for_scenes([](const Scene& s, AffineMethod method, const auto& fit) {
        const Points<3> before = images(fit.map, s.nodes);
        const auto check = [&](const auto& reorder, const Offsets& offsets) {
            const auto other = fit_affine(method, Points<3>(reorder(s.X)), Points<3>(reorder(s.Y)), offsets);
            CHECK(distance(images(other.map, s.nodes), before) < 1e-12);
        };
        check(
            [](const Points<3>& P) {
                Points<3> turned = P;
                turned << P.middleCols(5, 11), P.leftCols(5), P.middleCols(19, 5), P.middleCols(16, 3);
                return turned;
            },
            s.offsets);
        check(
            [](const Points<3>& P) {
                Points<3> swapped = P;
                swapped << P.rightCols(8), P.leftCols(16);
                return swapped;
            },
            Offsets{0, 8, 24});
        check([](const Points<3>& P) { return Points<3>(P.rowwise().reverse()); }, Offsets{0, 8, 24});
    });
}

TEST_CASE("Planar affine loops: h and constrained agree, and both are exact on the loop") {
    for (int seed = 1; seed <= 30; ++seed) {
        INFO("seed " << seed);
        const Scene s(seed, 0);
        const auto h = fit_affine(AffineMethod::h, s.X, s.Y, s.offsets);
        const auto constrained = fit_affine(AffineMethod::constrained, s.X, s.Y, s.offsets);
        CHECK((h.map.A - constrained.map.A).norm() < 1e-12);
        CHECK(h.residual < 1e-13);
        CHECK(constrained.residual < 1e-13);
    }
}

TEST_CASE("Far from the origin: offset 1e7") {
    for_scenes([](const Scene& s, AffineMethod method, const auto& fit) {
        const Points<3> X = s.X.array() + 1e7;
        const Points<3> Y = s.Y.array() + 1e7;
        const Points<3> nodes = s.nodes.array() + 1e7;
        const auto far = fit_affine(method, X, Y, s.offsets);
        REQUIRE(far.status == FitStatus::ok);
        const Points<3> moved = images(far.map, nodes).array() - 1e7;
        CHECK(distance(moved, images(fit.map, s.nodes)) < 1e-7);
    });
}

TEST_CASE("In the plane, curves between end points") {
    Points<2> X(2, 5);
    X << 0, 1, 2, 3, 4, 0, 0, 0, 0, 0;
    const Points<2> Y = (X.array() + 1).matrix();
    Points<2> upright(2, 5);
    upright << 0, 0, 0, 0, 0, 0, 2, 4, 6, 8;
    for (const auto method : offset_preserving) {
        const auto shifted = fit_affine(method, X, Y, one_loop<2>(X));
        REQUIRE(shifted.status == FitStatus::ok);
        CHECK((shifted.map(Eigen::Vector2d(2, 0.5)) - Eigen::Vector2d(3, 1.5)).norm() < 1e-14);
        const auto turned = fit_affine(method, X, upright, one_loop<2>(X));
        CHECK((turned.map(Eigen::Vector2d(2, 0.5)) - Eigen::Vector2d(-0.5, 4)).norm() < 1e-13);
    }
    CHECK((fit_affine(AffineMethod::f, X, upright, one_loop<2>(X)).map.A * Eigen::Vector2d::UnitY()).norm() < 1e-14);
}

TEST_CASE("f and g need no normals: a figure eight has a map") {
    Points<3> eight(3, 4);
    eight << -1, 1, 1, -1, -1, 1, -1, 1, 0, 0, 0, 0;
    const Points<3> moved = eight.colwise() + Eigen::Vector3d(0, 0, 1);
    for (const auto method : {AffineMethod::f, AffineMethod::g}) {
        const auto fit = fit_affine(method, eight, moved, Offsets{0, 4});
        CHECK(fit.status == FitStatus::ok);
        CHECK(fit.residual < 1e-14);
    }
    for (const auto method : offset_preserving) {
        CHECK(fit_affine(method, eight, moved, Offsets{0, 4}).status == FitStatus::null_pseudo_area);
    }
    Points<3> line = eight;
    line.row(1) = line.row(0);
    const auto fit = fit_affine(AffineMethod::f, line, moved, Offsets{0, 4});
    CHECK(fit.status == FitStatus::source_degenerate);
    CHECK(fit.map.A.allFinite());
}

TEST_CASE("Float follows double, dynamic dimension equals fixed, any storage will do") {
    for_scenes([](const Scene& s, AffineMethod method, const auto& fit) {
        const Points<3> before = images(fit.map, s.nodes);
        const auto single = fit_affine(method, s.X.cast<float>(), s.Y.cast<float>(), s.offsets);
        REQUIRE(single.status == FitStatus::ok);
        const AffineMap<double, 3> cast{single.map.A.template cast<double>(), single.map.cx.template cast<double>(),
                                        single.map.cy.template cast<double>()};
        CHECK(distance(images(cast, s.nodes), before) < 1e-4);
        const Eigen::MatrixXd X = s.X;
        const Eigen::MatrixXd Y = s.Y;
        const auto dynamic = fit_affine(method, X, Y, s.offsets);
        REQUIRE(dynamic.status == FitStatus::ok);
        CHECK((dynamic.map.A - fit.map.A).norm() < 1e-12);
        CHECK(dynamic.rank == fit.rank);
        const Eigen::Map<const Eigen::Matrix3Xd> mapped(s.X.data(), 3, 24);
        const Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor> rows = s.Y.transpose();
        CHECK(fit_affine(method, mapped, rows.transpose(), s.offsets).map.A == fit.map.A);
        CHECK(fit_affine<double, 3>(method, s.X, s.Y, s.offsets).map.A == fit.map.A);
    });
}

TEST_CASE("Coordinates that are not finite give status not_finite and a map of NaN") {
    const Scene s(1);
    for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
        for (const auto method : methods) {
            Points<3> X = s.X;
            X(1, 3) = bad;
            const auto source = fit_affine(method, X, s.Y, s.offsets);
            CHECK(source.status == FitStatus::not_finite);
            CHECK_FALSE(source.at_target);
            CHECK(source.map.A.array().isNaN().all());
            const auto target = fit_affine(method, s.X, X, s.offsets);
            CHECK(target.status == FitStatus::not_finite);
            CHECK(target.at_target);
        }
    }
}

TEST_CASE("Errors of callers are typed") {
    const Scene s(1);
    const auto code = [](const auto& call) {
        try {
            call();
        } catch (const InputError& error) {
            return std::string(to_string(error.code()));
        }
        return std::string("none");
    };
    const auto method = AffineMethod::constrained;
    CHECK(code([&] { (void)fit_affine(method, s.X, s.Y.leftCols(5), s.offsets); }) == "size_mismatch");
    CHECK(code([&] { (void)fit_affine(method, Points<3>(3, 0), Points<3>(3, 0), Offsets{0, 0}); }) == "empty_input");
    CHECK(code([&] { (void)fit_affine(method, s.X, s.Y, Offsets{0, 10}); }) == "bad_index");
    CHECK(code([&] { (void)fit_affine(method, s.X, s.Y, s.offsets); }) == "none");
}

TEST_CASE("Points as meshes keep them: in place where they are three doubles, copied otherwise") {
    const Scene s(1);
    const auto as = [&](const Points<3>& points, auto make) {
        std::vector<decltype(make(Vec3()))> list;
        for (Eigen::Index i = 0; i < points.cols(); ++i) {
            list.push_back(make(Vec3(points.col(i))));
        }
        return list;
    };
    struct Tagged {  // four doubles from point to point
        double x[3];
        std::int64_t tag = 7;
        const double& operator[](std::size_t k) const { return x[k]; }
    };
    struct Backwards {  // three doubles, but not in the order of the axes
        double z, y, x;
        const double& operator[](std::size_t k) const { return k == 0 ? x : k == 1 ? y : z; }
    };
    const auto vec = [](const Vec3& x) { return x; };
    const auto array = [](const Vec3& x) { return std::array{x[0], x[1], x[2]}; };
    const auto tagged = [](const Vec3& x) { return Tagged{{x[0], x[1], x[2]}, 7}; };
    const auto backwards = [](const Vec3& x) { return Backwards{x[2], x[1], x[0]}; };
    const auto list = [](const Vec3& x) { return std::vector{x[0], x[1], x[2]}; };
    for (const auto method : methods) {
        const auto expected = fit_affine(method, s.X, s.Y, s.offsets);
        const auto same = [&](const AffineFit<double, 3>& fit) {
            CHECK(fit.map.A == expected.map.A);
            CHECK(fit.map.cy == expected.map.cy);
            CHECK(fit.residual == expected.residual);
        };
        same(fit_affine(method, as(s.X, vec), as(s.Y, array), s.offsets));
        same(fit_affine(method, as(s.X, tagged), as(s.Y, backwards), s.offsets));
        const auto lists = as(s.Y, list);
        const auto source = as(s.X, vec);
        same(fit_affine(method, std::deque<Vec3>(source.begin(), source.end()), as(s.Y, list), s.offsets));
    }
    const auto points = as(s.X, vec);
    CHECK(detail::PointColumns(points).matrix().data() == points.front().data());
    const auto with_tags = as(s.X, tagged);
    CHECK(detail::PointColumns(with_tags).matrix().data() == &with_tags[0][0]);
    CHECK(detail::PointColumns(with_tags).matrix().outerStride() == 4);
    CHECK(detail::PointColumns(std::span<const Vec3>(points)).matrix() == s.X);
    CHECK_THROWS_AS(fit_affine(AffineMethod::f, points, std::span(points).first(2), s.offsets), InputError);
    CHECK_THROWS_AS(fit_affine(AffineMethod::f, std::vector<Vec3>(), std::vector<Vec3>(), s.offsets), InputError);
}
