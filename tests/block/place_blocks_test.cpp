#include "support/block_cases.hpp"
#include "support/catch.hpp"

#include <pavior/block/dualize.hpp>
#include <pavior/block/place_blocks.hpp>
#include <pavior/block/verify_blocks.hpp>

#include <random>

using block_cases::Case;
using pavior::BlockGeometry;
using pavior::BlockMesh;
using pavior::BlockPlacement;
using pavior::Index;
using pavior::InputError;
using pavior::PlaceOptions;
using pavior::Vec3;

namespace {

struct Placed {
    BlockMesh blocks;
    BlockGeometry geometry;
    BlockPlacement placement;
};

Placed place(const Case& c, const PlaceOptions& options = {}) {
    Placed p{pavior::dualize(c.mesh, c.topology, c.classes, c.complex),
             pavior::block_geometry(c.mesh, c.topology, c.complex),
             {}};
    p.placement = pavior::place_blocks(p.blocks, p.geometry, options);
    return p;
}

/// Every node is where its parameter says.
void check_places(const Placed& p) {
    for (std::size_t i = 0; i < p.blocks.nodes.size(); ++i) {
        const auto& node = p.blocks.nodes[i];
        const Vec3& parameter = p.placement.parameters[i];
        const Vec3 x = node.dimension == 0   ? p.geometry.vertices[node.id]
                       : node.dimension == 1 ? p.geometry.chains[node.id].at(parameter[0])
                       : node.dimension == 2 ? p.geometry.patches[node.id].at(parameter.head<2>())
                                             : parameter;
        CHECK(x == p.placement.positions[i]);
    }
}

}  // namespace

TEST_CASE("a box is placed at its thirds", "[place_blocks]") {
    const Placed p = place(block_cases::box({2, 2, 2}));
    check_places(p);
    CHECK(p.placement.min_jacobian == Approx(1));
    CHECK(p.placement.moved == 0);
    CHECK(p.placement.inverted.empty());
    for (std::size_t i = 0; i < p.blocks.nodes.size(); ++i) {
        const Vec3 twice = 2 * p.placement.positions[i];
        CHECK((twice - twice.array().round().matrix()).norm() < 1e-12);
    }
}

TEST_CASE("blocks of the reference meshes are positive where they are first placed", "[place_blocks]") {
    const auto [name, worst] = GENERATE(table<const char*, double>(
        {{"ref_brick_table52", 0.949}, {"ref_pyramid_table58", 0.529}, {"ref_bug58", 0.99}}));
    const Placed p = place(block_cases::read(name));
    check_places(p);
    CHECK(p.placement.min_jacobian > worst - 1e-3);
    CHECK(p.placement.moved == 0);
    CHECK(pavior::verify_blocks(p.blocks, p.placement.positions).ok());
}

TEST_CASE("bent bars have positive blocks", "[place_blocks]") {
    const double angle = GENERATE(0.5, 1.5, 2.5);
    const Placed p = place(block_cases::grid({10, 2, 2}, {{0, 5}}, [&](const Vec3& x) {
        return Vec3((1 + x[1]) * std::sin(angle * x[0]), (1 + x[1]) * std::cos(angle * x[0]), x[2]);
    }));
    check_places(p);
    CHECK(p.placement.inverted.empty());
    CHECK(p.placement.min_jacobian > 0.1);
}

TEST_CASE("nodes slide along chains, patches and inside until blocks are positive", "[place_blocks]") {
    // A horn: half-way along its sides the blocks are bent too much.
    const auto horn = [](const Vec3& x) {
        return Vec3(x[0], x[1] * (0.8 - 0.7 * x[0]) + 1.5 * x[0] * x[0], x[2] * (0.8 - 0.7 * x[0]));
    };
    const Case c = block_cases::grid({12, 2, 2}, {}, horn);
    const Placed first = place(c, {.sufficient = 0.1, .max_rounds = 0});
    const Placed p = place(c, {.sufficient = 0.3, .max_rounds = 60});
    check_places(p);
    CHECK(first.placement.moved == 0);
    CHECK(p.placement.moved > 0);
    CHECK(p.placement.min_jacobian > first.placement.min_jacobian + 0.02);
    CHECK(first.placement.inverted.size() == 2);
    CHECK(p.placement.inverted.empty());
}

TEST_CASE("blocks that cannot be repaired are reported", "[place_blocks]") {
    // Half a turn of a thin ring in one box: straight block edges cut through the hole.
    const Placed p = place(block_cases::grid({24, 1, 1}, {}, [](const Vec3& x) {
        const double a = 5.5 * x[0];
        return Vec3((5 + x[1]) * std::sin(a), (5 + x[1]) * std::cos(a), x[2]);
    }));
    check_places(p);
    CHECK_FALSE(p.placement.inverted.empty());
    CHECK(p.placement.min_jacobian <= 0);
    const auto report = pavior::verify_blocks(p.blocks, p.placement.positions);
    CHECK(report.conforming());
    CHECK_FALSE(report.ok());
}

TEST_CASE("placement moves and scales with the solid", "[place_blocks]") {
    const double scale = GENERATE(1e-6, 1e6);
    const Vec3 shift = scale * Vec3(1, 2, 3);
    const auto bend = [](const Vec3& x) { return Vec3(x[0], x[1] + 0.5 * x[0] * x[0], x[2]); };
    const Placed p = place(block_cases::grid({4, 3, 2}, {}, bend));
    const Placed other =
        place(block_cases::grid({4, 3, 2}, {}, [&](const Vec3& x) { return Vec3(scale * bend(x) + shift); }));
    for (std::size_t i = 0; i < p.blocks.nodes.size(); ++i) {
        CHECK((other.placement.positions[i] - shift - scale * p.placement.positions[i]).norm() < 1e-6 * scale);
    }
}

TEST_CASE("options and geometries that make no sense are refused", "[place_blocks]") {
    const Placed p = place(block_cases::box({2, 2, 2}));
    CHECK_THROWS_AS(pavior::place_blocks(p.blocks, p.geometry, {.sufficient = 1.0, .max_rounds = 1}), InputError);
    CHECK_THROWS_AS(pavior::place_blocks(p.blocks, p.geometry, {.sufficient = 0.1, .max_rounds = -1}), InputError);
    const Placed other = place(block_cases::box({2, 2, 2}, {{0, 1}}));
    CHECK_THROWS_AS(pavior::place_blocks(p.blocks, other.geometry), InputError);
}
