#include "support/catch.hpp"
#include "support/random_solids.hpp"
#include "support/tet_meshes.hpp"

#include <pavior/dual/verify_dual.hpp>
#include <pavior/marking/mark_sheets.hpp>
#include <pavior/mesh/verify_tets.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <random>
#include <vector>

using namespace pavior;

namespace {

ReferenceMesh rotated(ReferenceMesh mesh) {
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();
    for (Vec3& x : mesh.nodes) {
        x = turn * x + Vec3(0.3, -2, 5);
    }
    return mesh;
}

/// True if the solid looks the same on both sides of a lattice point along an axis, so that a node there may slide.
bool slides(const tet_meshes::Voxels& solid, Index fine, const tet_meshes::Lattice& x, std::size_t axis) {
    const auto inside = [&](int n) {
        std::array<int, 3> voxel{};
        for (std::size_t a = 0; a < 3; ++a) {
            const int box = static_cast<int>(x[a]) - (n >> a & 1);
            voxel[a] = box < 0 ? -1 : box / static_cast<int>(fine);
        }
        return solid(voxel[0], voxel[1], voxel[2]);
    };
    bool same = true;
    for (int n = 0; n < 8; ++n) {
        same = same && inside(n) == inside(n ^ (1 << axis));
    }
    return same;
}

/// A mesh of the solid whose nodes have left the lattice where the boundary leaves them free, so that the faces of the
/// tetrahedra run across the sheets; rotated.
ReferenceMesh warped(const tet_meshes::Voxels& solid, Index fine, std::mt19937& random) {
    tet_meshes::VoxelTets tets = tet_meshes::tetrahedra(solid, fine);
    for (std::size_t n = 0; n < tets.lattice.size(); ++n) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            if (slides(solid, fine, tets.lattice[n], axis)) {
                const double shift = static_cast<double>(random() % 1001) / 500 - 1;
                tets.mesh.nodes[n][static_cast<Eigen::Index>(axis)] += 0.15 * shift / fine;
            }
        }
    }
    return rotated(make_reference_mesh(tets.mesh));
}

/// The blocks and block nodes of a voxel solid, counted on its lattice.
test::BlockCount counted(const tet_meshes::Voxels& solid) {
    test::VoxelSolid same;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        same.size[axis] = static_cast<int>(solid.size[axis]);
        for (int i = 0; i <= same.size[axis]; ++i) {
            same.lines[axis].push_back(i);
        }
    }
    same.filled = solid.inside;
    return test::count_blocks(same);
}

/// A pyramid on a box, whose apex has four curves: sheets alone leave it invalid.
ReferenceMesh pyramid() {
    ReferenceMesh mesh = tet_meshes::read_reference("ref_pyramid_table58").mesh;
    mesh.layers.clear();
    return mesh;
}

/// The pyramid on a box and its mirror image: two corners to repair.
ReferenceMesh two_pyramids() {
    const ReferenceMesh one = pyramid();
    TetMesh both{one.nodes, one.tets};
    std::vector<Index> image;
    for (const Vec3& x : one.nodes) {
        image.push_back(x[2] == 0 ? static_cast<Index>(image.size()) : static_cast<Index>(both.nodes.size()));
        if (x[2] != 0) {
            both.nodes.emplace_back(x[0], x[1], -x[2]);
        }
    }
    for (const TetCorners& t : one.tets) {
        both.tets.push_back({image[t[0]], image[t[1]], image[t[3]], image[t[2]]});
    }
    return make_reference_mesh(both);
}

/// A ball, which has neither curves nor vertices.
ReferenceMesh ball() {
    auto tets = tet_meshes::tetrahedra(tet_meshes::box(1, 1, 1), 6);
    for (Vec3& x : tets.mesh.nodes) {
        const Vec3 d = 2 * x - Vec3(1, 1, 1);
        const double most = d.cwiseAbs().maxCoeff();
        x = most > 0 ? Vec3(most * d.normalized()) : d;
    }
    return make_reference_mesh(tets.mesh);
}

/// A T whose arms turn up by these angles in degrees: the undersides are planes of two sheets, or of one that bends.
ReferenceMesh tilted_t(double left, double right) {
    const auto solid = tet_meshes::voxels({3, 1, 2}, [](Index i, Index, Index k) { return i == 1 || k == 1; });
    ReferenceMesh mesh = tet_meshes::reference(solid, 1, false);
    for (Vec3& x : mesh.nodes) {
        const double angle = (x[0] < 1.5 ? left : right) * std::numbers::pi / 180;
        if (x[2] == 1 && (x[0] == 0 || x[0] == 3)) {
            x[2] += std::tan(angle);
        }
    }
    return mesh;
}

}  // namespace

TEST_CASE("random voxel solids become the blocks of their grid lines") {
    std::mt19937 random(11);
    int cut = 0;
    for (int trial = 0; trial < 25; ++trial) {
        const tet_meshes::Voxels solid = tet_meshes::random_solid({3, 2, 2}, random);
        const test::BlockCount want = counted(solid);
        for (const Index fine : {1U, 2U, 3U}) {
            INFO("trial " << trial << ", fine " << fine);
            const ReferenceMesh mesh = warped(solid, fine, random);
            REQUIRE(verify_tets(mesh).ok());
            const MarkedMesh marked = mark_sheets(mesh);
            CHECK(marked.report.valid);
            CHECK(marked.report.quality > 0.3);
            CHECK(verify_tets(marked.reference).ok());
            CHECK(marked.report.blocks == want.blocks);
            CHECK(marked.report.nodes == want.nodes);
            CHECK((marked.reference.tets.size() > mesh.tets.size()) == !marked.report.sheets.empty());
            cut += marked.report.sheets.empty() ? 0 : 1;
        }
    }
    CHECK(cut > 40);
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
        CHECK(marked.report.propagation == Propagation::full);  // stopped sheets would save no block
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

TEST_CASE("repair ends after max_rounds, or when there are max_growth times the blocks") {
    const ReferenceMesh solid = two_pyramids();
    constexpr std::array<std::size_t, 4> blocks{266, 300, 348, 416};  // after each round
    for (int most = 0; most <= 4; ++most) {
        CAPTURE(most);
        MarkingOptions options;
        options.max_rounds = most;
        const SheetReport report = mark_sheets(solid, options).report;
        CHECK(report.rounds == std::min(most, 3));
        CHECK(report.blocks == blocks[static_cast<std::size_t>(report.rounds)]);
        CHECK(report.valid == (most >= 3));
        CHECK(report.violations.empty() == report.valid);
    }
    for (std::size_t rounds = 0; rounds < 3; ++rounds) {
        for (const int above : {-1, 0}) {  // one more round while there are no more blocks than this
            CAPTURE(rounds, above);
            MarkingOptions options;
            options.max_growth = (static_cast<double>(blocks[rounds]) + above + 1e-6) / static_cast<double>(blocks[0]);
            const SheetReport report = mark_sheets(solid, options).report;
            CHECK(report.rounds == static_cast<int>(rounds) + 1 + above);
            CHECK(report.valid == (report.rounds == 3));
        }
    }
}

TEST_CASE("sheets and repair end when they have seen max_work tetrahedra") {
    const ReferenceMesh solid = two_pyramids();
    MarkingOptions options;
    const MarkedMesh all = mark_sheets(solid, options);
    options.max_work = 1e9;
    const MarkedMesh within = mark_sheets(solid, options);
    CHECK((within.reference.tets == all.reference.tets && within.reference.layers == all.reference.layers));
    CHECK(within.report.rounds == all.report.rounds);
    options.max_work = 1;
    const MarkedMesh tired = mark_sheets(solid, options);
    CHECK(tired.report.rounds == 0);
    CHECK(tired.report.tries == 1);
    CHECK_FALSE(tired.report.valid);
    CHECK_FALSE(tired.report.violations.empty());
    CHECK(tired.reference.tets.size() < all.reference.tets.size());
}

TEST_CASE("what repair leaves invalid is reported, or every face becomes a layer") {
    MarkingOptions options;
    options.max_rounds = 0;
    for (const ReferenceMesh& solid : {pyramid(), ball()}) {
        options.split_everything = false;
        const MarkedMesh left = mark_sheets(solid, options);
        CHECK_FALSE(left.report.valid);
        CHECK_FALSE(left.report.violations.empty());
        options.split_everything = true;
        const MarkedMesh split = mark_sheets(solid, options);
        const std::size_t tets = split.reference.tets.size();
        CHECK(split.report.valid);
        CHECK(split.report.violations.empty());
        CHECK(verify_tets(split.reference).ok());
        CHECK(split.reference.patches == solid.patches);
        CHECK(split.report.blocks == 4 * tets);
        CHECK(split.reference.layers.size() == (4 * tets - solid.patches.size()) / 2);
        CHECK(split.report.sheets == std::vector<Sheet>{{SheetKind::everything, {}, split.reference.layers.size()}});
        CHECK(split.report.tries == left.report.tries + 1);
        CHECK((tets == solid.tets.size()) == !solid.curves.empty());  // those with two faces on the ball are parted
    }
    options = {};
    options.split_everything = true;
    CHECK(mark_sheets(pyramid(), options).report.blocks == 92);  // repaired, so nothing is split
}

TEST_CASE("one sheet bends between fronts that see each other within blend_angle") {
    const ReferenceMesh solid = tilted_t(8, 3);
    MarkingOptions options;
    options.blend_angle = 7.5;
    const SheetReport apart = mark_sheets(solid, options).report;
    CHECK(apart.valid);
    CHECK(apart.grouping == Grouping::exact);
    CHECK(apart.tries == 1);
    CHECK(apart.sheets.size() == 4);
    CHECK(apart.blocks == 48);
    options.blend_angle = 8.5;
    const SheetReport bent = mark_sheets(solid, options).report;
    CHECK(bent.valid);
    CHECK(bent.grouping == Grouping::blended);
    CHECK(bent.tries == 2);
    CHECK(bent.sheets.size() == 3);
    CHECK(bent.blocks == 32);
    CHECK(bent.quality > 0.9);
}

TEST_CASE("a mesh without tetrahedra is refused") { CHECK_THROWS_AS(mark_sheets(ReferenceMesh{}), InputError); }
