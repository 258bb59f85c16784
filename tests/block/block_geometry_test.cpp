#include "support/block_cases.hpp"
#include "support/catch.hpp"

#include <pavior/block/block_geometry.hpp>

using block_cases::Case;
using pavior::BlockGeometry;
using pavior::ErrorCode;
using pavior::Index;
using pavior::InputError;
using pavior::Vec3;

namespace {

BlockGeometry geometry_of(const Case& c, pavior::Execution execution = pavior::sequential) {
    return pavior::block_geometry(c.mesh, c.topology, c.complex, execution);
}

Vec3 bent(const Vec3& x) { return {(1 + x[1]) * std::sin(1.5 * x[0]), (1 + x[1]) * std::cos(1.5 * x[0]), x[2]}; }

}  // namespace

TEST_CASE("shapes of a cut box", "[block_geometry]") {
    const Case c = block_cases::box({4, 2, 2}, {{0, 1}});
    const BlockGeometry g = geometry_of(c);
    REQUIRE(g.vertices.size() == 12);
    REQUIRE(g.chains.size() == 20);
    REQUIRE(g.patches.size() == 11);
    REQUIRE(g.cells.size() == 2);
    for (const auto& chain : g.chains) {
        CHECK(chain.sag() < 1e-12);
    }
    for (const auto& patch : g.patches) {
        CHECK(patch.rigid());
    }
    const Vec3 first(0.125, 0.5, 0.5);
    const Vec3 second(0.625, 0.5, 0.5);
    CHECK(std::min((g.cells[0] - first).norm(), (g.cells[0] - second).norm()) < 1e-12);
    CHECK((g.cells[0] + g.cells[1] - first - second).norm() < 1e-12);
}

TEST_CASE("sides of the maps are the chains of the complex", "[block_geometry]") {
    const Case c = block_cases::grid({8, 3, 2}, {{0, 3}, {1, 1}}, bent);
    const BlockGeometry g = geometry_of(c);
    std::size_t curved = 0;
    for (std::size_t p = 0; p < g.patches.size(); ++p) {
        curved += g.patches[p].rigid() ? 0 : 1;
        REQUIRE(g.patch_sides[p].size() == g.patches[p].polygon().size());
        for (std::size_t s = 0; s < g.patch_sides[p].size(); ++s) {
            const auto& side = g.patch_sides[p][s];
            CHECK(g.chain_ends[side.chain][side.reversed ? 1 : 0] == side.vertex);
            CHECK((g.patches[p].at(g.patches[p].polygon()[s]) - g.vertices[side.vertex]).norm() < 1e-9);
            for (const double t : {0.0, 0.3, 0.5, 1.0}) {
                const Vec3 on_chain = g.chains[side.chain].at(side.reversed ? 1 - t : t);
                CHECK((g.patches[p].at(g.patches[p].side(s, t)) - on_chain).norm() < 1e-9);
            }
        }
    }
    CHECK(curved > 0);
}

TEST_CASE("boundary patches turn counter-clockwise seen from outside and know the tags of their triangles",
          "[block_geometry]") {
    const Case c = block_cases::box({2, 2, 2}, {{2, 1}});
    const BlockGeometry g = geometry_of(c);
    std::size_t inner = 0;
    for (std::size_t p = 0; p < g.patches.size(); ++p) {
        if (g.patch_tags[p].empty()) {
            ++inner;
            continue;
        }
        const auto polygon = g.patches[p].polygon();
        const Vec3 a = g.patches[p].at(polygon[0]);
        const Vec3 normal = (g.patches[p].at(polygon[1]) - a).cross(g.patches[p].at(polygon[2]) - a);
        CHECK(normal.dot(g.patches[p].centroid() - Vec3(0.5, 0.5, 0.5)) > 0);
        CHECK(g.patch_tags[p].size() >= 4);
    }
    CHECK(inner == 1);
}

TEST_CASE("geometry is the same bytes for any number of threads", "[block_geometry]") {
    const Case c = block_cases::grid({8, 3, 2}, {{0, 3}}, bent);
    const BlockGeometry one = geometry_of(c);
    const BlockGeometry three = geometry_of(c, pavior::Execution{3});
    for (std::size_t p = 0; p < one.patches.size(); ++p) {
        const pavior::Vec2 uv = 0.3 * one.patches[p].polygon()[1] + 0.5 * one.patches[p].polygon()[2];
        CHECK(one.patches[p].at(uv) == three.patches[p].at(uv));
    }
    CHECK(one.cells == three.cells);
}

TEST_CASE("chains and patches of the wrong topology are refused", "[block_geometry]") {
    // A bar closed to a ring has no ends: its four long curves have no vertices.
    Case c = block_cases::box({2, 2, 2});
    c.complex.chains[5].ends[0] = pavior::no_index;
    try {
        static_cast<void>(geometry_of(c));
        FAIL("no error");
    } catch (const InputError& error) {
        CHECK(error.code() == ErrorCode::invalid_dual);
        CHECK(error.ids() == pavior::Error::Ids{5});
    }
}
