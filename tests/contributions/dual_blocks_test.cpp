#include "support/catch.hpp"
#include "support/tet_meshes.hpp"

#include <pavior/contributions/dual_blocks.hpp>
#include <pavior/dual/verify_dual.hpp>

#include <algorithm>
#include <random>
#include <set>

using namespace pavior;

namespace {
// The same hexahedron with its smallest chain as corner 1.
HexCorners canonical(HexCorners h) {
    while (h[1] > h[3] || h[1] > h[4]) {
        h = {h[0], h[3], h[7], h[4], h[1], h[2], h[6], h[5]};
    }
    return h;
}

struct Result {
    bool valid = false;
    bool equal = false;
    std::size_t blocks = 0;
    std::size_t nodes = 0;
    std::size_t cells = 0;  // of all dimensions, of the complex
    std::size_t irregular = 0;
};

// Blocks read off the contributions against the midpoint subdivision of the cell complex.
template <class M>
Result compare(const M& mesh) {
    const TetTopology topology = tet_topology(mesh);
    const EntityClasses classes = classify(mesh, topology);
    const CellComplex complex = cell_complex(mesh, topology, classes);
    const auto contributions = add_contributions(mesh, topology, classes);
    const Regions region = regions(mesh, topology, contributions);
    const DualBlocks dual = dual_blocks(mesh, topology, contributions, region);
    std::vector<std::pair<HexCorners, Index>> wanted;  // with the smallest tetrahedron round the dual point
    std::vector<std::pair<HexCorners, Index>> found;
    std::set<std::array<Index, 2>> edges;
    for (const CellCorner& c : complex.corners) {
        if (c.regular()) {
            const auto chain = [&](std::size_t k) { return region.begin[2] + c.chains[k]; };
            const auto patch = [&](std::size_t k) { return region.begin[1] + c.patches[k]; };
            const HexCorners h = canonical(
                {region.begin[3] + c.vertex, chain(0), patch(0), chain(1), chain(2), patch(2), c.cell, patch(1)});
            wanted.emplace_back(h, c.tet);
            for (std::size_t a = 0; a < 8; ++a) {
                for (const int b : hex_corner_neighbours[a]) {
                    edges.insert({std::min(h[a], h[static_cast<std::size_t>(b)]),
                                  std::max(h[a], h[static_cast<std::size_t>(b)])});
                }
            }
        }
    }
    REQUIRE(dual.tet.size() == dual.blocks.size());
    for (std::size_t b = 0; b < dual.blocks.size(); ++b) {
        found.emplace_back(canonical(dual.blocks[b]), dual.tet[b]);
    }
    std::sort(found.begin(), found.end());
    std::sort(wanted.begin(), wanted.end());
    const bool same_edges = std::vector<std::array<Index, 2>>(edges.begin(), edges.end()) == dual.edges;
    return {verify_dual(mesh, topology, classes, complex).valid(),
            found == wanted && same_edges,
            dual.blocks.size(),
            region.count(),
            complex.cell_count(),
            dual.irregular};
}
}  // namespace

TEST_CASE("tables 5.2 and 5.8") {
    const Result brick = compare(tet_meshes::read_reference("ref_brick_table52").mesh);
    CHECK((brick.valid && brick.equal && brick.blocks == 8 && brick.nodes == 27 && brick.irregular == 0));
    const Result pyramid = compare(tet_meshes::read_reference("ref_pyramid_table58").mesh);
    CHECK((pyramid.valid && pyramid.equal && pyramid.blocks == 92 && pyramid.nodes == 177 && pyramid.irregular == 0));
    const Result cap = compare(tet_meshes::read_reference("ref_bug58").mesh);
    CHECK((cap.valid && cap.equal && cap.blocks == 8 && cap.nodes == 27));
}

TEST_CASE("random solids cut at every voxel: valid, as many blocks and nodes as counted on the voxels") {
    const unsigned seed = 2024;
    INFO("seed " << seed);
    std::mt19937 random(seed);
    for (int n = 0; n < 100; ++n) {
        const std::array<Index, 3> size{1 + static_cast<Index>(random() % 4), 1 + static_cast<Index>(random() % 3),
                                        1 + static_cast<Index>(random() % 3)};
        const tet_meshes::Voxels solid = tet_meshes::random_solid(size, random);
        const auto strata = tet_meshes::strata(solid);
        const Result result = compare(tet_meshes::reference(solid, 1 + static_cast<Index>(n % 3 == 0)));
        INFO("solid " << n);
        CHECK(result.valid);
        CHECK(result.equal);
        CHECK(result.blocks == 8 * strata[3]);
        CHECK(result.nodes == strata[0] + strata[1] + strata[2] + strata[3]);
        CHECK(result.irregular == 0);
    }
}

TEST_CASE("random planes, random faces: wherever the result is valid, both ways agree") {
    std::mt19937 random(99);
    int valid = 0;
    int irregular = 0;
    for (int n = 0; n < 150; ++n) {
        const auto tets =
            tet_meshes::tetrahedra(tet_meshes::random_solid({3, 2, 2}, random), 1 + static_cast<Index>(n % 2));
        const TetTopology topology = tet_topology(tets.mesh);
        ReferenceMesh mesh = make_reference_mesh(tets.mesh, topology);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            for (Index at = 1; at < 6; ++at) {
                if (random() % 2 == 0) {
                    tet_meshes::add_plane(tets, topology, axis, at, mesh);
                }
            }
        }
        if (n % 5 == 0 && !mesh.layers.empty()) {
            mesh.layers.erase(mesh.layers.begin() + static_cast<std::ptrdiff_t>(random() % mesh.layers.size()));
        }
        const Result result = compare(mesh);
        valid += result.valid ? 1 : 0;
        irregular += result.irregular > 0 ? 1 : 0;
        if (result.valid) {
            CHECK(result.equal);
            CHECK(result.irregular == 0);
        }
        CHECK(result.nodes == result.cells);
    }
    CHECK(valid > 40);
    CHECK(irregular > 40);
}

TEST_CASE("foreign mesh") {
    const Result result = compare(archetype::Tets(tet_meshes::reference(tet_meshes::box(2, 2, 1))));
    CHECK((result.valid && result.equal && result.blocks == 32));
}
