#include "support/catch.hpp"
#include "support/foreign_meshes.hpp"
#include "support/shapes.hpp"

#include <pavior/mesh/quality.hpp>

#include <algorithm>
#include <numbers>
#include <numeric>
#include <random>

#if __has_include(<vtkMeshQuality.h>)
#define PAVIOR_TEST_VTK
#include <vtkHexahedron.h>
#include <vtkMeshQuality.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkQuad.h>
#endif

using namespace pavior;

namespace {
HexMesh shaken_box(std::size_t n, double amplitude, unsigned seed) {
    HexMesh mesh = shapes::hex_box(n, n, n);
    std::mt19937 generator(seed);
    for (Vec3& x : mesh.nodes) {
        for (int axis = 0; axis < 3; ++axis) {
            const double noise = 2.0 * static_cast<double>(generator()) / 4294967295.0 - 1.0;
            x[axis] += amplitude / static_cast<double>(n) * noise;
        }
    }
    return mesh;
}
}  // namespace

TEST_CASE("a box of cubes is perfect, a box of 1 x 2 x 4 bricks is not") {
    const HexQuality cubes = hex_quality(shapes::hex_box(4, 4, 4));
    CHECK(cubes.f_shape.count == 64);
    CHECK(cubes.f_shape.min == Approx(1.0).epsilon(1e-14));
    CHECK(cubes.f_shape.stddev < 1e-14);
    CHECK(cubes.inverted == 0);
    const HexQuality bricks = hex_quality(shapes::hex_box(2, 2, 2, Vec3(1, 2, 4)));
    CHECK(bricks.f_shape.mean == Approx(12.0 / 21.0));
    CHECK(bricks.verdict_shape.mean == Approx(12.0 / 21.0));
    CHECK(bricks.scaled_jacobian.mean == Approx(1.0));
    CHECK(bricks.f_shape.histogram == std::vector<std::size_t>{0, 0, 0, 0, 0, 8, 0, 0, 0, 0});
}

TEST_CASE("statistics are those of the values") {
    const HexMesh mesh = shaken_box(21, 0.6, 5);
    std::vector<HexMetrics> values(mesh.hexes.size());
    hex_metrics(mesh, std::span(values));
    const HexQuality quality = hex_quality(mesh, {.bins = 7});
    const auto check = [&](const Statistics& s, double HexMetrics::*metric) {
        double sum = 0.0, squares = 0.0;
        std::vector<std::size_t> histogram(7, 0);
        std::size_t worst = 0;
        for (std::size_t h = 0; h < values.size(); ++h) {
            const double v = values[h].*metric;
            sum += v;
            worst = v < values[worst].*metric ? h : worst;
            ++histogram[std::min<std::size_t>(6, static_cast<std::size_t>(7.0 * (v - s.low) / (s.high - s.low)))];
        }
        const double mean = sum / static_cast<double>(values.size());
        for (const HexMetrics& v : values) {
            squares += (v.*metric - mean) * (v.*metric - mean);
        }
        CHECK(s.count == 9261);
        CHECK(s.mean == Approx(mean).epsilon(1e-12));
        CHECK(s.stddev == Approx(std::sqrt(squares / 9261.0)).epsilon(1e-10));
        CHECK(s.worst == worst);
        CHECK(s.min == values[worst].*metric);
        CHECK(s.histogram == histogram);
        CHECK(std::accumulate(s.histogram.begin(), s.histogram.end(), std::size_t{0}) == 9261);
    };
    check(quality.f_shape, &HexMetrics::f_shape);
    check(quality.verdict_shape, &HexMetrics::verdict_shape);
    check(quality.scaled_jacobian, &HexMetrics::scaled_jacobian);
    CHECK(quality.inverted > 0);
    CHECK(quality.inverted == static_cast<std::size_t>(std::count_if(
                                  values.begin(), values.end(), [](const auto& v) { return v.scaled_jacobian <= 0; })));
}

TEST_CASE("the same bytes for any number of threads") {
    const HexMesh mesh = shaken_box(30, 0.3, 6);
    const HexQuality one = hex_quality(mesh);
    CHECK(hex_quality(mesh, {.execution = {2}}) == one);
    CHECK(hex_quality(mesh, {.execution = {5}}) == one);
    const QuadMesh cap = shapes::random_cap(100, 100, 0.4, 7);
    CHECK(quad_quality(cap, {.execution = {3}}) == quad_quality(cap));
}

TEST_CASE("quads: a grid, a folded one, and a foreign mesh") {
    CHECK(quad_quality(shapes::grid_cap(5, 5)).shape.min == Approx(1.0));
    CHECK(quad_quality(shapes::grid_cap(6, 3)).shape.mean == Approx(0.8));  // 1/3 by 2/3
    QuadMesh folded = shapes::grid_cap(2, 2);
    folded.nodes[4] = Vec3(-1.5, -1.5, 0);
    const QuadQuality quality = quad_quality(folded);
    CHECK(quality.inverted == 3);
    CHECK(quality.shape.min == 0.0);
    CHECK(quad_quality(archetype::Quads(shapes::grid_cap(5, 5))).shape.min == Approx(1.0).epsilon(1e-6));
    std::vector<QuadMetrics> values(4);
    quad_metrics(folded, std::span(values));
    CHECK(values[0].scaled_jacobian == quad_metrics(folded, 0).scaled_jacobian);
    CHECK(hex_quality(archetype::Hexes(shapes::hex_box(2, 2, 2))).f_shape.min == Approx(1.0).epsilon(1e-6));
}

TEST_CASE("empty meshes and wrong arguments") {
    const HexQuality none = hex_quality(HexMesh{});
    CHECK(none.f_shape.count == 0);
    CHECK(none.f_shape.mean == 0.0);
    CHECK(none.f_shape.histogram == std::vector<std::size_t>(10, 0));
    CHECK_THROWS_AS(hex_quality(HexMesh{}, {.bins = 0}), InputError);
    std::vector<HexMetrics> values(3);
    CHECK_THROWS_AS(hex_metrics(shapes::hex_box(1, 1, 1), std::span(values)), InputError);
}

#ifdef PAVIOR_TEST_VTK

namespace {
template <class Cell, std::size_t N>
void place(Cell& cell, const std::array<Vec3, N>& x) {
    for (std::size_t i = 0; i < N; ++i) {
        cell->GetPoints()->SetPoint(static_cast<vtkIdType>(i), x[i].x(), x[i].y(), x[i].z());
    }
}

// The metrics of VTK agree to 1e-12; where an edge or the axis has collapsed it says 1e30 and we say 0.
void compare(const HexPoints& x) {
    vtkNew<vtkHexahedron> cell;
    place(cell, x);
    const HexMetrics ours = hex_metrics(x);
    const double jacobian = vtkMeshQuality::HexScaledJacobian(cell);
    CHECK(std::abs(ours.verdict_shape - vtkMeshQuality::HexShape(cell)) <= 1e-12);
    CHECK(std::abs(ours.scaled_jacobian - (jacobian > 1e29 ? 0.0 : jacobian)) <= 1e-12);
}

HexPoints noisy_cube(double amplitude, std::mt19937& generator) {
    const HexMesh cube = shapes::hex_box(1, 1, 1);
    HexPoints x;
    for (std::size_t i = 0; i < 8; ++i) {
        x[i] = cube.nodes[cube.hexes[0][i]];
        for (int axis = 0; axis < 3; ++axis) {
            x[i][axis] += amplitude * (2.0 * static_cast<double>(generator()) / 4294967295.0 - 1.0);
        }
    }
    return x;
}
}  // namespace

TEST_CASE("hexahedra measured by VTK: random, inverted, twisted, flat and collapsed") {
    std::mt19937 generator(8);
    for (const double amplitude : {0.0, 0.1, 0.3, 0.6, 2.0}) {
        for (int trial = 0; trial < 400; ++trial) {
            HexPoints x = noisy_cube(amplitude, generator);
            compare(x);
            for (Vec3& p : x) {
                p.x() = -p.x();
            }
            compare(x);
        }
    }
    for (int degrees = 0; degrees <= 175; degrees += 5) {  // from 90 degrees on the centre is worse than any corner
        HexPoints x = noisy_cube(0.0, generator);
        const double angle = degrees * std::numbers::pi / 180.0;
        for (std::size_t i = 4; i < 8; ++i) {
            const Vec3 c = x[i] - Vec3(0.5, 0.5, 0.0);
            x[i] = Vec3(0.5 + c.x() * std::cos(angle) - c.y() * std::sin(angle),
                        0.5 + c.x() * std::sin(angle) + c.y() * std::cos(angle), c.z());
        }
        compare(x);
    }
    HexPoints flat = noisy_cube(0.3, generator);
    HexPoints collapsed = flat;
    for (Vec3& p : flat) {
        p.z() = 0.0;
    }
    compare(flat);
    collapsed[2] = collapsed[1];
    compare(collapsed);
    collapsed = noisy_cube(0.0, generator);
    for (std::size_t i = 4; i < 8; ++i) {  // the upper end turned about: the axis collapses, the edges do not
        collapsed[i].z() = i < 6 ? 1.0 : -1.0;
    }
    compare(collapsed);
}

TEST_CASE("quads measured by VTK, plane and warped") {
    std::mt19937 generator(9);
    for (const double amplitude : {0.0, 0.2, 0.6, 2.0}) {
        for (int trial = 0; trial < 400; ++trial) {
            const HexPoints box = noisy_cube(amplitude, generator);
            QuadPoints x{box[0], box[1], box[2], box[3]};
            if (trial % 2 == 0) {
                for (Vec3& p : x) {
                    p.z() = 0.0;
                }
            }
            vtkNew<vtkQuad> cell;
            place(cell, x);
            CHECK(std::abs(quad_shape(x) - vtkMeshQuality::QuadShape(cell)) <= 1e-12);
            CHECK(std::abs(quad_scaled_jacobian(x) - vtkMeshQuality::QuadScaledJacobian(cell)) <= 1e-12);
        }
    }
}
#endif
