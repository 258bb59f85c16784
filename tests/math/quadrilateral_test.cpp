#include "support/catch.hpp"

#include <pavior/math/quadrilateral.hpp>

#include <limits>
#include <random>

using namespace pavior;

namespace {
const QuadPoints square{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0)};
const QuadPoints2 square2{Vec2(0, 0), Vec2(1, 0), Vec2(1, 1), Vec2(0, 1)};

QuadPoints random_quad(double amplitude, std::mt19937& generator) {
    std::uniform_real_distribution<double> noise(-amplitude, amplitude);
    QuadPoints x = square;
    for (Vec3& p : x) {
        p += Vec3(noise(generator), noise(generator), noise(generator));
    }
    return x;
}

// Flux of x/3 by 4 x 4 Gauss points: exact for this integrand.
double gauss_flux(const QuadPoints& x) {
    constexpr double points[4] = {0.0694318442029737, 0.3300094782075719, 0.6699905217924281, 0.9305681557970263};
    constexpr double weights[4] = {0.1739274225687269, 0.3260725774312731, 0.3260725774312731, 0.1739274225687269};
    double sum = 0.0;
    for (int i = 0; i < 4; ++i) {
        for (int j = 0; j < 4; ++j) {
            const double u = points[i], v = points[j];
            const Vec3 p = (1 - u) * (1 - v) * x[0] + u * (1 - v) * x[1] + u * v * x[2] + (1 - u) * v * x[3];
            const Vec3 du = (1 - v) * (x[1] - x[0]) + v * (x[2] - x[3]);
            const Vec3 dv = (1 - u) * (x[3] - x[0]) + u * (x[2] - x[1]);
            sum += weights[i] * weights[j] * p.dot(du.cross(dv)) / 3.0;
        }
    }
    return sum;
}
}  // namespace

TEST_CASE("the square, in space and in the plane") {
    CHECK(quad_vector_area(square) == Vec3(0, 0, 1));
    CHECK(quad_normal(square) == Vec3(0, 0, 1));
    CHECK(quad_corner_areas(square) == std::array<double, 4>{1, 1, 1, 1});
    CHECK(quad_corner_areas(square2) == std::array<double, 4>{1, 1, 1, 1});
    CHECK(quad_shape(square) == 1.0);
    CHECK(quad_shape(square2) == 1.0);
    CHECK(quad_scaled_jacobian(square) == 1.0);
    CHECK(quad_scaled_jacobian(square2) == 1.0);
    CHECK_FALSE(quad_inverted(square));
    CHECK_FALSE(quad_inverted(square2));
    CHECK(quad_inverted(square, Vec3(0, 0, -1)));
}

TEST_CASE("rectangle and rhombus") {
    const QuadPoints2 rectangle{Vec2(0, 0), Vec2(3, 0), Vec2(3, 1), Vec2(0, 1)};
    CHECK(quad_shape(rectangle) == Approx(0.6).epsilon(1e-15));  // 2 * 3 / (9 + 1)
    CHECK(quad_scaled_jacobian(rectangle) == 1.0);
    const double h = std::sqrt(3.0) / 2.0;
    const QuadPoints rhombus{Vec3(0, 0, 0), Vec3(0, 1, 0), Vec3(0, 1.5, h), Vec3(0, 0.5, h)};
    CHECK(quad_normal(rhombus) == Vec3(1, 0, 0));
    CHECK(quad_shape(rhombus) == Approx(h).epsilon(1e-15));
    CHECK(quad_scaled_jacobian(rhombus) == Approx(h).epsilon(1e-15));
}

TEST_CASE("the flux is exact for warped quads") {
    std::mt19937 generator(5);
    for (int trial = 0; trial < 100; ++trial) {
        const QuadPoints x = random_quad(1.0, generator);
        CHECK(quad_flux(x) == Approx(gauss_flux(x)).margin(1e-14));
        CHECK(quad_flux({x[3], x[2], x[1], x[0]}) == Approx(-quad_flux(x)).margin(1e-14));
        CHECK(quad_flux({x[2], x[3], x[0], x[1]}) == Approx(quad_flux(x)).margin(1e-14));
    }
    const QuadPoints raised{Vec3(0, 0, 3), Vec3(1, 0, 3), Vec3(1, 1, 3), Vec3(0, 1, 3)};
    CHECK(quad_flux(raised) == Approx(1.0));
}

TEST_CASE("corner areas sum up to four times half the vector area") {
    std::mt19937 generator(6);
    for (int trial = 0; trial < 50; ++trial) {
        const QuadPoints x = random_quad(0.5, generator);
        const auto normals = quad_corner_normals(x);
        const Vec3 sum = normals[0] + normals[1] + normals[2] + normals[3];
        CHECK((sum - 4.0 * quad_vector_area(x)).norm() < 1e-14);
    }
}

TEST_CASE("arrow heads, crossed, clockwise and collapsed quads") {
    const QuadPoints2 arrow{Vec2(0, 0), Vec2(1, 0), Vec2(0.2, 0.2), Vec2(0, 1)};
    CHECK(quad_inverted(arrow));
    CHECK(quad_shape(arrow) == 0.0);
    CHECK(quad_scaled_jacobian(arrow) < 0.0);
    const QuadPoints2 crossed{Vec2(0, 0), Vec2(1, 1), Vec2(1, 0), Vec2(0, 1)};
    CHECK(quad_inverted(crossed));
    const QuadPoints2 clockwise{Vec2(0, 0), Vec2(0, 1), Vec2(1, 1), Vec2(1, 0)};
    CHECK(quad_scaled_jacobian(clockwise) == -1.0);
    CHECK(quad_inverted(clockwise));
    CHECK_FALSE(quad_inverted(QuadPoints{square[0], square[3], square[2], square[1]}));  // its own normal turns too
    const QuadPoints triangle{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)};
    CHECK(quad_scaled_jacobian(triangle) == 0.0);
    CHECK(quad_shape(triangle) == 0.0);
    CHECK(quad_inverted(triangle));
    const QuadPoints point{Vec3::Ones(), Vec3::Ones(), Vec3::Ones(), Vec3::Ones()};
    CHECK(quad_normal(point) == Vec3(0, 0, 0));
    CHECK(quad_shape(point) == 0.0);
    for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
        QuadPoints broken = square;
        broken[2].x() = bad;
        CHECK(quad_shape(broken) == 0.0);
        CHECK(quad_scaled_jacobian(broken) == 0.0);
        CHECK(quad_inverted(broken));
    }
}

TEST_CASE("metrics do not depend on the scale") {
    std::mt19937 generator(7);
    const QuadPoints x = random_quad(0.2, generator);
    for (const double scale : {1e-6, 1e6, 1e-200, 1e200}) {
        QuadPoints y = x;
        for (Vec3& p : y) {
            p *= scale;
        }
        CHECK(quad_shape(y) == Approx(quad_shape(x)).epsilon(1e-12));
        CHECK(quad_scaled_jacobian(y) == Approx(quad_scaled_jacobian(x)).epsilon(1e-12));
    }
}
