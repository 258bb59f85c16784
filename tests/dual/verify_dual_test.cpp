#include "support/catch.hpp"
#include "support/tet_meshes.hpp"

#include <pavior/dual/verify_dual.hpp>

#include <algorithm>
#include <random>

using namespace pavior;
using tet_meshes::Lattice;

namespace {
// A voxel solid whose features and layers are set by lattice points.
class Solid {
public:
    explicit Solid(const tet_meshes::Voxels& voxels, Index fine = 1)
        : tets_(tet_meshes::tetrahedra(voxels, fine)),
          topology_(tet_topology(tets_.mesh)),
          mesh(make_reference_mesh(tets_.mesh, topology_)) {}

    [[nodiscard]] Index at(const Lattice& x) const {
        const auto found = std::find(tets_.lattice.begin(), tets_.lattice.end(), x);
        REQUIRE(found != tets_.lattice.end());
        return static_cast<Index>(found - tets_.lattice.begin());
    }
    // Faces for which keep(three lattice points) holds become layers.
    template <class Keep>
    void layers(const Keep& keep) {
        for (const TriCorners& c : topology_.faces) {
            if (keep(tets_.lattice[c[0]], tets_.lattice[c[1]], tets_.lattice[c[2]])) {
                mesh.layers.push_back(c);
            }
        }
    }
    void plane(std::size_t axis, Index at) { tet_meshes::add_plane(tets_, topology_, axis, at, mesh); }
    void bare() {
        mesh.curves.clear();
        mesh.vertices.clear();
    }
    void curve(const std::vector<Lattice>& path) {
        for (std::size_t i = 0; i + 1 < path.size(); ++i) {
            mesh.curves.push_back({{at(path[i]), at(path[i + 1])}, 0, CurveKind::end});
        }
    }
    void vertex(const Lattice& x) { mesh.vertices.push_back({at(x), -1}); }
    [[nodiscard]] DualReport verify() const {
        const DualReport report = verify_dual(mesh);
        UNSCOPED_INFO(report.text());
        return report;
    }

private:
    tet_meshes::VoxelTets tets_;
    TetTopology topology_;

public:
    ReferenceMesh mesh;
};
}  // namespace

TEST_CASE("valid duals") {
    CHECK(Solid(tet_meshes::box(1, 1, 1), 3).verify().valid());
    Solid cut(tet_meshes::box(2, 2, 2), 2);
    cut.plane(0, 2);
    CHECK(cut.verify().valid());
    cut.plane(1, 3);
    CHECK(cut.verify().valid());
    CHECK(verify_dual(tet_meshes::read_reference("ref_brick_table52").mesh).valid());
    CHECK(verify_dual(tet_meshes::read_reference("ref_pyramid_table58").mesh).valid());
    CHECK(verify_dual(archetype::Tets(tet_meshes::reference(tet_meshes::box(2, 1, 1)))).valid());
}

TEST_CASE("a corner that meets four chains") {
    // The pyramid without its diagonal sheets.
    tet_meshes::ReferenceFile file = tet_meshes::read_reference("ref_pyramid_table58");
    file.mesh.layers.clear();
    const DualReport report = verify_dual(file.mesh);
    CHECK(report.count(DualFault::corner_not_three_valent) > 0);
    const DualViolation& first = report.violations.front();
    CHECK(first.fault == DualFault::corner_not_three_valent);
    CHECK(first.ids[2] >= 4);
    // A vertex on a side of a box where a fourth edge ends.
    Solid solid(tet_meshes::box(2, 2, 2));
    solid.vertex({1, 2, 0});
    const DualReport kink = solid.verify();
    REQUIRE(kink.count(DualFault::corner_not_three_valent) == 1);
    CHECK(kink.violations.front().ids[2] == 2);
}

TEST_CASE("a cell that touches itself at a vertex") {
    // A vertex inside the solid, away from all layers, and one in the middle of a side.
    Solid solid(tet_meshes::box(2, 2, 2));
    solid.vertex({1, 1, 1});
    solid.vertex({1, 1, 2});
    const DualReport report = solid.verify();
    CHECK(report.count(DualFault::corner_not_disc) == 1);
    CHECK(std::any_of(report.violations.begin(), report.violations.end(),
                      [](const DualViolation& v) { return v.fault == DualFault::corner_not_disc && v.ids[2] == 0; }));
    CHECK(report.count(DualFault::corner_not_three_valent) == 1);
    CHECK(report.count(DualFault::orphan) == 2);
}

TEST_CASE("closed chains, and all that comes with a smooth cylinder") {
    Solid solid(tet_meshes::box(2, 2, 2));
    solid.bare();
    for (const Index z : {0U, 2U}) {
        solid.curve(
            {{0, 0, z}, {1, 0, z}, {2, 0, z}, {2, 1, z}, {2, 2, z}, {1, 2, z}, {0, 2, z}, {0, 1, z}, {0, 0, z}});
    }
    const DualReport report = solid.verify();
    CHECK(report.count(DualFault::chain_closed) == 2);
    CHECK(report.count(DualFault::patch_not_disc) == 1);
    CHECK(report.count(DualFault::patch_few_corners) == 3);
    CHECK(report.count(DualFault::orphan) == 6);
    CHECK(report.count(DualFault::cell_not_ball) == 0);
    CHECK(report.violations.size() == 12);
}

TEST_CASE("a chain with one vertex at both ends") {
    Solid solid(tet_meshes::box(2, 2, 2));
    solid.bare();
    solid.curve({{0, 0, 2}, {1, 0, 2}, {2, 0, 2}, {2, 1, 2}, {2, 2, 2}, {1, 2, 2}, {0, 2, 2}, {0, 1, 2}, {0, 0, 2}});
    solid.vertex({0, 0, 2});
    const DualReport report = solid.verify();
    REQUIRE(report.count(DualFault::chain_one_vertex) == 1);
    CHECK(report.count(DualFault::chain_closed) == 0);
    CHECK(report.count(DualFault::patch_few_corners) == 2);
    CHECK(report.count(DualFault::corner_not_three_valent) == 1);
}

TEST_CASE("a chain that ends nowhere") {
    Solid solid(tet_meshes::box(2, 2, 2));
    solid.curve({{0, 1, 2}, {1, 1, 2}});
    const DualReport report = solid.verify();
    REQUIRE(report.count(DualFault::chain_dangling) == 1);
    CHECK(report.count(DualFault::patch_touches_along_chain) == 1);
    const auto at = std::find_if(report.violations.begin(), report.violations.end(),
                                 [](const DualViolation& v) { return v.fault == DualFault::chain_dangling; });
    CHECK(at->ids[1] == solid.at({1, 1, 2}));
    CHECK(report.count(DualFault::pinched_node) == 0);
}

TEST_CASE("patches that are no discs: with a hole, without a rim") {
    Solid hole(tet_meshes::box(4, 4, 1));  // a ring of chains and vertices in the middle of the top
    const std::vector<Lattice> ring{{1, 1, 1}, {2, 1, 1}, {3, 1, 1}, {3, 2, 1}, {3, 3, 1},
                                    {2, 3, 1}, {1, 3, 1}, {1, 2, 1}, {1, 1, 1}};
    hole.curve(ring);
    for (const std::size_t k : {0U, 2U, 4U, 6U}) {
        hole.vertex(ring[k]);
    }
    const DualReport report = hole.verify();
    REQUIRE(report.count(DualFault::patch_not_disc) == 1);
    const auto at = std::find_if(report.violations.begin(), report.violations.end(),
                                 [](const DualViolation& v) { return v.fault == DualFault::patch_not_disc; });
    CHECK(at->ids[1] == 2);
    CHECK(report.count(DualFault::patch_few_corners) == 0);
    Solid ball(tet_meshes::box(2, 2, 2));
    ball.bare();
    const DualReport smooth = ball.verify();
    CHECK(smooth.count(DualFault::patch_not_disc) == 1);
    CHECK(smooth.count(DualFault::patch_few_corners) == 1);
    CHECK(smooth.count(DualFault::orphan) == 2);
    CHECK(smooth.violations.size() == 4);
}

TEST_CASE("a patch with two corners") {
    Solid solid(tet_meshes::box(4, 4, 1));  // an eye on the top, cut off with its wall
    const std::vector<Lattice> upper{{1, 2, 1}, {1, 3, 1}, {2, 3, 1}, {3, 3, 1}, {3, 2, 1}};
    const std::vector<Lattice> lower{{1, 2, 1}, {1, 1, 1}, {2, 1, 1}, {3, 1, 1}, {3, 2, 1}};
    solid.curve(upper);
    solid.curve(lower);
    solid.vertex(upper.front());
    solid.vertex(upper.back());
    const DualReport report = solid.verify();
    const auto at = std::find_if(report.violations.begin(), report.violations.end(),
                                 [](const DualViolation& v) { return v.fault == DualFault::patch_few_corners; });
    REQUIRE(report.count(DualFault::patch_few_corners) == 1);
    CHECK(at->ids[1] == 2);
}

TEST_CASE("a patch on both sides of a chain") {
    Solid solid(tet_meshes::box(2, 2, 2));  // a line from one edge of the top into its middle, with vertices
    solid.curve({{0, 1, 2}, {1, 1, 2}});
    solid.vertex({0, 1, 2});
    solid.vertex({1, 1, 2});
    const DualReport report = solid.verify();
    REQUIRE(report.count(DualFault::patch_touches_along_chain) == 1);
    CHECK(report.count(DualFault::chain_dangling) == 0);
    CHECK(report.count(DualFault::patch_touches_at_vertex) == 1);
}

TEST_CASE("a patch with one vertex at two corners, no chain in between") {
    // A square on the top that touches the rim of the top at one vertex.
    Solid solid(tet_meshes::box(2, 2, 1), 2);
    const std::vector<Lattice> small{{0, 2, 2}, {1, 3, 2}, {2, 3, 2}, {2, 2, 2}, {1, 2, 2}, {0, 2, 2}};
    const TetTopology topology = tet_topology(solid.mesh);
    const bool diagonal = topology.edge(solid.at({0, 2, 2}), solid.at({1, 3, 2})) != no_index;
    REQUIRE(diagonal);
    solid.curve(small);
    solid.vertex({0, 2, 2});
    solid.vertex({2, 3, 2});
    solid.vertex({2, 2, 2});
    const DualReport report = solid.verify();
    CHECK(report.count(DualFault::patch_touches_at_vertex) == 1);
    CHECK(report.count(DualFault::patch_touches_along_chain) == 0);
}

TEST_CASE("layers that touch at a node") {
    Solid solid(tet_meshes::box(4, 4, 4));  // two inner cubes' shells that share one node
    const auto shell = [&](Index low) {
        solid.layers([&](const Lattice& a, const Lattice& b, const Lattice& c) {
            for (std::size_t axis = 0; axis < 3; ++axis) {
                if (std::min({a[axis], b[axis], c[axis]}) < low || std::max({a[axis], b[axis], c[axis]}) > low + 1) {
                    return false;
                }
            }
            for (std::size_t axis = 0; axis < 3; ++axis) {
                if (a[axis] == b[axis] && a[axis] == c[axis]) {
                    return true;
                }
            }
            return false;
        });
    };
    shell(1);
    CHECK(solid.verify().count(DualFault::pinched_node) == 0);
    shell(2);
    const DualReport report = solid.verify();
    REQUIRE(report.count(DualFault::pinched_node) == 1);
    const auto at = std::find_if(report.violations.begin(), report.violations.end(),
                                 [](const DualViolation& v) { return v.fault == DualFault::pinched_node; });
    CHECK(at->ids[0] == solid.at({2, 2, 2}));
}

TEST_CASE("a cube cut off at an edge of the box: its sheet does not know the kinks between its sides") {
    Solid solid(tet_meshes::box(3, 3, 3));
    solid.layers([&](const Lattice& a, const Lattice& b, const Lattice& c) {
        const auto in = [](const Lattice& x) { return x[0] <= 1 && x[1] <= 1 && x[2] >= 1 && x[2] <= 2; };
        if (!in(a) || !in(b) || !in(c)) {
            return false;
        }
        for (std::size_t axis = 0; axis < 3; ++axis) {
            if (a[axis] == 1 && b[axis] == 1 && c[axis] == 1 && axis < 2) {
                return true;
            }
        }
        return a[2] == b[2] && b[2] == c[2];
    });
    const DualReport report = solid.verify();
    CHECK(report.count(DualFault::patch_few_corners) == 3);
    CHECK(report.violations.size() == 3);
}

TEST_CASE("layers that end inside") {
    Solid solid(tet_meshes::box(2, 2, 2));
    solid.layers([](const Lattice& a, const Lattice& b, const Lattice& c) {
        return a[0] == 1 && b[0] == 1 && c[0] == 1 && a[1] + b[1] + c[1] <= 2;
    });
    const DualReport report = solid.verify();
    REQUIRE(report.count(DualFault::dangling_layer) == 1);
    const auto at = std::find_if(report.violations.begin(), report.violations.end(),
                                 [](const DualViolation& v) { return v.fault == DualFault::dangling_layer; });
    CHECK(at->ids[2] == 2);
    CHECK(report.count(DualFault::cell_on_both_sides) == 1);
    CHECK(report.count(DualFault::pinched_node) == 0);
}

TEST_CASE("cells that are no balls: torus, cavity, torus with a cavity") {
    const auto ring = [](Index i, Index j, Index k) { return !(i >= 1 && i <= 1 && j == 1 && k < 9); };
    Solid torus(tet_meshes::voxels({3, 3, 1}, ring));
    const DualReport holed = torus.verify();
    CHECK(holed.count(DualFault::cell_not_ball) == 1);
    CHECK(holed.count(DualFault::patch_not_disc) == 2);
    Solid cavity(tet_meshes::voxels({3, 3, 3}, [](Index i, Index j, Index k) { return i != 1 || j != 1 || k != 1; }));
    const DualReport hollow = cavity.verify();
    CHECK(hollow.count(DualFault::cell_not_ball) == 1);
    CHECK(hollow.violations.size() ==
          hollow.count(DualFault::cell_not_ball) + hollow.count(DualFault::corner_not_three_valent));
    // Characteristic -1 like a ball, but two boundary components.
    Solid both(tet_meshes::voxels(
        {5, 3, 3}, [](Index i, Index j, Index k) { return !(i == 1 && j == 1 && k == 1) && !(i == 3 && j == 1); }));
    const DualReport report = both.verify();
    CHECK(report.count(DualFault::cell_not_ball) == 1);
}

TEST_CASE("a cell on both sides of a patch") {
    // A ring cut through at one place only.
    Solid ring(tet_meshes::voxels({3, 3, 1}, [](Index i, Index j, Index) { return i != 1 || j != 1; }));
    ring.layers([](const Lattice& a, const Lattice& b, const Lattice& c) {
        return a[0] == 1 && b[0] == 1 && c[0] == 1 && a[1] <= 1 && b[1] <= 1 && c[1] <= 1;
    });
    const DualReport report = ring.verify();
    REQUIRE(report.count(DualFault::cell_on_both_sides) == 1);
    CHECK(report.count(DualFault::cell_not_ball) == 0);
}

TEST_CASE("the report is the same on a foreign mesh and does not depend on the order of tetrahedra") {
    tet_meshes::ReferenceFile file = tet_meshes::read_reference("ref_pyramid_table58");
    file.mesh.layers.resize(20);
    const DualReport report = verify_dual(file.mesh);
    CHECK(!report.valid());
    CHECK(report.violations == verify_dual(archetype::Tets(file.mesh)).violations);
    std::mt19937 random(4);
    std::shuffle(file.mesh.tets.begin(), file.mesh.tets.end(), random);
    const DualReport other = verify_dual(file.mesh);
    for (std::size_t k = 0; k < dual_fault_count; ++k) {
        CHECK(report.count(static_cast<DualFault>(k)) == other.count(static_cast<DualFault>(k)));
    }
}
