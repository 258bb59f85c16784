#include <pavior/brep/nearest_edge.hpp>

#include "support/catch.hpp"
#include "support/test_brep.hpp"

#include <numbers>

using namespace pavior;
using namespace pavior::test;

namespace {

/// A TestBrep whose edges 0 run as a wave of `waves` periods over x in [0, 1], and which counts evaluations.
struct Wave : TestBrep {
    double waves = 8;
    double height = 0.1;
    mutable int evaluations = 0;

    [[nodiscard]] Vec3 edge_point(EdgeId, double t) const {
        ++evaluations;
        return {t, height * std::sin(2 * std::numbers::pi * waves * t), 0};
    }
    [[nodiscard]] Vec3 edge_derivative(EdgeId, double t) const {
        ++evaluations;
        const double w = 2 * std::numbers::pi * waves;
        return {1, height * w * std::cos(w * t), 0};
    }
    [[nodiscard]] double edge_length(EdgeId e) const {
        double sum = 0;
        for (int i = 0; i < 4000; ++i) {
            sum += edge_derivative(e, (i + 0.5) / 4000).norm() / 4000;
        }
        return sum;
    }
};

}  // namespace

TEST_CASE("the closest point of a line, an arc and a full circle") {
    TestBrep b;
    const EdgeId line = b.line(b.vertex({0, 0, 0}), b.vertex({4, 0, 0}));
    const EdgeId arc = b.arc(b.vertex({1, 0, 1}), b.vertex({0, 1, 1}), {0, 0, 1}, {0, 0, 1});
    const Ring ring = add_circle(b, 2, 3);
    NearestEdge near(b);
    CHECK(near.closest(line, {1, 3, 0}).t == Approx(0.25).epsilon(1e-14));
    CHECK(near.closest(line, {1, 3, 0}).distance == Approx(3).epsilon(1e-14));
    CHECK(near.closest(line, {-3, 4, 0}).t == 0);
    CHECK(near.closest(line, {-3, 4, 0}).distance == Approx(5).epsilon(1e-14));
    CHECK(near.closest(arc, {-1, 2, 1}).t == Approx(b.edge_range(arc)[1]).epsilon(1e-14));
    for (double t = 0.01; t < 6.28; t += 0.01) {
        const EdgePoint found = near.closest(ring.e, b.edge_point(ring.e, t));
        CHECK(found.t == Approx(t).epsilon(1e-13));
        CHECK(found.distance < 1e-14);
        CHECK(near.at_least(ring.e, 1.5 * b.edge_point(ring.e, t)) <= std::hypot(1, 1.5));
    }
}

TEST_CASE("the nearest of several edges is that of a search through all, the first of equally near ones") {
    TestBrep b;
    add_cylinder(b, 1, 0.7, 2, 0.3);
    add_boss(b);
    std::vector<EdgeId> edges;
    for (std::size_t e = 0; e < b.edge_count(); ++e) {
        edges.push_back(EdgeId{static_cast<std::int32_t>(e)});
    }
    NearestEdge near(b);
    for (int i = 0; i < 300; ++i) {
        const Vec3 x(std::sin(i * 0.7) * 3, std::cos(i * 1.3) * 3, std::sin(i * 0.31) * 2 + 1);
        const EdgePoint found = near.nearest(edges, x);
        double least = found.distance;
        for (const EdgeId e : edges) {
            least = std::min(least, (b.edge_point(e, closest_on_edge(b, e, x)) - x).norm());
            CHECK(near.at_least(e, x) <= (b.edge_point(e, closest_on_edge(b, e, x)) - x).norm() + 1e-12);
        }
        CHECK(found.distance <= least + 1e-12);
        CHECK((b.edge_point(found.edge, found.t) - x).norm() == found.distance);
    }
    CHECK_FALSE(near.nearest({}, Vec3::Zero()).edge.valid());
    TestBrep twins;
    const VertexId v = twins.vertex({0, 0, 0}), w = twins.vertex({1, 0, 0});
    const std::array both{twins.line(v, w), twins.line(v, w)};
    CHECK(NearestEdge(twins).nearest(both, {0.3, 0, 0}).edge == both[0]);
}

TEST_CASE("samples follow an edge whose first samples lie on its axis") {
    Wave b;
    const EdgeId e = b.line(b.vertex({0, 0, 0}), b.vertex({1, 0, 0}));
    NearestEdge near(b);
    for (const double t : {0.03, 0.2, 0.47, 0.96}) {
        CHECK(near.closest(e, b.edge_point(e, t)).t == Approx(t).epsilon(1e-12));
    }
    b.evaluations = 0;
    (void)near.closest(e, b.edge_point(e, 0.3));
    CHECK(b.evaluations < 15);
}
