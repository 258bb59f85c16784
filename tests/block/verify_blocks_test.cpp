#include "support/block_cases.hpp"
#include "support/catch.hpp"

#include <pavior/block/dualize.hpp>
#include <pavior/block/place_blocks.hpp>
#include <pavior/block/verify_blocks.hpp>

#include <cmath>

using block_cases::Case;
using pavior::BlockMesh;
using pavior::BlockNode;
using pavior::BlockReport;
using pavior::HexCorners;
using pavior::Index;
using pavior::InputError;
using pavior::MeshFault;
using pavior::Vec3;

namespace {
std::pair<BlockMesh, std::vector<Vec3>> placed(const Case& c) {
    BlockMesh blocks = pavior::dualize(c.mesh, c.topology, c.classes, c.complex);
    auto positions = pavior::place_blocks(blocks, pavior::block_geometry(c.mesh, c.topology, c.complex)).positions;
    return {std::move(blocks), std::move(positions)};
}
}  // namespace

TEST_CASE("counts of valid blocks", "[verify_blocks]") {
    const auto [blocks, positions] = placed(block_cases::read("ref_pyramid_table58"));
    const BlockReport report = pavior::verify_blocks(blocks, positions);
    CHECK(report.ok());
    CHECK(report.conforming());
    CHECK(report.text().empty());
    CHECK(std::array{report.vertices, report.chains, report.patches, report.cells} ==
          std::array<std::size_t, 4>{33, 74, 56, 14});
    CHECK(report.blocks == 92);
    CHECK(report.nodes() == 177);
    CHECK(report.euler == 1);
    CHECK(report.sheets == blocks.sheet_count);
    CHECK(2 * report.quads - report.boundary_quads == 6 * report.blocks);
    CHECK(report.mesh.boundary_quads == report.boundary_quads);
    CHECK(report.mesh.volume == Approx(9.0 + 4.0 / 15));
}

TEST_CASE("a ring of blocks has characteristic zero", "[verify_blocks]") {
    // Half a turn, glued to its mirror image by hand: blocks only.
    const auto [half, positions] = placed(block_cases::grid({8, 1, 1}, {{0, 4}}, [](const Vec3& x) {
        return Vec3((1 + x[1]) * std::sin(M_PI * x[0]), (1 + x[1]) * std::cos(M_PI * x[0]), x[2]);
    }));
    CHECK(pavior::verify_blocks(half, positions).euler == 1);
    const Case box = block_cases::box({3, 3, 1}, {{0, 1}, {0, 2}, {1, 1}, {1, 2}});
    const BlockMesh all = pavior::dualize(box.mesh, box.topology, box.classes, box.complex);
    const auto places =
        pavior::place_blocks(all, pavior::block_geometry(box.mesh, box.topology, box.complex)).positions;
    std::vector<HexCorners> ring;
    for (const HexCorners& c : all.hexes) {
        const Vec3& centre = places[c[6]];
        if (std::abs(centre[0] - 0.5) > 0.1 || std::abs(centre[1] - 0.5) > 0.1) {
            ring.push_back(c);
        }
    }
    // Without the middle box, whose patches stay: nodes of no block are the only fault.
    const BlockMesh holed = pavior::make_block_mesh(all.nodes, ring);
    const BlockReport report = pavior::verify_blocks(holed, places);
    CHECK(report.mesh.findings().size() == 1);
    const std::size_t unused = report.mesh.count(MeshFault::unused_node);
    CHECK(unused == 3);  // its cell, and its two patches on the boundary
    CHECK(report.euler - static_cast<std::int64_t>(unused) == 0);
}

TEST_CASE("inverted blocks are found, but are conforming", "[verify_blocks]") {
    auto [blocks, positions] = placed(block_cases::box({2, 2, 2}));
    positions[blocks.node(3, 0)] = Vec3(2, 2, 2);
    const BlockReport report = pavior::verify_blocks(blocks, positions);
    CHECK_FALSE(report.ok());
    CHECK(report.conforming());
    CHECK(report.mesh.count(MeshFault::inverted) > 0);
    CHECK(report.text().find("inverted") != std::string::npos);
}

TEST_CASE("blocks with two quads in common are found", "[verify_blocks]") {
    // A patch with two corners, between chains 2 and 3: its two blocks share the quads of both chains.
    std::vector<BlockNode> nodes{{0, 0, {}}, {0, 1, {}}, {1, 0, {}}, {1, 1, {}}, {1, 2, {}},
                                 {1, 3, {}}, {2, 0, {}}, {2, 1, {}}, {2, 2, {}}, {3, 0, {}}};
    const BlockMesh blocks = pavior::make_block_mesh(nodes, {{0, 2, 6, 3, 4, 7, 9, 8}, {1, 3, 6, 2, 5, 8, 9, 7}});
    const std::vector<Vec3> positions{{0, 0, 0}, {2, 2, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1},
                                      {2, 2, 1}, {1, 1, 0}, {1, 0, 1}, {0, 1, 1}, {1, 1, 1}};
    const BlockReport report = pavior::verify_blocks(blocks, positions);
    CHECK(report.double_neighbours == std::vector<Index>{0, 1});
    CHECK_FALSE(report.conforming());
    CHECK_FALSE(report.ok());
    CHECK(report.text().find("two quads in common") != std::string::npos);
}

TEST_CASE("an open boundary or a block left out is no valid mesh", "[verify_blocks]") {
    const auto [blocks, positions] = placed(block_cases::box({2, 2, 2}));
    std::vector<HexCorners> hexes(blocks.hexes.begin(), blocks.hexes.end() - 1);
    const BlockReport report = pavior::verify_blocks(pavior::make_block_mesh(blocks.nodes, hexes), positions);
    CHECK_FALSE(report.ok());  // the vertex of the block is unused
    CHECK(report.mesh.count(MeshFault::unused_node) == 1);
    CHECK_THROWS_AS(pavior::verify_blocks(blocks, std::span(positions).first(3)), InputError);
}
