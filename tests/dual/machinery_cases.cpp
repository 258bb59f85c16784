// The headers of dual/detail/, each called as the room calls it.
#include "support/catch.hpp"
#include "support/tet_meshes.hpp"

#include <pavior/dual/boundary_surface.hpp>
#include <pavior/dual/cell_complex.hpp>
#include <pavior/dual/classify.hpp>
#include <pavior/dual/detail/chain_tracer.hpp>
#include <pavior/dual/detail/check_tet.hpp>
#include <pavior/dual/detail/corner_finder.hpp>
#include <pavior/dual/detail/feature_finder.hpp>
#include <pavior/dual/detail/layer_fans.hpp>
#include <pavior/dual/detail/loop_tracer.hpp>
#include <pavior/dual/detail/ranked_tets.hpp>
#include <pavior/dual/detail/topology_pieces.hpp>
#include <pavior/dual/features.hpp>

#include <algorithm>

using namespace pavior;

namespace {

struct Made {
    ReferenceMesh mesh;
    TetTopology topology;
    EntityClasses classes;

    explicit Made(ReferenceMesh m)
        : mesh(std::move(m)), topology(tet_topology(mesh)), classes(classify(mesh, topology)) {}
};

// Two tetrahedra with a common face; node 0 is in none.
TetMesh two_tets() {
    TetMesh mesh;
    mesh.nodes = {{9, 9, 9}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
    mesh.tets = {{1, 2, 3, 4}, {2, 3, 4, 5}};
    return mesh;
}

}  // namespace

TEST_CASE("a tetrahedron has four different nodes that exist") {
    CHECK_NOTHROW(detail::check_tet({0, 3, 1, 2}, 7, 4));
    CHECK_THROWS_AS(detail::check_tet({0, 4, 1, 2}, 7, 4), InputError);
    for (const TetCorners& twice :
         {TetCorners{0, 0, 1, 2}, {0, 1, 0, 2}, {0, 1, 2, 0}, {0, 1, 1, 2}, {0, 1, 2, 1}, {0, 1, 2, 2}}) {
        CHECK_THROWS_AS(detail::check_tet(twice, 7, 4), InputError);
    }
}

TEST_CASE("each tracer finds its part of the cell complex anew") {
    const Made m(tet_meshes::reference(tet_meshes::box(2, 1, 1), 2));
    const CellComplex all = cell_complex(m.mesh, m.topology, m.classes);
    CellComplex part = all;
    part.edge_chain.clear();
    part.chains.clear();
    part.chain_nodes.clear();
    part.chain_begin = {0};
    detail::ChainTracer(m.topology, m.classes, part).run();
    CHECK(part.chains.size() == 20);
    CHECK(part.chains == all.chains);
    CHECK(part.edge_chain == all.edge_chain);
    CHECK(part.chain_nodes == all.chain_nodes);
    CHECK(std::all_of(part.chains.begin(), part.chains.end(), [&](const Chain& c) { return c.ends[0] != c.ends[1]; }));

    part.patch_sides.clear();
    part.loop_begin = {0};
    part.patch_loops = {0};
    detail::LoopTracer(m.mesh, m.topology, m.classes, part).run();
    CHECK(part.patch_loops.size() == 12);  // eleven discs, one loop of four sides each
    CHECK(part.patch_sides.size() == 44);
    CHECK(part.patch_sides == all.patch_sides);

    part.corners.clear();
    detail::CornerFinder(m.mesh, m.topology, m.classes, part).run();
    CHECK(part.corners.size() == 16);
    CHECK(part.corners == all.corners);
    CHECK(std::all_of(part.corners.begin(), part.corners.end(), [](const CellCorner& c) { return c.regular(); }));
}

TEST_CASE("layer faces of a cut box hang together; one without its neighbour leaves edges that dangle") {
    const auto dangling = [](Made& m) {
        const detail::LayerFans fans(m.topology, m.classes);
        std::size_t count = 0;
        for (const Index e : IndexRange(m.topology.edges.size())) {
            count += fans.dangling(e) ? 1U : 0U;
        }
        return count;
    };
    ReferenceMesh mesh = tet_meshes::reference(tet_meshes::box(2, 1, 1), 2);
    REQUIRE(mesh.layers.size() == 8);  // 2 x 2 squares, two triangles each
    Made whole(mesh);
    detail::LayerFans fans(whole.topology, whole.classes);
    const auto layers = std::count(whole.classes.face.begin(), whole.classes.face.end(), EntityClass::layer);
    CHECK(fans.faces().size() == static_cast<std::size_t>(layers));
    CHECK(fans.pinched_nodes().empty());
    CHECK(dangling(whole) == 0);
    mesh.layers.pop_back();
    Made torn(std::move(mesh));
    CHECK(dangling(torn) > 0);
}

TEST_CASE("the feature finder sees the twelve edges of a box, and forced vertices where they are asked for") {
    const TetMesh tets = tet_meshes::tetrahedra(tet_meshes::box(1, 1, 1), 2).mesh;
    const TetTopology topology = tet_topology(tets);
    const BoundarySurface surface = boundary_surface(tets, topology);
    std::vector<double> lengths;
    for (const Index e : surface.edges) {
        lengths.push_back((tets.nodes[topology.edges[e][0]] - tets.nodes[topology.edges[e][1]]).norm());
    }
    FeatureOptions options;
    options.force_tagged_vertices = true;
    detail::FeatureFinder<FeatureOptions> finder(topology, surface, interior_angles(tets, topology, surface), lengths,
                                                 options);
    finder.find({}, {TaggedNode{3, 5}});
    CHECK(std::count(finder.kinds().begin(), finder.kinds().end(), CurveKind::end) == 24);
    CHECK(std::count(finder.kinds().begin(), finder.kinds().end(), CurveKind::smooth) ==
          static_cast<std::ptrdiff_t>(surface.edges.size()) - 24);
    CHECK(std::count(finder.forced_vertices().begin(), finder.forced_vertices().end(), 1) == 1);
    CHECK(finder.forced_vertices()[3] == 1);
}

TEST_CASE("nodes are ranked as tetrahedra meet them, and tetrahedra filed under their ranks") {
    const TetMesh mesh = two_tets();
    const std::vector<Index> rank = detail::rank_nodes(mesh);
    CHECK(rank == std::vector<Index>{5, 0, 1, 2, 3, 4});
    const detail::RankedTets one = detail::ranked_tets(mesh, rank, sequential, 1);
    CHECK(one.node == std::vector<Index>{1, 2, 3, 4, 5, 0});
    CHECK(one.ranks[1] == std::array<Index, 4>{1, 2, 3, 4});
    CHECK(one.tets[0] == std::vector<Index>{0, 1});
    CHECK(one.begin[0] == std::vector<Index>{0, 1, 2, 2, 2, 2, 2});
    CHECK(one.begin[2] == std::vector<Index>{0, 0, 0, 1, 2, 2, 2});

    const TetMesh large = tet_meshes::tetrahedra(tet_meshes::box(2, 2, 2), 2).mesh;
    const std::vector<Index> ranks = detail::rank_nodes(large);
    const detail::RankedTets first = detail::ranked_tets(large, ranks, sequential, 1);
    const detail::RankedTets again = detail::ranked_tets(large, ranks, {2}, 5);
    CHECK(first.tets == again.tets);
    CHECK(first.begin == again.begin);
    for (std::size_t t = 0; t < large.tets.size(); ++t) {
        for (std::size_t k = 0; k < 4; ++k) {
            CHECK(ranks[large.tets[t][first.local[t][k]]] == first.ranks[t][k]);
            CHECK((k == 0 || first.ranks[t][k - 1] < first.ranks[t][k]));
        }
    }
    const std::vector<std::size_t> cuts = detail::balanced_cuts(first, 4);
    REQUIRE(cuts.size() == 5);
    CHECK(cuts.front() == 0);
    CHECK(cuts.back() == large.nodes.size());
    CHECK(std::is_sorted(cuts.begin(), cuts.end()));
    CHECK(cuts[1] > 0);
    for (std::size_t k = 0; k < 4; ++k) {
        CHECK(detail::local_node({7, 5, 3, 1}, static_cast<Index>(7 - 2 * k)) == k);
    }
}
