// Sweeps on surfaces and curves that have nothing but what the concepts ask for.
#include "support/archetypes.hpp"
#include "support/catch.hpp"
#include "support/shapes.hpp"
#include "sweep/surfaces.hpp"

#include <pavior/mesh/boundary_loops.hpp>
#include <pavior/sweep/linking_side.hpp>
#include <pavior/sweep/ribs.hpp>
#include <pavior/sweep/target_projection.hpp>

#include <array>
#include <span>
#include <vector>

using namespace pavior;

namespace {

static_assert(parametric_surface<archetype::Surface<surfaces::SkewPlane>>);
static_assert(rib_curve<archetype::Curve>);

/// A side of a torus whose grid in the parameter plane folds: the nodes of the sides bunch up at different ends.
struct Sides {
    explicit Sides(const surfaces::Swirl& surface) {
        constexpr int n = 12;
        const auto add = [&](std::vector<Vec2>& plane, std::vector<Vec3>& space, double s, double t) {
            plane.push_back(surface.closest(Vec3(2.0 * s - 0.6, 1.6 * t - 0.5, 0.0)));
            space.push_back(surface.point(plane.back()));
        };
        for (int i = 0; i <= n; ++i) {
            const double s = static_cast<double>(i) / n;
            add(bottom_uv, bottom, s, 0.0);
            add(top_uv, top, s, 1.0);
            add(left_uv, left, 0.0, s);
            add(right_uv, right, 1.0, s);
        }
    }
    [[nodiscard]] GridSides<Vec2> uv() const { return {bottom_uv, top_uv, left_uv, right_uv}; }
    [[nodiscard]] GridSides<Vec3> space() const { return {bottom, top, left, right}; }

    std::vector<Vec2> bottom_uv, top_uv, left_uv, right_uv;
    std::vector<Vec3> bottom, top, left, right;
};

}  // namespace

TEST_CASE("linking sides on an archetype of a surface, folds repaired") {
    const surfaces::Swirl surface{0.9};
    const Sides sides(surface);
    const LinkingSideMesh expected = linking_side(surface, sides.space(), sides.uv());
    const LinkingSideMesh side = linking_side(archetype::Surface(surface), sides.space(), sides.uv());
    CHECK(side.folded_parameter.size() > 3);
    CHECK(side.smooth.iterations > 0);
    CHECK(side.nodes.nodes == expected.nodes.nodes);
}

TEST_CASE("a target on an archetype of a surface, folds repaired") {
    const QuadMesh mesh = shapes::grid_cap(6, 6);
    const Loops loops = boundary_loops(mesh);
    std::vector<Vec2> uv;
    for (const Vec3& x : mesh.nodes) {
        uv.emplace_back(x.x(), x.y());
    }
    const SourceCap source{mesh.nodes, uv, mesh.quads, loops};
    const surfaces::SkewPlane surface;
    std::vector<Vec2> loop_uv;
    std::vector<Vec3> loop_nodes;
    for (const Index i : loops.nodes) {
        loop_uv.emplace_back(uv[i].x(), uv[i].y() - 0.9 * (1 - uv[i].x() * uv[i].x()));  // a crescent
        loop_nodes.push_back(surface.point(loop_uv.back()));
    }
    const TargetMesh expected = project_target(surface, source, loop_uv, loop_nodes);
    const TargetMesh target = project_target(archetype::Surface(surface), source, loop_uv, loop_nodes);
    CHECK_FALSE(target.folded_by_map.empty());
    CHECK(target.nodes == expected.nodes);
}

TEST_CASE("archetypes of curves as ribs") {
    const auto low = [](double t) { return Vec3(t * t, 0.5 * t, 0); };
    const auto high = [](double t) { return Vec3(t, 0.2 * t * t, 1 + t); };
    const std::array<archetype::Curve, 2> ribs{archetype::Curve(low), archetype::Curve(high)};
    const Spacing spacing = Spacing::uniform(5);
    CHECK(opposite_positions(ribs[0], ribs[1], spacing).parameters ==
          opposite_positions(low, high, spacing).parameters);
    const std::array<std::size_t, 2> offsets{0, 2};
    CHECK(rib_positions(std::span<const archetype::Curve>(ribs), offsets, spacing).parameters.size() == 2);
}
