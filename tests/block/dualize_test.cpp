#include "support/block_cases.hpp"
#include "support/catch.hpp"

#include <pavior/block/dualize.hpp>
#include <pavior/contributions/contributions.hpp>
#include <pavior/contributions/dual_blocks.hpp>
#include <pavior/contributions/regions.hpp>
#include <pavior/dual/verify_dual.hpp>

#include <algorithm>
#include <numeric>
#include <random>
#include <set>
#include <span>

using block_cases::Case;
using pavior::BlockMesh;
using pavior::ErrorCode;
using pavior::GeometryEntity;
using pavior::HexCorners;
using pavior::Index;
using pavior::InputError;
using pavior::no_index;
using pavior::Vec3;

namespace {

BlockMesh blocks_of(const Case& c) { return pavior::dualize(c.mesh, c.topology, c.classes, c.complex); }

/// Turned about the diagonal 0 6 so that the smallest chain is corner 1.
HexCorners turned(HexCorners c) {
    while (c[1] > c[3] || c[1] > c[4]) {
        c = {c[0], c[3], c[7], c[4], c[1], c[2], c[6], c[5]};
    }
    return c;
}

/// The block node of each region of the contributions.
std::vector<Index> node_of_region(const Case& c, const BlockMesh& blocks, const pavior::Regions& regions) {
    std::vector<Index> node(regions.count(), no_index);
    const auto set = [&](Index region, int dimension, Index id) {
        if (id != no_index) {
            const Index wanted = blocks.node(dimension, id);
            CHECK((node[region] == no_index || node[region] == wanted));
            node[region] = wanted;
        }
    };
    for (Index t = 0; t < regions.tet.size(); ++t) {
        set(regions.tet[t], 3, c.complex.tet_cell[t]);
    }
    for (Index f = 0; f < regions.face.size(); ++f) {
        set(regions.face[f], 2, c.complex.face_patch[f]);
    }
    for (Index e = 0; e < regions.edge.size(); ++e) {
        set(regions.edge[e], 1, c.complex.edge_chain[e]);
    }
    for (Index i = 0; i < regions.node.size(); ++i) {
        set(regions.node[i], 0, c.complex.node_vertex[i]);
    }
    return node;
}

/// Random boxes of tetrahedra with random whole cuts.
Case random_box(unsigned seed) {
    std::mt19937 random(seed);
    const std::array<Index, 3> m{static_cast<Index>(2 + random() % 3), static_cast<Index>(2 + random() % 3),
                                 static_cast<Index>(2 + random() % 3)};
    std::vector<std::array<Index, 2>> cuts;
    for (Index axis = 0; axis < 3; ++axis) {
        for (Index k = 1; k < m[axis]; ++k) {
            if (random() % 2 == 0) {
                cuts.push_back({axis, k});
            }
        }
    }
    return block_cases::box(m, cuts);
}

}  // namespace

TEST_CASE("blocks of the reference meshes of tables 5.2 and 5.8", "[dualize]") {
    const auto [name, blocks, nodes] = GENERATE(table<const char*, std::size_t, std::size_t>(
        {{"ref_brick_table52", 8, 27}, {"ref_pyramid_table58", 92, 177}, {"ref_bug58", 8, 27}}));
    const BlockMesh mesh = blocks_of(block_cases::read(name));
    CHECK(mesh.hexes.size() == blocks);
    CHECK(mesh.nodes.size() == nodes);
}

TEST_CASE("blocks are those read off the contributions and regions", "[dualize]") {
    const Case c = [] {
        const int which = GENERATE(0, 1, 2, 3, 4, 5, 6, 7, 8);
        return which == 0   ? block_cases::read("ref_brick_table52")
               : which == 1 ? block_cases::read("ref_pyramid_table58")
                            : random_box(static_cast<unsigned>(which));
    }();
    REQUIRE(pavior::verify_dual(c.mesh, c.topology, c.classes, c.complex).valid());
    const BlockMesh blocks = blocks_of(c);
    const auto contributions = pavior::add_contributions(c.mesh, c.topology, c.classes);
    const auto regions = pavior::regions(c.mesh, c.topology, contributions);
    const auto literal = pavior::dual_blocks(c.mesh, c.topology, contributions, regions);
    CHECK(regions.count() == blocks.nodes.size());
    CHECK(literal.irregular == 0);
    const auto node = node_of_region(c, blocks, regions);
    std::set<HexCorners> expected;
    std::set<HexCorners> actual;
    for (HexCorners h : literal.blocks) {
        std::transform(h.begin(), h.end(), h.begin(), [&](Index region) { return node[region]; });
        expected.insert(turned(h));
    }
    for (const HexCorners& h : blocks.hexes) {
        actual.insert(turned(h));
    }
    CHECK(literal.blocks.size() == blocks.hexes.size());
    CHECK(actual == expected);
    std::set<std::array<Index, 2>> edges;
    for (const auto& e : literal.edges) {
        edges.insert({std::min(node[e[0]], node[e[1]]), std::max(node[e[0]], node[e[1]])});
    }
    CHECK(edges == std::set<std::array<Index, 2>>(blocks.edges.begin(), blocks.edges.end()));
}

namespace {
void check_equal(const BlockMesh& a, const BlockMesh& b) {
    CHECK(a.nodes == b.nodes);
    CHECK(a.first == b.first);
    CHECK(a.hexes == b.hexes);
    CHECK(a.edges == b.edges);
    CHECK(a.quads == b.quads);
    CHECK(a.quad_hexes == b.quad_hexes);
    CHECK(a.hex_edges == b.hex_edges);
    CHECK(a.hex_quads == b.hex_quads);
    CHECK(a.sheets == b.sheets);
    CHECK(a.sheet_count == b.sheet_count);
}

/// The tetrahedra and nodes of \p mesh in a random order.
pavior::ReferenceMesh shuffled(pavior::ReferenceMesh mesh, unsigned seed) {
    std::mt19937 random(seed);
    std::shuffle(mesh.tets.begin(), mesh.tets.end(), random);
    std::vector<Index> to(mesh.nodes.size());
    std::iota(to.begin(), to.end(), Index{0});
    std::shuffle(to.begin(), to.end(), random);
    std::vector<Vec3> nodes(mesh.nodes.size());
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        nodes[to[i]] = mesh.nodes[i];
    }
    mesh.nodes = std::move(nodes);
    const auto rename = [&](auto& ids) {
        std::transform(ids.begin(), ids.end(), ids.begin(), [&](Index i) { return to[i]; });
    };
    std::for_each(mesh.tets.begin(), mesh.tets.end(), rename);
    std::for_each(mesh.layers.begin(), mesh.layers.end(), rename);
    for (auto& patch : mesh.patches) {
        rename(patch.nodes);
    }
    for (auto& curve : mesh.curves) {
        rename(curve.nodes);
    }
    for (auto& vertex : mesh.vertices) {
        vertex.node = to[vertex.node];
    }
    return mesh;
}
}  // namespace

TEST_CASE("contributions alone give the same bytes as the cell complex, however the mesh is numbered", "[dualize]") {
    const Case c = [] {
        const int which = GENERATE(range(0, 12));
        return which == 0   ? block_cases::read("ref_brick_table52")
               : which == 1 ? block_cases::read("ref_pyramid_table58")
               : which == 2 ? block_cases::read("ref_bug58")
                            : random_box(static_cast<unsigned>(which));
    }();
    check_equal(pavior::dualize_contributions(c.mesh, c.topology, c.classes), blocks_of(c));
    const Case other = block_cases::complete(shuffled(c.mesh, 7));
    check_equal(pavior::dualize_contributions(other.mesh, other.topology, other.classes, pavior::Execution{2}),
                blocks_of(other));
    CHECK(blocks_of(other).hexes.size() == blocks_of(c).hexes.size());
}

TEST_CASE("dual points without a hexahedron are refused, and what does not belong together", "[dualize]") {
    Case c = block_cases::read("ref_pyramid_table58");
    const Case whole = c;
    c.mesh.layers.clear();
    c = block_cases::complete(c.mesh);
    try {
        static_cast<void>(pavior::dualize_contributions(c.mesh, c.topology, c.classes));
        FAIL("no error");
    } catch (const InputError& error) {
        CHECK(error.code() == ErrorCode::invalid_dual);
    }
    const Case box = block_cases::box({2, 2, 2});
    const auto contributions = pavior::add_contributions(box.mesh, box.topology, box.classes);
    const auto regions = pavior::regions(box.mesh, box.topology, contributions);
    const auto dual = pavior::dual_blocks(box.mesh, box.topology, contributions, regions);
    CHECK_THROWS_AS(pavior::dualize(whole.mesh, whole.topology, regions, dual), InputError);
}

TEST_CASE("a cut box is the midpoint subdivision of its pieces", "[dualize]") {
    const BlockMesh mesh = blocks_of(block_cases::box({3, 2, 4}, {{0, 1}, {0, 2}, {2, 2}}));
    CHECK(mesh.hexes.size() == 8 * 6);
    CHECK(mesh.nodes.size() == 7 * 3 * 5);
    CHECK(mesh.sheet_count == 6 + 2 + 4);
}

TEST_CASE("block nodes know the entity of the geometry that they lie on", "[dualize]") {
    const Case c = block_cases::box({2, 2, 2}, {{0, 1}});
    const BlockMesh mesh = blocks_of(c);
    std::array<std::array<int, 4>, 4> count{};  // dimension in the complex, dimension in the geometry
    for (const auto& node : mesh.nodes) {
        ++count[node.dimension][node.geometry.dimension];
    }
    CHECK(count[0] == std::array<int, 4>{8, 4, 0, 0});   // the cut meets four curves
    CHECK(count[1] == std::array<int, 4>{0, 16, 4, 0});  // and four patches
    CHECK(count[2] == std::array<int, 4>{0, 0, 10, 1});
    CHECK(count[3] == std::array<int, 4>{0, 0, 0, 2});
    for (const auto& node : mesh.nodes) {
        if (node.dimension == 2 && node.geometry.dimension == 2) {
            const auto& corners = c.topology.faces[c.complex.patches[node.id]];
            const auto same = [&](const pavior::TaggedTriangle& t) {
                auto sorted = t.nodes;
                std::sort(sorted.begin(), sorted.end());
                return sorted == corners;
            };
            const auto at = std::find_if(c.mesh.patches.begin(), c.mesh.patches.end(), same);
            REQUIRE(at != c.mesh.patches.end());
            CHECK(node.geometry == GeometryEntity{2, at->tag});
        }
    }
}

TEST_CASE("corners without three chains are refused by name", "[dualize]") {
    Case c = block_cases::read("ref_pyramid_table58");
    c.mesh.layers.clear();
    c = block_cases::complete(c.mesh);
    try {
        static_cast<void>(blocks_of(c));
        FAIL("no error");
    } catch (const InputError& error) {
        CHECK(error.code() == ErrorCode::invalid_dual);
        REQUIRE(error.ids().size() == 1);
        CHECK(error.ids()[0] < 13);
    }
    const Case other = block_cases::box({2, 2, 2});
    CHECK_THROWS_AS(pavior::dualize(c.mesh, other.topology, other.classes, other.complex), InputError);
}

namespace {
/// The least that a classified tetrahedral mesh is.
struct TetArchetype {
    const pavior::ReferenceMesh* mesh;
};
}  // namespace

template <>
struct pavior::mesh_access<TetArchetype> {
    static unsigned node_count(const TetArchetype& m) { return static_cast<unsigned>(m.mesh->nodes.size()); }
    static std::array<double, 3> node(const TetArchetype& m, Index i) {
        return {m.mesh->nodes[i][0], m.mesh->nodes[i][1], m.mesh->nodes[i][2]};
    }
    static unsigned tet_count(const TetArchetype& m) { return static_cast<unsigned>(m.mesh->tets.size()); }
    static std::array<unsigned short, 4> tet(const TetArchetype& m, Index t) {
        const auto& c = m.mesh->tets[t];
        return {static_cast<unsigned short>(c[0]), static_cast<unsigned short>(c[1]), static_cast<unsigned short>(c[2]),
                static_cast<unsigned short>(c[3])};
    }
};
template <>
struct pavior::feature_access<TetArchetype> {
    static std::span<const TaggedTriangle> patches(const TetArchetype& m) { return m.mesh->patches; }
    static std::span<const FeatureEdge> curves(const TetArchetype& m) { return m.mesh->curves; }
    static std::span<const TaggedNode> vertices(const TetArchetype& m) { return m.mesh->vertices; }
    static std::span<const TriCorners> layers(const TetArchetype& m) { return m.mesh->layers; }
};

TEST_CASE("an archetype of a classified mesh gives the same blocks", "[dualize]") {
    const Case c = block_cases::read("ref_pyramid_table58");
    const TetArchetype archetype{&c.mesh};
    const auto topology = pavior::tet_topology(archetype);
    const auto classes = pavior::classify(archetype, topology);
    const BlockMesh mesh =
        pavior::dualize(archetype, topology, classes, pavior::cell_complex(archetype, topology, classes));
    CHECK(mesh.hexes == blocks_of(c).hexes);
    CHECK(mesh.nodes == blocks_of(c).nodes);
}
