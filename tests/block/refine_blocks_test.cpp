#include "support/block_cases.hpp"
#include "support/catch.hpp"

#include <pavior/block/dualize.hpp>
#include <pavior/block/place_blocks.hpp>
#include <pavior/block/refine_blocks.hpp>
#include <pavior/mesh/quality.hpp>
#include <pavior/mesh/verify_hexes.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <set>

using block_cases::Case;
using pavior::BlockGeometry;
using pavior::BlockMesh;
using pavior::BlockPlacement;
using pavior::BlockQuad;
using pavior::ErrorCode;
using pavior::Index;
using pavior::InputError;
using pavior::QuadCorners;
using pavior::RefinedBlocks;
using pavior::RefineOptions;
using pavior::Vec3;

namespace {

struct Blocks {
    BlockMesh blocks;
    BlockGeometry geometry;
    BlockPlacement placement;

    explicit Blocks(const Case& c)
        : blocks(pavior::dualize(c.mesh, c.topology, c.classes, c.complex)),
          geometry(pavior::block_geometry(c.mesh, c.topology, c.complex)),
          placement(pavior::place_blocks(blocks, geometry)) {}

    [[nodiscard]] RefinedBlocks refine(const RefineOptions& options) const {
        return pavior::refine_blocks(blocks, geometry, placement, options);
    }
};

RefineOptions with_size(double size) {
    RefineOptions options;
    options.size = size;
    return options;
}

Vec3 arch(const Vec3& x) {
    return {(1 + x[1]) * std::sin(2 * x[0]), (1 + x[1]) * std::cos(2 * x[0]), x[2] * (1 + 0.3 * x[0])};
}

/// Distance of \p x from the boundary triangles of the reference mesh.
double distance_to_boundary(const pavior::ReferenceMesh& mesh, const Vec3& x) {
    double best = 1e300;
    for (const auto& t : mesh.patches) {
        const Vec3& a = mesh.nodes[t.nodes[0]];
        const Vec3 ab = mesh.nodes[t.nodes[1]] - a;
        const Vec3 ac = mesh.nodes[t.nodes[2]] - a;
        const Vec3 n = ab.cross(ac);
        const double v = (x - a).cross(ac).dot(n) / n.squaredNorm();
        const double w = ab.cross(x - a).dot(n) / n.squaredNorm();
        if (v >= -1e-9 && w >= -1e-9 && v + w <= 1 + 1e-9) {
            best = std::min(best, std::abs((x - a).dot(n.normalized())));
        }
    }
    return best;
}

/// Everything that a refined mesh must be.
void check(const Case& c, const Blocks& b, const RefinedBlocks& fine) {
    std::vector<QuadCorners> boundary;
    for (const BlockQuad& quad : fine.boundary) {
        boundary.push_back(quad.nodes);
    }
    const auto report = pavior::verify_hexes(fine.mesh, std::span<const QuadCorners>(boundary));
    INFO(report.text());
    CHECK(report.ok());
    CHECK(fine.untangling.inverted_after == 0);
    CHECK(fine.inverted_blocks.empty());
    CHECK(pavior::hex_quality(fine.mesh).inverted == 0);
    REQUIRE(fine.node_origin.size() == fine.mesh.nodes.size());
    REQUIRE(fine.hex_block.size() == fine.mesh.hexes.size());
    CHECK(std::is_sorted(fine.hex_block.begin(), fine.hex_block.end()));
    std::set<Index> on_boundary;
    for (const QuadCorners& quad : boundary) {
        on_boundary.insert(quad.begin(), quad.end());
    }
    for (const Index i : on_boundary) {
        CHECK(distance_to_boundary(c.mesh, fine.mesh.nodes[i]) < 1e-9);
        CHECK(b.blocks.nodes[fine.node_origin[i]].geometry.dimension < 3);
    }
    std::size_t hexes = 0;
    for (Index h = 0; h < b.blocks.hexes.size(); ++h) {
        std::size_t product = 1;
        for (const Index s : b.blocks.hex_sheets(h)) {
            product *= fine.sheets[s].intervals;
        }
        hexes += product;
    }
    CHECK(hexes == fine.mesh.hexes.size());
}

}  // namespace

TEST_CASE("refined blocks are conforming, positive and on the surface", "[refine_blocks]") {
    const auto [name, volume] =
        GENERATE(table<const char*, double>({{"ref_brick_table52", 6.69}, {"ref_pyramid_table58", 9.0 + 4.0 / 15}}));
    const double size = GENERATE(10.0, 0.4, 0.17);
    const Case c = block_cases::read(name);
    const Blocks b(c);
    const RefinedBlocks fine = b.refine(with_size(size));
    check(c, b, fine);
    CHECK(pavior::verify_hexes(fine.mesh).volume == Approx(volume).epsilon(1e-12));
    if (size > 5) {
        CHECK(fine.mesh.hexes == b.blocks.hexes);
    }
}

TEST_CASE("curved patches are followed", "[refine_blocks]") {
    const Case c = block_cases::grid({16, 3, 3}, {{0, 8}, {2, 1}}, arch);
    const Blocks b(c);
    for (const double size : {0.5, 0.2, 0.07}) {
        const RefinedBlocks fine = b.refine(with_size(size));
        check(c, b, fine);
        double longest = 0;
        for (const auto& hex : fine.mesh.hexes) {
            for (const auto& e : pavior::hex_edges) {
                longest = std::max(longest, (fine.mesh.nodes[hex[static_cast<std::size_t>(e[0])]] -
                                             fine.mesh.nodes[hex[static_cast<std::size_t>(e[1])]])
                                                .norm());
            }
        }
        CHECK(longest < 2.5 * size);
    }
}

TEST_CASE("a block that is inverted itself may have a valid refinement", "[refine_blocks]") {
    const Case c = block_cases::grid({24, 1, 1}, {}, [](const Vec3& x) {
        const double a = 5.5 * x[0];
        return Vec3((5 + x[1]) * std::sin(a), (5 + x[1]) * std::cos(a), x[2]);
    });
    const Blocks b(c);
    CHECK_FALSE(b.placement.inverted.empty());
    const RefinedBlocks fine = b.refine(with_size(0.5));
    check(c, b, fine);
}

TEST_CASE("nodes of chains are spaced evenly between block nodes", "[refine_blocks]") {
    const Case c = block_cases::grid({16, 2, 2}, {}, arch);
    const Blocks b(c);
    RefineOptions options;
    options.intervals.assign(b.blocks.sheet_count, 4);
    const RefinedBlocks fine = b.refine(options);
    check(c, b, fine);
    for (Index chain = 0; chain < b.geometry.chains.size(); ++chain) {
        const auto& line = b.geometry.chains[chain];
        std::size_t found = 0;
        for (std::size_t i = 0; i < fine.mesh.nodes.size(); ++i) {
            if (fine.node_origin[i] == b.blocks.node(1, chain)) {
                double nearest = 1e300;
                for (int k = 1; k < 8; ++k) {
                    nearest = std::min(nearest, (line.at(k / 8.0) - fine.mesh.nodes[i]).norm());
                }
                CHECK(nearest < 1e-12);
                ++found;
            }
        }
        CHECK(found == 7);
    }
}

TEST_CASE("each sheet can be given its own number of intervals", "[refine_blocks]") {
    const Case c = block_cases::read("ref_pyramid_table58");
    const Blocks b(c);
    RefineOptions options;
    for (Index s = 0; s < b.blocks.sheet_count; ++s) {
        options.intervals.push_back(1 + s % 4);
    }
    const RefinedBlocks fine = b.refine(options);
    check(c, b, fine);
    for (Index s = 0; s < b.blocks.sheet_count; ++s) {
        CHECK(fine.sheets[s].intervals == options.intervals[s]);
    }
}

TEST_CASE("boundary quads carry the patches of the reference mesh", "[refine_blocks]") {
    const Case c = block_cases::box({2, 2, 2}, {{0, 1}});
    const Blocks b(c);
    const RefinedBlocks fine = b.refine({});
    std::set<std::int32_t> tags;
    for (const BlockQuad& quad : fine.boundary) {
        tags.insert(quad.tag);
        const Vec3 middle = 0.5 * (fine.mesh.nodes[quad.nodes[0]] + fine.mesh.nodes[quad.nodes[2]]);
        std::int32_t expected = -1;
        for (const auto& t : c.mesh.patches) {  // the patch whose plane holds the quad
            const Vec3 n = (c.mesh.nodes[t.nodes[1]] - c.mesh.nodes[t.nodes[0]])
                               .cross(c.mesh.nodes[t.nodes[2]] - c.mesh.nodes[t.nodes[0]])
                               .normalized();
            if (std::abs((middle - c.mesh.nodes[t.nodes[0]]).dot(n)) < 1e-9) {
                expected = t.tag;
            }
        }
        CHECK(quad.tag == expected);
        CHECK(b.blocks.nodes[b.blocks.node(2, quad.patch)].geometry.dimension == 2);
    }
    CHECK(tags.size() == 6);
}

TEST_CASE("the fine mesh is the same bytes for any number of threads", "[refine_blocks]") {
    const Blocks b(block_cases::grid({8, 3, 3}, {{0, 4}}, arch));
    RefineOptions options = with_size(0.15);
    const RefinedBlocks one = b.refine(options);
    options.execution = pavior::Execution{4};
    const RefinedBlocks four = b.refine(options);
    CHECK(one.mesh.hexes == four.mesh.hexes);
    REQUIRE(one.mesh.nodes.size() == four.mesh.nodes.size());
    CHECK(std::memcmp(one.mesh.nodes.data(), four.mesh.nodes.data(), sizeof(Vec3) * one.mesh.nodes.size()) == 0);
    CHECK(one.boundary == four.boundary);
}

TEST_CASE("inverted hexahedra are untangled, or reported if that is not wanted", "[refine_blocks]") {
    const Case c = block_cases::box({4, 4, 4}, {{0, 2}, {1, 2}, {2, 2}});
    Blocks b(c);
    for (Index i = b.blocks.first[3]; i < b.blocks.first[4]; ++i) {  // cells pushed out of themselves
        b.placement.parameters[i] = b.placement.positions[i] =
            Vec3(0.5, 0.5, 0.5) + 0.4 * (b.placement.positions[i] - Vec3(0.5, 0.5, 0.5)) * (i % 2 == 0 ? -1 : 1);
    }
    RefineOptions options;
    options.intervals.assign(b.blocks.sheet_count, 3);
    options.untangle = false;
    const RefinedBlocks raw = b.refine(options);
    CHECK(raw.untangling.inverted_after > 0);
    CHECK(raw.untangling.moved_nodes == 0);
    CHECK_FALSE(raw.inverted_blocks.empty());
    options.untangle = true;
    const RefinedBlocks fine = b.refine(options);
    CHECK(fine.untangling.inverted_before == raw.untangling.inverted_after);
    check(c, b, fine);
    options.optimise = true;
    const RefinedBlocks best = b.refine(options);
    check(c, b, best);
    CHECK(best.untangling.min_det_after >= fine.untangling.min_det_after - 1e-9);
}

TEST_CASE("options that make no sense are refused", "[refine_blocks]") {
    const Blocks b(block_cases::box({2, 2, 2}));
    const auto code = [&](const RefineOptions& options) {
        try {
            static_cast<void>(b.refine(options));
        } catch (const InputError& error) {
            return error.code();
        }
        return ErrorCode::empty_input;
    };
    RefineOptions options;
    options.intervals.assign(b.blocks.sheet_count - 1, 2);
    CHECK(code(options) == ErrorCode::size_mismatch);
    options.intervals.assign(b.blocks.sheet_count, 0);
    CHECK(code(options) == ErrorCode::bad_option);
    CHECK(code(with_size(std::nan(""))) == ErrorCode::bad_option);
    CHECK(code(with_size(1e-12)) == ErrorCode::overflow);
    CHECK(code(with_size(1e-6)) == ErrorCode::overflow);
}
