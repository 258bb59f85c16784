#include "support/catch.hpp"

#include <pavior/mesh/cells.hpp>
#include <pavior/sweep/ribs.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <vector>

using namespace pavior;

namespace {

constexpr double pi = std::numbers::pi;

/// An S of 180 + 180 degrees: two half rings of mean radius 1 one after the other. The curve at distance `offset` to
/// the left of the middle line is the outer edge of the first half and the inner edge of the second (offset > 0).
struct SCurve {
    double offset = 0.0;
    double z = 0.0;
    double fold = 0.0;  ///< the second half ring is turned by this angle about the x axis
    [[nodiscard]] Vec3 operator()(double t) const {
        if (t <= 0.5) {
            const double angle = pi * (1.0 - 2.0 * t);
            return {(1.0 + offset) * std::cos(angle), (1.0 + offset) * std::sin(angle), z};
        }
        const double angle = pi * (1.0 + 2.0 * (t - 0.5));
        const double y = (1.0 - offset) * std::sin(angle);
        return {2.0 + (1.0 - offset) * std::cos(angle), std::cos(fold) * y, z + std::sin(fold) * y};
    }
};

double cross2(const Vec3& a, const Vec3& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Folded quads of the strip between two curves in the plane, by the signed areas of their corners.
template <class A, class B>
std::size_t folded_strip(const A& a, const B& b, const std::vector<double>& ta, const std::vector<double>& tb,
                         double orientation) {
    std::size_t folded = 0;
    for (std::size_t k = 0; k + 1 < ta.size(); ++k) {
        const std::array<Vec3, 4> x{a(ta[k]), b(tb[k]), b(tb[k + 1]), a(ta[k + 1])};
        bool good = true;
        for (std::size_t c = 0; c < 4; ++c) {
            good = good && orientation * cross2(x[(c + 1) % 4] - x[c], x[(c + 3) % 4] - x[c]) > 0.0;
        }
        folded += good ? 0 : 1;
    }
    return folded;
}

/// Parameters of equal arc lengths.
template <class C>
std::vector<double> equal_arcs(const C& curve, std::size_t n) {
    constexpr std::size_t fine = 4000;
    std::vector<double> length(fine + 1, 0.0);
    for (std::size_t i = 1; i <= fine; ++i) {
        const double h = 1.0 / static_cast<double>(fine);
        length[i] = length[i - 1] + (curve(h * static_cast<double>(i)) - curve(h * static_cast<double>(i - 1))).norm();
    }
    std::vector<double> t;
    for (std::size_t k = 0; k <= n; ++k) {
        const double wanted = length.back() * static_cast<double>(k) / static_cast<double>(n);
        const auto at = std::upper_bound(length.begin() + 1, length.end() - 1, wanted) - length.begin();
        const auto i = static_cast<std::size_t>(at);
        const double part = (wanted - length[i - 1]) / (length[i] - length[i - 1]);
        t.push_back((static_cast<double>(i - 1) + part) / static_cast<double>(fine));
    }
    return t;
}

void check_increasing(const RibPositions& positions, std::size_t levels) {
    for (const auto& rib : positions.parameters) {
        REQUIRE(rib.size() == levels);
        CHECK(rib.front() == 0.0);
        CHECK(rib.back() == 1.0);
        for (std::size_t k = 1; k < rib.size(); ++k) {
            CHECK(rib[k - 1] < rib[k]);
        }
    }
}

double corner_det(const std::array<Vec3, 8>& x) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t c = 0; c < 8; ++c) {
        std::array<Vec3, 3> e;
        for (std::size_t i = 0; i < 3; ++i) {
            e[i] = (x[static_cast<std::size_t>(hex_corner_neighbours[c][i])] - x[c]).normalized();
        }
        least = std::min(least, e[0].cross(e[1]).dot(e[2]));
    }
    return least;
}

/// Inverted hexahedra of a square section swept along four ribs, m x m hexahedra a layer, sections bilinear.
template <class C>
std::size_t inverted_hexes(const std::vector<C>& ribs, const std::vector<std::vector<double>>& t, std::size_t m) {
    const auto at = [&](std::size_t i, std::size_t j, std::size_t k) {
        const double u = static_cast<double>(i) / static_cast<double>(m);
        const double v = static_cast<double>(j) / static_cast<double>(m);
        return Vec3((1.0 - u) * (1.0 - v) * ribs[0](t[0][k]) + u * (1.0 - v) * ribs[1](t[1][k]) +
                    u * v * ribs[2](t[2][k]) + (1.0 - u) * v * ribs[3](t[3][k]));
    };
    std::size_t inverted = 0;
    for (std::size_t k = 0; k + 1 < t[0].size(); ++k) {
        for (std::size_t j = 0; j < m; ++j) {
            for (std::size_t i = 0; i < m; ++i) {
                inverted +=
                    corner_det({at(i, j, k), at(i + 1, j, k), at(i + 1, j + 1, k), at(i, j + 1, k), at(i, j, k + 1),
                                at(i + 1, j, k + 1), at(i + 1, j + 1, k + 1), at(i, j + 1, k + 1)}) > 0.0
                        ? 0
                        : 1;
            }
        }
    }
    return inverted;
}

/// The four ribs of a square section: quads run counter-clockwise seen from the tip of the sweep direction.
std::vector<SCurve> square_ribs(double width, double fold = 0.0) {
    const double h = 0.5 * width;
    return {{h, -h, fold}, {h, h, fold}, {-h, h, fold}, {-h, -h, fold}};
}

}  // namespace

TEST_CASE("an S of 180 + 180 degrees: equal spacing folds quads, followed nodes do not") {
    for (const double width : {0.6, 1.0, 1.4, 1.8}) {
        for (const std::size_t n : {8U, 12U, 20U, 21U, 40U, 100U}) {
            const SCurve a{0.5 * width};
            const SCurve b{-0.5 * width};
            // b lies to the right of a: the strip a -> b, then forward, is positive.
            const std::size_t equal = folded_strip(a, b, equal_arcs(a, n), equal_arcs(b, n), 1.0);
            const RibPositions positions = opposite_positions(a, b, Spacing::uniform(n));
            INFO("width " << width << ", n " << n << ", equal spacing folds " << equal << ", min det "
                          << positions.min_det);
            check_increasing(positions, n + 1);
            CHECK(folded_strip(a, b, positions.parameters[0], positions.parameters[1], 1.0) == 0);
            CHECK(positions.folded == 0);
            CHECK(positions.folded_equal + 1 >= equal);  // corners of sine 0 may count either way
            CHECK(positions.folded_equal <= equal + 1);
            CHECK((equal == 0 || !positions.equal_spacing));
            if (width >= 1.0 && n >= 12) {
                CHECK(equal > 0);
                CHECK(positions.min_det > 0.5);
            }
        }
    }
}

TEST_CASE("swapping or reversing the curves swaps or reverses the positions") {
    const SCurve a{0.7};
    const SCurve b{-0.7};
    const auto ab = opposite_positions(a, b, Spacing::uniform(20));
    const auto ba = opposite_positions(b, a, Spacing::uniform(20));
    CHECK(ab.parameters[0] == ba.parameters[1]);
    CHECK(ab.parameters[1] == ba.parameters[0]);
    const auto back = opposite_positions([&](double t) { return a(1.0 - t); }, [&](double t) { return b(1.0 - t); },
                                         Spacing::uniform(20));
    for (std::size_t k = 0; k <= 20; ++k) {
        CHECK(back.parameters[0][k] == Approx(1.0 - ab.parameters[0][20 - k]).margin(2e-3));
    }
}

TEST_CASE("joining segments are nearly perpendicular to the S away from its inflection") {
    const SCurve a{0.7};
    const SCurve b{-0.7};
    RibOptions options;
    options.min_spacing = 0.0;
    const auto positions = opposite_positions(a, b, Spacing::uniform(32), options);
    for (const std::size_t k : {4U, 8U, 12U, 20U, 24U, 28U}) {
        CHECK(positions.parameters[0][k] == Approx(positions.parameters[1][k]).margin(0.01));
    }
}

TEST_CASE("equal spacing stays where no quad folds") {
    const auto check = [](const auto& a, const auto& b, const Spacing& spacing) {
        const auto positions = opposite_positions(a, b, spacing);
        CHECK(positions.equal_spacing);
        CHECK(positions.folded_equal == 0);
        CHECK(positions.min_det == positions.min_det_equal);
        for (const auto& rib : positions.parameters) {
            for (std::size_t k = 0; k <= spacing.intervals(); ++k) {
                CHECK(rib[k] == Approx(spacing[k]).margin(1e-5));
            }
        }
    };
    const auto line = [](const Vec3& from, const Vec3& to) {
        return [from, to](double t) { return Vec3(from + t * (to - from)); };
    };
    const auto arc = [](double radius) {
        return [radius](double t) { return Vec3(radius * std::cos(pi * t), radius * std::sin(pi * t), 0.0); };
    };
    check(line({0, 0, 0}, {5, 0, 0}), line({0, 1, 0}, {5, 1, 0}), Spacing::uniform(7));
    check(line({0, 0, 0}, {5, 0, 0}), line({3, 1, 0}, {8, 1, 0}), Spacing::uniform(7));  // sheared, oblique caps
    check(arc(1.0), arc(5.0), Spacing::uniform(9));
    check(line({0, 0, 0}, {1, 0, 0}), line({0, 1, 0}, {1, 1, 2}), Spacing::geometric(6, 1.5));
    CHECK(opposite_positions(SCurve{0.05}, SCurve{-0.05}, Spacing::uniform(100)).equal_spacing);
}

TEST_CASE("positions are given in the curves' own parameters, equal by arc length") {
    const auto fast = [](double t) { return Vec3(t * t * t, 0.0, 0.0); };
    const auto even = [](double t) { return Vec3(t, 1.0, 0.0); };
    const auto positions = opposite_positions(fast, even, Spacing::uniform(4));
    for (std::size_t k = 0; k <= 4; ++k) {
        CHECK(positions.parameters[0][k] == Approx(std::cbrt(0.25 * static_cast<double>(k))).margin(1e-4));
        CHECK(positions.parameters[1][k] == Approx(0.25 * static_cast<double>(k)).margin(1e-12));
    }
}

TEST_CASE("a polyline is a rib, t by arc length") {
    const Polyline line({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 0, 0), Vec3(1, 3, 0)});
    CHECK(line(0.0) == Vec3(0, 0, 0));
    CHECK((line(0.25) - Vec3(1, 0, 0)).norm() < 1e-15);
    CHECK((line(0.5) - Vec3(1, 1, 0)).norm() < 1e-15);
    CHECK(line(1.0) == Vec3(1, 3, 0));
    const auto sampled = [](double offset) {
        std::vector<Vec3> points;
        for (int i = 0; i <= 200; ++i) {
            points.push_back(SCurve{offset}(i / 200.0));
        }
        return Polyline(points);
    };
    const Polyline a = sampled(0.7);
    const Polyline b = sampled(-0.7);
    const auto positions = opposite_positions(a, b, Spacing::uniform(20));
    CHECK(positions.folded_equal > 0);
    CHECK(folded_strip(a, b, positions.parameters[0], positions.parameters[1], 1.0) == 0);
}

TEST_CASE("a bend round a sharp inner corner folds or nearly folds with equal spacing only") {
    // An L: the inner edge turns at (1, 1), the outer one at (2, 0); then back again with the roles swapped: a Z.
    const Polyline a({Vec3(0, 0, 0), Vec3(4, 0, 0), Vec3(4, 4, 0), Vec3(8, 4, 0)});
    const Polyline b({Vec3(0, 1.5, 0), Vec3(2.5, 1.5, 0), Vec3(2.5, 5.5, 0), Vec3(8, 5.5, 0)});
    for (const std::size_t n : {12U, 24U, 60U}) {
        const auto positions = opposite_positions(a, b, Spacing::uniform(n));
        INFO("n " << n << ", folded " << positions.folded_equal << " -> " << positions.folded << ", min det "
                  << positions.min_det_equal << " -> " << positions.min_det);
        check_increasing(positions, n + 1);
        CHECK(folded_strip(a, b, positions.parameters[0], positions.parameters[1], -1.0) == 0);
        CHECK_FALSE(positions.equal_spacing);
        CHECK(positions.min_det > positions.min_det_equal);
    }
}

TEST_CASE("a square section swept along the S: equal spacing inverts hexahedra, followed ribs do not") {
    for (const double fold : {0.0, 0.6}) {
        for (const double width : {1.0, 1.4}) {
            for (const std::size_t n : {12U, 25U, 60U}) {
                const std::vector<SCurve> ribs = square_ribs(width, fold);
                std::vector<std::vector<double>> equal;
                for (const SCurve& rib : ribs) {
                    equal.push_back(equal_arcs(rib, n));
                }
                const std::vector<std::size_t> offsets{0, 4};
                const auto positions = rib_positions(std::span<const SCurve>(ribs), offsets, Spacing::uniform(n));
                INFO("fold " << fold << ", width " << width << ", n " << n << ", equal spacing inverts "
                             << inverted_hexes(ribs, equal, 3));
                check_increasing(positions, n + 1);
                CHECK(inverted_hexes(ribs, equal, 3) > 0);
                CHECK(inverted_hexes(ribs, positions.parameters, 3) == 0);
                CHECK(positions.folded_equal > 0);
                CHECK(positions.folded == 0);
                CHECK_FALSE(positions.equal_spacing);
            }
        }
    }
}

TEST_CASE("levels of many ribs are nearly planar and perpendicular to the path") {
    std::vector<std::function<Vec3(double)>> ribs;
    for (int i = 0; i < 8; ++i) {
        const double angle = 2.0 * pi * i / 8.0;
        ribs.emplace_back(SCurve{0.6 * std::cos(angle), 0.6 * std::sin(angle)});
    }
    const std::vector<std::size_t> offsets{0, 8};
    const auto positions =
        rib_positions(std::span<const std::function<Vec3(double)>>(ribs), offsets, Spacing::uniform(32));
    CHECK(positions.folded_equal > 0);
    CHECK(positions.folded == 0);
    for (const std::size_t k : {4U, 8U, 12U, 20U, 24U, 28U}) {
        for (const auto& rib : positions.parameters) {
            CHECK(rib[k] == Approx(positions.parameters[2][k]).margin(0.02));  // that rib is the middle line
        }
    }
}

TEST_CASE("a single rib and loops of one or two ribs") {
    const std::vector<SCurve> ribs{{0.7}, {-0.7}, {0.1}};
    const auto all = std::span<const SCurve>(ribs);
    const auto pair = rib_positions(all.first(2), std::vector<std::size_t>{0, 2}, Spacing::uniform(20));
    CHECK(pair.parameters == opposite_positions(ribs[0], ribs[1], Spacing::uniform(20)).parameters);
    const auto single = rib_positions(all.first(1), std::vector<std::size_t>{0, 1}, Spacing::uniform(20));
    CHECK(single.equal_spacing);
    CHECK(single.min_det == 1.0);
    const auto two_loops = rib_positions(all, std::vector<std::size_t>{0, 2, 3}, Spacing::uniform(20));
    CHECK(two_loops.folded_equal > 0);
    CHECK(two_loops.folded == 0);
    check_increasing(two_loops, 21);
}

TEST_CASE("bad ribs and options are refused") {
    const auto code = [](const auto& call) {
        try {
            static_cast<void>(call());
        } catch (const InputError& error) {
            return error.code();
        }
        return ErrorCode::overflow;
    };
    const SCurve good{0.5};
    const auto point = [](double) { return Vec3(1.0, 2.0, 3.0); };
    const auto nan = [](double t) { return Vec3(t, t > 0.5 ? std::nan("") : 0.0, 0.0); };
    const Spacing spacing = Spacing::uniform(5);
    CHECK(code([&] { return opposite_positions(good, point, spacing); }) == ErrorCode::empty_input);
    CHECK(code([&] { return opposite_positions(nan, good, spacing); }) == ErrorCode::not_finite);
    RibOptions options;
    options.min_spacing = 1.0;
    CHECK(code([&] { return opposite_positions(good, good, spacing, options); }) == ErrorCode::bad_option);
    options = {};
    options.samples = 10;
    CHECK(code([&] { return opposite_positions(good, good, spacing, options); }) == ErrorCode::bad_option);
    options = {};
    options.sufficient_det = -0.1;
    CHECK(code([&] { return opposite_positions(good, good, spacing, options); }) == ErrorCode::bad_option);
    const std::vector<SCurve> ribs{good, good};
    for (const std::vector<std::size_t>& offsets :
         std::vector<std::vector<std::size_t>>{{}, {0}, {0, 1}, {1, 2}, {0, 2, 1, 2}}) {
        CHECK(code([&] { return rib_positions(std::span<const SCurve>(ribs), offsets, spacing); }) ==
              ErrorCode::bad_index);
    }
    CHECK(code([&] { return Polyline({Vec3(0, 0, 0)}); }) == ErrorCode::empty_input);
}
