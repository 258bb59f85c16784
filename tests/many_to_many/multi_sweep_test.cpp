#include "support/catch.hpp"
#include "support/extruded_cases.hpp"

#include <pavior/cad/region_quads.hpp>
#include <pavior/many_to_many/multi_sweep.hpp>
#include <pavior/mesh/quality.hpp>
#include <pavior/mesh/verify_hexes.hpp>

#include <cstring>

using namespace pavior;
using namespace pavior::test;

namespace {

MultiSweepMesh swept(const PolygonBody& body, double size, double merge = 0) {
    MultiSweepOptions options;
    options.size = size;
    options.merge = merge;
    MultiSweepMesh mesh = multi_sweep(body.body(), body, options, imprint, solved, GmshRegionMesher{});
    std::vector<QuadCorners> outer;  // without those between two solids
    for (std::size_t q = 0; q < mesh.quads.size(); ++q) {
        const Index cap = mesh.quad_surface[q];
        if (cap == no_index || body.body().caps[cap].below == no_index || body.body().caps[cap].above == no_index) {
            outer.push_back(mesh.quads[q]);
        }
    }
    const HexReport report = verify_hexes(mesh.mesh, std::span<const QuadCorners>(outer));
    INFO(report.text());
    CHECK(report.ok());
    return mesh;
}

double volume(const MultiSweepMesh& mesh) { return verify_hexes(mesh.mesh).volume; }

}  // namespace

TEST_CASE("steps become boxes") {
    const MultiSweepMesh mesh = swept(PolygonBody(steps()), 0.5);
    CHECK(mesh.mesh.hexes.size() == 4 * 4 * 2 + 4 * 4 * 4);
    CHECK(volume(mesh) == Approx(12).epsilon(1e-13));
    CHECK(hex_quality(mesh.mesh).scaled_jacobian.min == Approx(1));
    CHECK(mesh.report.mapped_cells == 2);
}

TEST_CASE("a plate with a through hole, a blind pocket from each side, and a boss") {
    std::vector<PolygonCap> caps;
    caps.push_back(bottom(0, {box(0, 0, 10, 8), box(1, 1, 3, 3), disc(7, 2, 1)}));
    caps.push_back(bottom(1, {box(1, 1, 3, 3)}));
    caps.push_back(top(3, {box(0, 0, 10, 8), disc(7, 2, 1), box(2, 2, 5, 6), box(6, 5, 9, 7)}));
    caps.push_back(top(2, {box(2, 2, 5, 6)}));
    caps.push_back(top(5, {box(6, 5, 9, 7)}));
    const MultiSweepMesh mesh = swept(PolygonBody(caps), 0.5);
    const double polygon = 32 * std::sin(2 * std::numbers::pi / 64);  // area of the disc as given
    const double exact = 240 - 4 - 12 + 12 - 3 * polygon;
    CHECK(volume(mesh) == Approx(exact).epsilon(3e-3));  // the circle is divided anew
    CHECK(hex_quality(mesh.mesh).scaled_jacobian.min > 0.3);
}

TEST_CASE("slanted caps, any direction, two solids that share a cap") {
    const Vec3 d = Vec3(1, 2, 2) / 3;
    const Vec3 x = d.unitOrthogonal();
    PolygonBodyOptions options;
    options.frame = {x, d.cross(x), d};
    std::vector<PolygonCap> caps{{{box(0, 0, 4, 4)}, 0, {0, 0.1}, no_index, 0},
                                 {{box(0, 0, 4, 4)}, 2, {0.3, 0}, 0, 1},
                                 {{box(0, 0, 4, 2)}, 5, {-0.2, 0}, 1, no_index},
                                 {{box(0, 2, 4, 4)}, 6, {0, 0}, 1, no_index}};
    const PolygonBody body(caps, options);
    const MultiSweepMesh mesh = swept(body, 0.5);
    CHECK(volume(mesh) == Approx(16 * 5.3 - 3.2).epsilon(1e-12));
    CHECK(std::count(mesh.hex_solid.begin(), mesh.hex_solid.end(), 0U) > 0);
    CHECK(std::count(mesh.hex_solid.begin(), mesh.hex_solid.end(), 1U) > 0);
    CHECK(std::count(mesh.quad_surface.begin(), mesh.quad_surface.end(), 1U) == 64);
    CHECK(hex_quality(mesh.mesh).scaled_jacobian.min > 0.5);
}

TEST_CASE("edges of other levels nearby share columns that lean, and faces stay where they are") {
    const PolygonBody body({bottom(0, {box(0, 0, 2.1, 2)}), bottom(2, {box(2.1, 0, 4, 2)}), top(3, {box(2, 0, 4, 2)}),
                            top(5, {box(0, 0, 2, 2)})});
    const MultiSweepMesh apart = swept(body, 0.5);
    const MultiSweepMesh merged = swept(body, 0.5, 0.3);
    CHECK(apart.report.cells == 3);
    CHECK(merged.report.cells == 2);
    const double exact = 2.1 * 2 * 3 + 1.9 * 2 + 2 * 2 * 2;
    CHECK(volume(apart) == Approx(exact).epsilon(1e-12));
    CHECK(volume(merged) == Approx(exact).epsilon(1e-12));
    CHECK(hex_quality(merged.mesh).scaled_jacobian.min > 0.9);
}

TEST_CASE("twice the same bytes, whatever the threads") {
    const PolygonBody body({bottom(0, {box(0, 0, 6, 4), disc(2, 2, 1)}), top(1, {box(3, 0, 6, 4)}),
                            top(2, {box(0, 0, 3, 4), disc(2, 2, 1)})});
    const MultiSweepMesh a = swept(body, 0.7);
    const MultiSweepMesh b = swept(body, 0.7);
    CHECK(a.mesh.hexes == b.mesh.hexes);
    REQUIRE(a.mesh.nodes.size() == b.mesh.nodes.size());
    CHECK(std::memcmp(a.mesh.nodes.data(), b.mesh.nodes.data(), sizeof(Vec3) * a.mesh.nodes.size()) == 0);
}

TEST_CASE("a body without height is refused with its face") {
    const PolygonBody flat({bottom(1, {box(0, 0, 0.25, 0.25)}), top(1, {box(0, 0, 0.25, 0.25)})});
    MultiSweepOptions options;
    options.size = 0.5;
    try {
        (void)multi_sweep(flat.body(), flat, options, imprint, solved, GmshRegionMesher{});
        FAIL("it is not refused");
    } catch (const UnmeshableError& error) {
        CHECK(error.code() == ErrorCode::not_sweepable);
        CHECK(error.ids().size() == 1);
    }
}

TEST_CASE("bad options and empty bodies are the caller's mistakes") {
    const PolygonBody body(steps());
    MultiSweepOptions options;
    const auto run = [&](const ExtrudedBody& b) {
        return multi_sweep(b, body, options, imprint, solved, GmshRegionMesher{});
    };
    CHECK_THROWS_AS(run(body.body()), InputError);  // no size
    options.size = 1;
    CHECK_THROWS_AS(run(ExtrudedBody{}), InputError);
    options.merge = 1;
    CHECK_THROWS_AS(run(body.body()), InputError);
}
