#include "support/catch.hpp"

#include <pavior/math/hexahedron.hpp>
#include <pavior/math/quadrilateral.hpp>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <limits>
#include <random>

using namespace pavior;

namespace {
const HexPoints cube{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0),
                     Vec3(0, 0, 1), Vec3(1, 0, 1), Vec3(1, 1, 1), Vec3(0, 1, 1)};
constexpr int faces[6][4] = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};

template <class Map>
HexPoints mapped(HexPoints x, Map&& map) {
    for (Vec3& p : x) {
        p = map(p);
    }
    return x;
}

HexPoints perturbed(double amplitude, std::mt19937& generator) {
    std::uniform_real_distribution<double> noise(-amplitude, amplitude);
    return mapped(cube,
                  [&](const Vec3& p) { return Vec3(p + Vec3(noise(generator), noise(generator), noise(generator))); });
}

// Trilinear interpolation, written out.
Vec3 at(const HexPoints& x, double u, double v, double w) {
    Vec3 sum = Vec3::Zero();
    for (std::size_t i = 0; i < 8; ++i) {
        sum += (cube[i].x() > 0 ? u : 1 - u) * (cube[i].y() > 0 ? v : 1 - v) * (cube[i].z() > 0 ? w : 1 - w) * x[i];
    }
    return sum;
}
}  // namespace

TEST_CASE("the cube") {
    CHECK(hex_volume(cube) == Approx(1.0).epsilon(1e-15));
    CHECK(hex_corner_dets(cube) == std::array<double, 8>{1, 1, 1, 1, 1, 1, 1, 1});
    CHECK(hex_centre_jacobian(cube) == Jacobian(Jacobian::Identity()));
    CHECK(hex_f_shape(cube) == 1.0);
    CHECK(hex_verdict_shape(cube) == 1.0);
    CHECK(hex_scaled_jacobian(cube) == 1.0);
    CHECK(hex_min_det(cube, 4) == 1.0);
    CHECK(hex_det_lower_bound(cube) == 1.0);
}

TEST_CASE("Jacobians are the derivatives of the trilinear map") {
    std::mt19937 generator(1);
    for (int trial = 0; trial < 20; ++trial) {
        const HexPoints x = perturbed(0.4, generator);
        std::uniform_real_distribution<double> unit(0.0, 1.0);
        const double u = unit(generator), v = unit(generator), w = unit(generator);
        Jacobian wanted;  // the map is linear in each variable: differences are exact
        wanted << at(x, 1, v, w) - at(x, 0, v, w), at(x, u, 1, w) - at(x, u, 0, w), at(x, u, v, 1) - at(x, u, v, 0);
        CHECK((hex_jacobian(x, u, v, w) - wanted).cwiseAbs().maxCoeff() < 1e-14);
        for (std::size_t c = 0; c < 8; ++c) {
            const Jacobian corner = hex_corner_jacobian(x, c);
            CHECK((corner - hex_jacobian(x, cube[c].x(), cube[c].y(), cube[c].z())).cwiseAbs().maxCoeff() < 1e-14);
            CHECK(hex_corner_dets(x)[c] == Approx(corner.determinant()).margin(1e-14));
        }
        CHECK((hex_centre_jacobian(x) - hex_jacobian(x, 0.5, 0.5, 0.5)).cwiseAbs().maxCoeff() == 0.0);
    }
}

TEST_CASE("the volume is the flux through the six bilinear quads, wherever the origin") {
    std::mt19937 generator(2);
    for (int trial = 0; trial < 100; ++trial) {
        const Vec3 shift = 3.0 * Vec3::Random();
        const HexPoints x = mapped(perturbed(0.8, generator), [&](const Vec3& p) { return Vec3(p + shift); });
        double flux = 0.0;
        for (const auto& f : faces) {
            flux += quad_flux({x[static_cast<std::size_t>(f[0])], x[static_cast<std::size_t>(f[1])],
                               x[static_cast<std::size_t>(f[2])], x[static_cast<std::size_t>(f[3])]});
        }
        CHECK(hex_volume(x) == Approx(flux).margin(1e-13));
    }
}

TEST_CASE("an affine image has the volume and the shape of its matrix") {
    Jacobian a;
    a << 2.0, 0.5, 0.1, 0.0, 1.5, -0.3, 0.2, 0.0, 1.0;
    const HexPoints x = mapped(cube, [&](const Vec3& p) { return Vec3(a * p + Vec3(1, 2, 3)); });
    CHECK(hex_volume(x) == Approx(a.determinant()).epsilon(1e-14));
    const double shape = 3.0 * std::pow(a.determinant(), 2.0 / 3.0) / a.squaredNorm();
    CHECK(hex_f_shape(x) == Approx(shape).epsilon(1e-14));
    CHECK(hex_verdict_shape(x) == Approx(shape).epsilon(1e-14));
    // Box 1 x 2 x 4: 3 * 8^(2/3) / 21
    const HexPoints box = mapped(cube, [](const Vec3& p) { return Vec3(p.x(), 2 * p.y(), 4 * p.z()); });
    CHECK(hex_f_shape(box) == Approx(12.0 / 21.0).epsilon(1e-14));
    CHECK(hex_scaled_jacobian(box) == 1.0);
}

TEST_CASE("metrics of one moved corner, by hand") {
    HexPoints x = cube;
    x[6] = Vec3(2, 2, 2);
    // Corners 0 1 3 4: unit frames. Corner 2: edges (-1,0,0), (0,-1,0), (1,1,2): det 2, |A|^2 = 8; 5 and 7 likewise.
    // Corner 6: edges (-1,-1,-2), (-1,-2,-1), (-2,-1,-1): det 4, |A|^2 = 18.
    CHECK(hex_corner_dets(x) == std::array<double, 8>{1, 1, 2, 1, 1, 2, 4, 2});
    const double sum = 4 * 3.0 + 3 * 8.0 / std::cbrt(4.0) + 18.0 / std::cbrt(16.0);
    CHECK(hex_f_shape(x) == Approx(24.0 / sum).epsilon(1e-14));
    CHECK(hex_verdict_shape(x) == Approx(std::cbrt(16.0) / 6.0).epsilon(1e-14));
    CHECK(hex_scaled_jacobian(x) == Approx(4.0 / std::pow(6.0, 1.5)).epsilon(1e-14));
}

TEST_CASE("rigid motions and scale leave the metrics alone, 1e-200 and 1e200 included") {
    std::mt19937 generator(3);
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();
    for (const double scale : {1.0, 1e-6, 1e6, 1e-200, 1e200}) {
        const HexPoints x = perturbed(0.2, generator);
        const HexMetrics m = hex_metrics(x);
        const HexMetrics n = hex_metrics(mapped(x, [&](const Vec3& p) { return Vec3(scale * (turn * p)); }));
        CHECK(n.f_shape == Approx(m.f_shape).epsilon(1e-12));
        CHECK(n.verdict_shape == Approx(m.verdict_shape).epsilon(1e-12));
        CHECK(n.scaled_jacobian == Approx(m.scaled_jacobian).epsilon(1e-12));
        CHECK(m.f_shape >= m.verdict_shape);
        CHECK(m.f_shape < 1.0);
    }
}

TEST_CASE("inverted, flat, collapsed and broken hexahedra") {
    const HexPoints mirrored = mapped(cube, [](const Vec3& p) { return Vec3(-p.x(), p.y(), p.z()); });
    CHECK(hex_volume(mirrored) == Approx(-1.0));
    CHECK(hex_f_shape(mirrored) == 0.0);
    CHECK(hex_verdict_shape(mirrored) == 0.0);
    CHECK(hex_scaled_jacobian(mirrored) == -1.0);

    HexPoints one = cube;  // one corner pushed through the opposite one: positive volume, negative corner
    one[6] = Vec3(0.3, 0.3, 0.3);
    CHECK(hex_volume(one) > 0.0);
    CHECK(hex_min_det(one, 1) < 0.0);
    CHECK(hex_f_shape(one) == 0.0);
    CHECK(hex_verdict_shape(one) == 0.0);
    CHECK(hex_scaled_jacobian(one) < 0.0);

    const HexPoints flat = mapped(cube, [](const Vec3& p) { return Vec3(p.x(), p.y(), 0.0); });
    CHECK(hex_metrics(flat).f_shape == 0.0);
    CHECK(hex_metrics(flat).scaled_jacobian == 0.0);

    HexPoints collapsed = cube;
    collapsed[1] = collapsed[0];
    CHECK(hex_metrics(collapsed).verdict_shape == 0.0);
    CHECK(hex_metrics(collapsed).scaled_jacobian == 0.0);

    for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
        HexPoints broken = cube;
        broken[6].y() = bad;
        CHECK(hex_metrics(broken).f_shape == 0.0);
        CHECK(hex_metrics(broken).verdict_shape == 0.0);
        CHECK(hex_metrics(broken).scaled_jacobian == 0.0);
        CHECK_FALSE(hex_min_det(broken, 1) > 0.0);
    }
}

TEST_CASE("positive corners do not make a valid hexahedron; samples and the Bernstein bound see it") {
    // The top turned by 130 degrees: every corner stays positive, the axis folds.
    const double angle = 130.0 * 3.14159265358979323846 / 180.0;
    const HexPoints x = mapped(cube, [&](const Vec3& p) {
        const Vec3 c = p - Vec3(0.5, 0.5, 0.0);
        const double t = p.z() * angle;
        return Vec3(c.x() * std::cos(t) - c.y() * std::sin(t), c.x() * std::sin(t) + c.y() * std::cos(t), c.z());
    });
    CHECK(hex_min_det(x, 1) == Approx(1.0));
    CHECK(hex_min_det(x, 2) == Approx(0.5 * (1.0 + std::cos(angle))));
    HexPoints one = cube;
    one[6] = Vec3(0.7, 0.7, 0.7);
    CHECK(hex_min_det(one, 1) == Approx(0.1));
    CHECK(hex_det_lower_bound(one) <= hex_min_det(one, 8));
}

TEST_CASE("the Bernstein bound is below every sample") {
    std::mt19937 generator(4);
    int tight = 0;
    for (int trial = 0; trial < 200; ++trial) {
        const HexPoints x = perturbed(0.25, generator);
        const double bound = hex_det_lower_bound(x);
        CHECK(bound <= hex_min_det(x, 10) + 1e-14);
        CHECK(hex_min_det(x, 10) <= hex_min_det(x, 5) + 1e-14);
        CHECK(hex_min_det(x, 5) <= hex_min_det(x, 1) + 1e-14);
        tight += bound > 0.0 ? 1 : 0;
    }
    CHECK(tight > 100);
}
