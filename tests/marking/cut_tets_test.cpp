#include "support/catch.hpp"
#include "support/tet_meshes.hpp"

#include <pavior/dual/tet_topology.hpp>
#include <pavior/marking/cut_tets.hpp>
#include <pavior/mesh/verify_tets.hpp>

#include <algorithm>
#include <random>
#include <tuple>

using namespace pavior;

namespace {

double area(const std::vector<Vec3>& x, const TriCorners& f) {
    return 0.5 * (x[f[1]] - x[f[0]]).cross(x[f[2]] - x[f[0]]).norm();
}

double area_of_patches(const ReferenceMesh& mesh) {
    double sum = 0;
    for (const TaggedTriangle& f : mesh.patches) {
        sum += area(mesh.nodes, f.nodes);
    }
    return sum;
}

double length_of_curves(const ReferenceMesh& mesh) {
    double sum = 0;
    for (const FeatureEdge& e : mesh.curves) {
        sum += (mesh.nodes[e.nodes[1]] - mesh.nodes[e.nodes[0]]).norm();
    }
    return sum;
}

CutMesh corner_solid() {
    const auto solid = tet_meshes::voxels({2, 2, 1}, [](Index i, Index j, Index) { return i == 0 || j == 0; });
    CutMesh cut{tet_meshes::reference(solid), {}, {}};
    cut.layer_sheets.assign(cut.mesh.layers.size(), 3);
    for (const Index t : IndexRange(cut.mesh.tets.size())) {
        cut.marks.push_back(t % 2 == 0 ? 1 : 0);
    }
    return cut;
}

std::vector<EdgeCut> random_cuts(const ReferenceMesh& mesh, std::mt19937& random) {
    std::vector<EdgeCut> cuts;
    for (const auto& edge : tet_topology(mesh).edges) {
        if (random() % 3 == 0) {
            cuts.push_back({edge[0], edge[1], 0.1 + 0.8 * static_cast<double>(random()) / 4294967296.0});
        }
    }
    std::sort(cuts.begin(), cuts.end(),
              [](const EdgeCut& a, const EdgeCut& b) { return std::tie(a.low, a.high) < std::tie(b.low, b.high); });
    return cuts;
}

}  // namespace

TEST_CASE("bisected tetrahedra conform and fill the same solid; what lies on them is inherited") {
    std::mt19937 random(5);
    for (int trial = 0; trial < 20; ++trial) {
        INFO("trial " << trial);
        CutMesh cut = corner_solid();
        const ReferenceMesh before = cut.mesh;
        const double marked = static_cast<double>(std::count(cut.marks.begin(), cut.marks.end(), 1));
        const std::vector<EdgeCut> cuts = random_cuts(before, random);
        bisect_edges(cut, cuts);
        CHECK(cut.mesh.nodes.size() == before.nodes.size() + cuts.size());
        const TetReport report = verify_tets(cut.mesh);
        CHECK(report.ok());
        CHECK(report.volume == Approx(3.0).epsilon(1e-12));
        CHECK(area_of_patches(cut.mesh) == Approx(area_of_patches(before)).epsilon(1e-12));
        CHECK(length_of_curves(cut.mesh) == Approx(length_of_curves(before)).epsilon(1e-12));
        const TetTopology topology = tet_topology(cut.mesh);
        for (const TaggedTriangle& f : cut.mesh.patches) {
            const Index id = topology.face(f.nodes);
            REQUIRE(id != no_index);
            CHECK(topology.boundary(id));
        }
        double layers = 0;
        for (const TriCorners& f : cut.mesh.layers) {
            REQUIRE(topology.face(f) != no_index);
            layers += area(cut.mesh.nodes, f);
        }
        CHECK(layers == Approx(2.0).epsilon(1e-12));
        CHECK(cut.layer_sheets == std::vector<Index>(cut.mesh.layers.size(), 3));
        REQUIRE(cut.marks.size() == cut.mesh.tets.size());
        double volume = 0;
        for (const Index t : IndexRange(cut.mesh.tets.size())) {
            const auto& [a, b, c, d] = cut.mesh.tets[t];
            const auto& x = cut.mesh.nodes;
            volume += cut.marks[t] == 0 ? 0 : (x[b] - x[a]).cross(x[c] - x[a]).dot(x[d] - x[a]) / 6;
        }
        CHECK(volume == Approx(marked / 6).epsilon(1e-12));  // every tetrahedron of the solid has a sixth of a box
    }
}

TEST_CASE("without cuts nothing changes") {
    CutMesh cut = corner_solid();
    const ReferenceMesh before = cut.mesh;
    bisect_edges(cut, {});
    CHECK(cut.mesh.tets == before.tets);
    CHECK(cut.mesh.layers == before.layers);
}
