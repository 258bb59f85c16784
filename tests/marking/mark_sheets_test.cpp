#include "support/catch.hpp"
#include "support/tet_meshes.hpp"

#include <pavior/dual/verify_dual.hpp>
#include <pavior/marking/mark_sheets.hpp>
#include <pavior/mesh/verify_tets.hpp>

#include <Eigen/Geometry>

#include <random>

using namespace pavior;

namespace {

/// Twists the mesh so that none of its faces lies along a sheet, the boundary as it was.
ReferenceMesh rotated(ReferenceMesh mesh) {
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();
    for (Vec3& x : mesh.nodes) {
        x = turn * x + Vec3(0.3, -2, 5);
    }
    return mesh;
}

}  // namespace

TEST_CASE("random voxel solids become the blocks of their grid lines") {
    std::mt19937 random(11);
    int tried = 0;
    for (int trial = 0; trial < 25; ++trial) {
        const tet_meshes::Voxels solid = tet_meshes::random_solid({3, 2, 2}, random);
        for (const Index fine : {1U, 2U}) {
            INFO("trial " << trial << ", fine " << fine);
            const ReferenceMesh mesh = rotated(tet_meshes::reference(solid, fine, false));
            const MarkedMesh marked = mark_sheets(mesh);
            CHECK(marked.report.valid);
            CHECK(marked.report.quality > 0.3);
            CHECK(verify_tets(marked.reference).ok());
            const MarkedMesh other = mark_sheets(rotated(tet_meshes::reference(solid, fine == 1 ? 2 : 1, false)));
            CHECK(marked.report.blocks == other.report.blocks);  // whatever the reference mesh
            CHECK(marked.report.nodes == other.report.nodes);
            ++tried;
        }
    }
    CHECK(tried == 50);
}

TEST_CASE("an L is cut into three boxes, also when it is stopped at chains") {
    const auto solid = tet_meshes::voxels({2, 2, 1}, [](Index i, Index j, Index) { return i == 0 || j == 0; });
    for (const Propagation propagation : {Propagation::full, Propagation::stop}) {
        MarkingOptions options;
        options.propagation = propagation;
        const MarkedMesh marked = mark_sheets(tet_meshes::reference(solid, 1, false), options);
        CHECK(marked.report.valid);
        CHECK(marked.report.blocks == 24);
        CHECK(marked.report.nodes == 63);
        CHECK(marked.report.sheets.size() == 2);
        CHECK(marked.report.layer_sheets.size() == marked.reference.layers.size());
    }
}

TEST_CASE("an archetype, and the same bytes each time") {
    const auto solid = tet_meshes::voxels({2, 2, 2}, [](Index i, Index j, Index k) { return i + j + k < 3; });
    const ReferenceMesh mesh = tet_meshes::reference(solid, 2, false);
    const MarkedMesh a = mark_sheets(mesh);
    const MarkedMesh b = mark_sheets(archetype::Tets(mesh));
    CHECK(a.report.valid);
    CHECK(a.report.blocks == 56);
    CHECK(a.reference.tets == b.reference.tets);
    CHECK(a.reference.layers == b.reference.layers);
    CHECK(a.reference.nodes == b.reference.nodes);
}

TEST_CASE("a mesh without tetrahedra is refused") { CHECK_THROWS_AS(mark_sheets(ReferenceMesh{}), InputError); }
