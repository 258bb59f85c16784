#include "support/catch.hpp"
#include "support/tet_meshes.hpp"

#include <pavior/dual/cell_complex.hpp>

#include <Eigen/LU>

#include <algorithm>
#include <set>

using namespace pavior;

namespace {
struct Made {
    ReferenceMesh mesh;
    TetTopology topology;
    EntityClasses classes;
    CellComplex complex;
};
Made make(ReferenceMesh mesh) {
    Made m{std::move(mesh), {}, {}, {}};
    m.topology = tet_topology(m.mesh);
    m.classes = classify(m.mesh, m.topology);
    m.complex = cell_complex(m.mesh, m.topology, m.classes);
    return m;
}
std::array<std::size_t, 4> strata(const CellComplex& c) {
    return {c.vertices.size(), c.chains.size(), c.patches.size(), c.cells.size()};
}
// First step of a chain as it leaves a vertex.
Vec3 leaving(const Made& m, Index chain, Index vertex) {
    const auto path = m.complex.chain_path(chain);
    const bool forward = m.complex.chains[chain].ends[0] == vertex;
    const Index a = forward ? path[0] : path[path.size() - 1];
    const Index b = forward ? path[1] : path[path.size() - 2];
    return m.mesh.nodes[b] - m.mesh.nodes[a];
}
}  // namespace

TEST_CASE("a box of two by one by one, finely divided") {
    const Made m = make(tet_meshes::reference(tet_meshes::box(2, 1, 1), 3));
    const CellComplex& c = m.complex;
    CHECK(strata(c) == std::array<std::size_t, 4>{12, 20, 11, 2});
    CHECK(c.cell_count() == 45);
    CHECK(c.corners.size() == 16);
    for (const CellCorner& corner : c.corners) {
        REQUIRE(corner.regular());
        Eigen::Matrix3d directions;
        for (int k = 0; k < 3; ++k) {
            directions.col(k) = leaving(m, corner.chains[static_cast<std::size_t>(k)], corner.vertex);
        }
        CHECK(directions.determinant() > 0.0);
        CHECK(c.tet_cell[corner.tet] == corner.cell);
        for (std::size_t k = 0; k < 3; ++k) {  // patch k has chains k and k + 1 among its sides, at this vertex
            const Index p = corner.patches[k];
            const auto sides = c.loop(c.patch_loops[p]);
            std::set<Index> chains;
            for (const PatchSide& side : sides) {
                chains.insert(side.chain);
            }
            CHECK(chains.count(corner.chains[k]) == 1);
            CHECK(chains.count(corner.chains[(k + 1) % 3]) == 1);
        }
    }
}

TEST_CASE("chains run from vertex to vertex; sides run round patches") {
    const Made m = make(tet_meshes::reference(tet_meshes::box(2, 2, 1), 2));
    const CellComplex& c = m.complex;
    for (Index i = 0; i < c.chains.size(); ++i) {
        const auto path = c.chain_path(i);
        CHECK(path.size() == 3);
        CHECK(c.node_vertex[path.front()] == c.chains[i].ends[0]);
        CHECK(c.node_vertex[path.back()] == c.chains[i].ends[1]);
        for (std::size_t k = 0; k + 1 < path.size(); ++k) {
            CHECK(c.edge_chain[m.topology.edge(path[k], path[k + 1])] == i);
        }
        CHECK(c.edge_chain[c.chains[i].edge] == i);
    }
    for (Index p = 0; p < c.patches.size(); ++p) {
        REQUIRE(c.patch_loops[p + 1] - c.patch_loops[p] == 1);
        const auto sides = c.loop(c.patch_loops[p]);
        CHECK(sides.size() == 4);
        Vec3 area = Vec3::Zero();
        for (std::size_t k = 0; k < sides.size(); ++k) {
            const Chain& chain = c.chains[sides[k].chain];
            CHECK(chain.ends[sides[k].reversed ? 1 : 0] == sides[k].vertex);
            CHECK(chain.ends[sides[k].reversed ? 0 : 1] == sides[(k + 1) % sides.size()].vertex);
            area += m.mesh.nodes[c.vertices[sides[k].vertex]].cross(
                m.mesh.nodes[c.vertices[sides[(k + 1) % sides.size()].vertex]]);
        }
        const Index f = c.patches[p];
        if (m.topology.boundary(f)) {  // counter-clockwise seen from outside
            const Vec3 middle = (m.mesh.nodes[m.topology.faces[f][0]] + m.mesh.nodes[m.topology.faces[f][1]] +
                                 m.mesh.nodes[m.topology.faces[f][2]]) /
                                3.0;
            CHECK(area.dot(middle - Vec3(1, 1, 0.5)) > 0.0);
        }
    }
}

TEST_CASE("ids start at the smallest entity, labels agree with classes") {
    const Made m = make(tet_meshes::reference(tet_meshes::box(3, 1, 1)));
    const CellComplex& c = m.complex;
    CHECK(std::is_sorted(c.vertices.begin(), c.vertices.end()));
    CHECK(std::is_sorted(c.patches.begin(), c.patches.end()));
    CHECK(std::is_sorted(c.cells.begin(), c.cells.end()));
    for (Index f = 0; f < m.topology.faces.size(); ++f) {
        CHECK((c.face_patch[f] == no_index) == (m.classes.face[f] == EntityClass::free));
    }
    for (Index e = 0; e < m.topology.edges.size(); ++e) {
        CHECK((c.edge_chain[e] == no_index) == (m.classes.edge[e] != EntityClass::stack));
    }
}

TEST_CASE("closed curves, holes in patches, whole surfaces") {
    // A box without features but a closed ring of stack edges on its top.
    const auto tets = tet_meshes::tetrahedra(tet_meshes::box(4, 4, 2));
    ReferenceMesh mesh = make_reference_mesh(tets.mesh);
    for (FeatureEdge& e : mesh.curves) {
        e.kind = CurveKind::smooth;
    }
    mesh.vertices.clear();
    const auto add = [&](Index i, Index j, Index k, Index l) {
        const auto at = [&](Index x, Index y) {
            return static_cast<Index>(
                std::find(tets.lattice.begin(), tets.lattice.end(), tet_meshes::Lattice{x, y, 2}) -
                tets.lattice.begin());
        };
        mesh.curves.push_back({{at(i, j), at(k, l)}, 0, CurveKind::end});
    };
    for (Index i = 1; i < 3; ++i) {
        add(i, 1, i + 1, 1);
        add(i, 3, i + 1, 3);
        add(1, i, 1, i + 1);
        add(3, i, 3, i + 1);
    }
    const Made m = make(mesh);
    const CellComplex& c = m.complex;
    CHECK(strata(c) == std::array<std::size_t, 4>{0, 1, 2, 1});
    CHECK(c.chains[0].ends == std::array<Index, 2>{no_index, no_index});
    CHECK(c.chain_path(0).size() == 9);
    CHECK(c.chain_path(0).front() == c.chain_path(0).back());
    for (Index p = 0; p < 2; ++p) {
        REQUIRE(c.patch_loops[p + 1] - c.patch_loops[p] == 1);
        REQUIRE(c.loop(c.patch_loops[p]).size() == 1);
        CHECK(c.loop(c.patch_loops[p])[0].vertex == no_index);
        CHECK(c.loop(c.patch_loops[p])[0].chain == 0);
    }
    CHECK(c.loop(0)[0].reversed != c.loop(1)[0].reversed);
    CHECK(c.corners.empty());
    // Without the ring the boundary is one patch without a rim.
    mesh.curves.clear();
    const Made bare = make(mesh);
    CHECK(strata(bare.complex) == std::array<std::size_t, 4>{0, 0, 1, 1});
    CHECK(bare.complex.patch_loops == std::vector<Index>{0, 0});
}

TEST_CASE("threads and foreign meshes give the same") {
    const Made m = make(tet_meshes::reference(tet_meshes::box(3, 2, 2), 4));
    for (const unsigned threads : {2U, 3U}) {
        const CellComplex other = cell_complex(archetype::Tets(m.mesh), m.topology, m.classes, Execution{threads});
        CHECK(other.tet_cell == m.complex.tet_cell);
        CHECK(other.face_patch == m.complex.face_patch);
        CHECK(other.edge_chain == m.complex.edge_chain);
        CHECK(other.corners == m.complex.corners);
        CHECK(other.patch_sides == m.complex.patch_sides);
        CHECK(other.chains == m.complex.chains);
    }
}
