#include "support/catch.hpp"
#include "support/grid_cap.hpp"
#include "support/test_brep.hpp"

#include <pavior/mesh/verify_hexes.hpp>
#include <pavior/one_to_one/recognition.hpp>
#include <pavior/one_to_one/rib_parameters.hpp>
#include <pavior/one_to_one/sweep_model.hpp>

using namespace pavior;

namespace {

/// A square section swept along half rings of mean radius 1 that bend the other way at the middle: an S of 180 + 180
/// degrees, whose ribs change from the inside to the outside of the bend. One edge a rib.
struct SShape : test::TestBrep {
    // Ribs are arcs joined at the inflection; the brep sees each pair as one edge of parameter [0, 2].
    std::vector<double> offset;  ///< across the path, per rib edge
    std::vector<double> height;
    std::vector<EdgeId> ribs;
    std::vector<FaceId> walls;

    [[nodiscard]] Vec3 rib_point(std::size_t r, double t) const {
        constexpr double pi = std::numbers::pi;
        const double inner = 1 - offset[r];
        const double outer = 1 + offset[r];
        return t <= 1 ? Vec3(-inner * std::cos(pi * t), inner * std::sin(pi * t), height[r])
                      : Vec3(2 - outer * std::cos(pi * (t - 1)), -outer * std::sin(pi * (t - 1)), height[r]);
    }
    [[nodiscard]] std::size_t rib_of(EdgeId e) const {
        return static_cast<std::size_t>(std::find(ribs.begin(), ribs.end(), e) - ribs.begin());
    }
    [[nodiscard]] std::array<double, 2> edge_range(EdgeId e) const {
        return rib_of(e) < ribs.size() ? std::array{0.0, 2.0} : TestBrep::edge_range(e);
    }
    [[nodiscard]] Vec3 edge_point(EdgeId e, double t) const {
        return rib_of(e) < ribs.size() ? rib_point(rib_of(e), t) : TestBrep::edge_point(e, t);
    }
    [[nodiscard]] Vec3 edge_derivative(EdgeId e, double t) const {
        if (rib_of(e) == ribs.size()) {
            return TestBrep::edge_derivative(e, t);
        }
        const double a = std::max(0.0, t - 1e-6);
        const double b = std::min(2.0, t + 1e-6);
        return (edge_point(e, b) - edge_point(e, a)) / (b - a);
    }
    [[nodiscard]] double edge_length(EdgeId e) const {
        return rib_of(e) < ribs.size() ? 2 * std::numbers::pi : TestBrep::edge_length(e);
    }
    /// Wall w between ribs w and w + 1: u along the section, v along the ribs.
    [[nodiscard]] std::size_t wall_of(FaceId f) const {
        return static_cast<std::size_t>(std::find(walls.begin(), walls.end(), f) - walls.begin());
    }
    [[nodiscard]] Vec3 face_point(FaceId f, const Vec2& uv) const {
        const std::size_t w = wall_of(f);
        return w == walls.size() ? TestBrep::face_point(f, uv)
                                 : Vec3((1 - uv[0]) * rib_point(w, uv[1]) + uv[0] * rib_point((w + 1) % 4, uv[1]));
    }
    [[nodiscard]] std::pair<Vec3, Vec3> face_derivatives(FaceId f, const Vec2& uv) const {
        if (wall_of(f) == walls.size()) {
            return TestBrep::face_derivatives(f, uv);
        }
        const double h = 1e-6;
        const Vec2 v0(uv[0], std::max(0.0, uv[1] - h));
        const Vec2 v1(uv[0], std::min(2.0, uv[1] + h));
        return {face_point(f, {uv[0] + 1, uv[1]}) - face_point(f, uv),
                (face_point(f, v1) - face_point(f, v0)) / (v1[1] - v0[1])};
    }
    [[nodiscard]] Vec2 edge_on_face(EdgeId e, double t, FaceId f, bool forward) const {
        const std::size_t w = wall_of(f);
        if (w == walls.size()) {
            return TestBrep::edge_on_face(e, t, f, forward);
        }
        if (const std::size_t r = rib_of(e); r < ribs.size()) {
            return {r == w ? 0.0 : 1.0, t};
        }
        const Vec3 x = edge_point(e, t);
        const double v =
            std::abs((x - rib_point(w, 0)).norm() + (x - rib_point((w + 1) % 4, 0)).norm() - 1) < 1e-9 ? 0 : 2;
        return {(x - rib_point(w, v)).norm(), v};
    }
    [[nodiscard]] Vec2 closest_on_face(FaceId f, const Vec3& x) const { return TestBrep::closest_on_face(f, x); }
};

SShape s_shape() {
    SShape b;
    b.offset = {-0.5, 0.5, 0.5, -0.5};
    b.height = {0, 0, 1, 1};
    std::vector<VertexId> low;
    std::vector<VertexId> high;
    for (std::size_t r = 0; r < 4; ++r) {
        low.push_back(b.vertex(b.rib_point(r, 0)));
        high.push_back(b.vertex(b.rib_point(r, 2)));
    }
    for (std::size_t r = 0; r < 4; ++r) {
        b.ribs.push_back(b.line(low[r], high[r]));
    }
    const FaceId source = b.flat_polygon(low);
    const FaceId target = b.flat_polygon(high);
    std::vector<OrientedFace> faces{{source, true}, {target, false}};
    for (std::size_t w = 0; w < 4; ++w) {
        const OrientedEdge bottom = b.joint(low[w], low[(w + 1) % 4]);
        const OrientedEdge top = b.joint(high[w], high[(w + 1) % 4]);
        const OrientedEdge left{b.ribs[w], true};
        const OrientedEdge right{b.ribs[(w + 1) % 4], true};
        b.walls.push_back(b.flat({{bottom, right, {top.edge, !top.forward}, {left.edge, false}}}, {0, 0, 1}));
        faces.push_back({b.walls.back(), false});
    }
    b.solid(faces);
    return b;
}

}  // namespace

TEST_CASE("straight ribs are left alone") {
    test::TestBrep b;
    const SolidId solid = test::add_prism(b, test::rectangle(1, 2), 0, 3);
    const std::vector<SweepTopology> sweeps{
        sweep_between(b, solid, b.solid_faces(solid)[0].face, b.solid_faces(solid)[1].face)};
    for (const auto& parameters : rib_parameters(b, sweeps, std::vector<int>(b.edge_count(), 5))) {
        CHECK(parameters.empty());
    }
}

TEST_CASE("ribs of an S of 180 + 180 degrees follow each other where equal spacing folds") {
    const SShape b = s_shape();
    const std::vector<SweepTopology> sweeps{sweep_between(b, SolidId{0}, FaceId{0}, FaceId{1})};
    std::vector<int> intervals(b.edge_count(), 6);
    for (const EdgeId rib : b.ribs) {
        intervals[rib.index()] = 40;
    }
    const auto parameters = rib_parameters(b, sweeps, intervals);
    for (const EdgeId rib : b.ribs) {
        const std::vector<double>& t = parameters[rib.index()];
        REQUIRE(t.size() == 41);
        CHECK(t.front() == 0.0);
        CHECK(t.back() == 2.0);
        CHECK(std::is_sorted(t.begin(), t.end()));
    }
    ModelSweepOptions options;
    options.solid.smooth = false;
    options.follow_ribs = false;
    const ModelMesh equal = sweep_model(b, sweeps, intervals, test::GridCap<SShape>{&b}, options);
    CHECK(verify_hexes(equal.mesh).count(MeshFault::inverted) > 0);
    options.follow_ribs = true;
    const ModelMesh following = sweep_model(b, sweeps, intervals, test::GridCap<SShape>{&b}, options);
    const HexReport report = verify_hexes(following.mesh);
    INFO(report.text());
    CHECK(report.ok());
}
