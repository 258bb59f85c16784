#include "support/catch.hpp"
#include "support/test_brep.hpp"

#include <pavior/brep/edge_mesh.hpp>

#include <cmath>

using namespace pavior;

namespace {

/// An edge whose speed varies by a factor of 5: point(t) = (t + 2 t^2, 0, 0) on [0, 1].
struct Accelerating {
    [[nodiscard]] std::array<double, 2> edge_range(EdgeId) const { return {0.0, 1.0}; }
    [[nodiscard]] Vec3 edge_derivative(EdgeId, double t) const { return {1 + 4 * t, 0, 0}; }
    [[nodiscard]] Vec3 edge_point(EdgeId, double t) const { return {t + 2 * t * t, 0, 0}; }
    // The rest of the concept, not used here.
    [[nodiscard]] std::size_t vertex_count() const { return 0; }
    [[nodiscard]] std::size_t edge_count() const { return 1; }
    [[nodiscard]] std::size_t face_count() const { return 0; }
    [[nodiscard]] std::size_t solid_count() const { return 0; }
    [[nodiscard]] std::span<const OrientedFace> solid_faces(SolidId) const { return {}; }
    [[nodiscard]] std::span<const EdgeLoop> face_loops(FaceId) const { return {}; }
    [[nodiscard]] std::array<VertexId, 2> edge_vertices(EdgeId) const { return {}; }
    [[nodiscard]] Vec3 vertex_point(VertexId) const { return Vec3::Zero(); }
    [[nodiscard]] double edge_length(EdgeId) const { return 3; }
    [[nodiscard]] Vec3 face_point(FaceId, const Vec2&) const { return Vec3::Zero(); }
    [[nodiscard]] std::pair<Vec3, Vec3> face_derivatives(FaceId, const Vec2&) const { return {}; }
    [[nodiscard]] Vec2 closest_on_face(FaceId, const Vec3&) const { return Vec2::Zero(); }
    [[nodiscard]] Vec2 edge_on_face(EdgeId, double, FaceId, bool) const { return Vec2::Zero(); }
    [[nodiscard]] std::array<double, 2> face_period(FaceId) const { return {0, 0}; }
    [[nodiscard]] int tag(int, std::size_t) const { return 0; }
};

}  // namespace

TEST_CASE("edges of constant speed are cut at exactly equal parameters") {
    test::TestBrep b;
    const EdgeId circle = test::add_circle(b, 2.0, 0.0).e;
    const std::vector<double> t = edge_parameters(b, circle, equal_fractions(8));
    REQUIRE(t.size() == 9);
    for (int i = 0; i <= 8; ++i) {
        CHECK(t[static_cast<std::size_t>(i)] == Approx(2 * std::numbers::pi * i / 8).epsilon(1e-15));
    }
}

TEST_CASE("edges of varying speed are cut at equal arc length, their ends exactly") {
    const Accelerating b;
    const std::vector<double> t = edge_parameters(b, EdgeId{0}, equal_fractions(6));
    CHECK(t.front() == 0.0);
    CHECK(t.back() == 1.0);
    for (std::size_t i = 0; i <= 6; ++i) {
        CHECK(b.edge_point(EdgeId{0}, t[i])[0] == Approx(3.0 * static_cast<double>(i) / 6).margin(3e-4));
    }
    const std::vector<double> given = edge_parameters(b, EdgeId{0}, std::vector<double>{0, 0.1, 1});
    CHECK(b.edge_point(EdgeId{0}, given[1])[0] == Approx(0.3).margin(3e-4));
}

TEST_CASE("the closest parameter of an edge") {
    test::TestBrep b;
    const EdgeId circle = test::add_circle(b, 2.0, 0.0).e;
    for (const double t : {0.1, 1.7, 3.2, 6.2}) {
        const Vec3 x = b.edge_point(circle, t);
        CHECK(closest_on_edge(b, circle, x) == Approx(t).epsilon(1e-14));
        CHECK(closest_on_edge(b, circle, 0.9 * x) == Approx(t).epsilon(1e-12));
    }
    const EdgeId line = b.line(b.vertex({0, 0, 0}), b.vertex({4, 0, 0}));
    CHECK(closest_on_edge(b, line, Vec3(3, 2, 0)) == Approx(0.75).epsilon(1e-14));
    CHECK(closest_on_edge(b, line, Vec3(5, 2, 0)) == 1.0);  // the ends are the last points
    CHECK(closest_on_edge(b, line, Vec3(-1, 2, 0)) == 0.0);
    CHECK(closest_on_edge(Accelerating{}, EdgeId{0}, Vec3(0.6, 0, 0)) == Approx((std::sqrt(5.8) - 1) / 4));
}
