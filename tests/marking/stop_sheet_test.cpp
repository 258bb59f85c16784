#include "support/catch.hpp"
#include "support/tet_meshes.hpp"

#include <pavior/dual/cell_complex.hpp>
#include <pavior/marking/cell_snapshot.hpp>
#include <pavior/marking/fit_surface.hpp>
#include <pavior/marking/mark_sheets.hpp>
#include <pavior/marking/stop_sheet.hpp>
#include <pavior/mesh/verify_tets.hpp>

#include <cmath>
#include <random>

using namespace pavior;

namespace {

/// The plane with this normal through a point, which may start anywhere where `starts` holds at the centroid.
template <class Starts>
SheetCut plane_sheet(CutMesh& cut, const Vec3& normal, const Vec3& point, const Starts& starts) {
    SheetCut sheet;
    const Vec3 n = normal.normalized();
    sheet.field = [n, point](const Vec3& x) { return n.dot(x - point); };
    sheet.tolerance = 1e-9;
    for (const Vec3& x : cut.mesh.nodes) {
        const double v = sheet.field(x);
        sheet.values.push_back(std::abs(v) <= sheet.tolerance ? 0.0 : v);
    }
    sheet.fixed.assign(cut.mesh.nodes.size(), 0);
    cut.marks.clear();
    for (const TetCorners& t : cut.mesh.tets) {
        const Vec3 centre =
            0.25 * (cut.mesh.nodes[t[0]] + cut.mesh.nodes[t[1]] + cut.mesh.nodes[t[2]] + cut.mesh.nodes[t[3]]);
        cut.marks.push_back(starts(centre) ? 1 : 0);
    }
    sheet.start_marks = true;
    return sheet;
}

/// A cube of 2 x 2 x 1 boxes cut by x = 1 and y = 1.
CutMesh crossed() {
    CutMesh cut{tet_meshes::reference(tet_meshes::box(2, 2, 1)), {}, {}};
    cut.layer_sheets.assign(cut.mesh.layers.size(), 0);
    return cut;
}

}  // namespace

TEST_CASE("stack edges are those of features and of crossing layers") {
    const ReferenceMesh mesh = tet_meshes::reference(tet_meshes::box(2, 2, 1));
    CHECK(stack_edges(mesh).size() == 2 * 12 + 9);
}

TEST_CASE("a diagonal sheet stops at the chain in the middle of a cube, or runs through") {
    const auto low = [](const Vec3& x) { return x[0] < 1 && x[1] < 1; };
    for (const Propagation propagation : {Propagation::full, Propagation::stop}) {
        CutMesh cut = crossed();
        SheetCut sheet = plane_sheet(cut, Vec3(1, -1, 0), Vec3(1, 1, 0), low);
        const std::size_t added = cut_sheet(cut, sheet, 1, propagation);
        double area = 0;
        for (std::size_t k = cut.mesh.layers.size() - added; k < cut.mesh.layers.size(); ++k) {
            const TriCorners& f = cut.mesh.layers[k];
            const Vec3& x = cut.mesh.nodes[f[0]];
            area += 0.5 * (cut.mesh.nodes[f[1]] - x).cross(cut.mesh.nodes[f[2]] - x).norm();
        }
        CHECK(area == Approx((propagation == Propagation::full ? 2 : 1) * std::sqrt(2.0)).epsilon(1e-9));
        CHECK(cell_snapshot(cut.mesh).report.valid());
        CHECK(verify_tets(cut.mesh).ok());
    }
}

TEST_CASE("a sheet that cannot end at chains only runs through") {
    CutMesh cut = crossed();  // no chain lies on this plane: it is as whole as without the wish to stop
    SheetCut sheet = plane_sheet(cut, Vec3(1, -1, 0), Vec3(1, 0.7, 0), [](const Vec3&) { return true; });
    CutMesh other = crossed();
    SheetCut same = plane_sheet(other, Vec3(1, -1, 0), Vec3(1, 0.7, 0), [](const Vec3&) { return true; });
    CHECK(cut_sheet(cut, sheet, 1, Propagation::stop) == cut_sheet(other, same, 1, Propagation::full));
    CHECK(cut.mesh.layers == other.mesh.layers);
    CHECK(cut.layer_sheets == other.layer_sheets);
}

TEST_CASE("stopped sheets make valid blocks, and fewer than whole ones where they can") {
    std::mt19937 random(5);
    for (int trial = 0; trial < 30; ++trial) {
        INFO("trial " << trial);
        const ReferenceMesh mesh = tet_meshes::reference(tet_meshes::random_solid({3, 2, 2}, random), 1, false);
        const MarkingOptions options;
        const detail::SheetMarker marker(mesh, options);
        const MarkedMesh full = detail::mark_best(marker, Propagation::full, {});
        const MarkedMesh stop = detail::mark_best(marker, Propagation::stop, {});
        CHECK(stop.report.valid);
        CHECK(stop.report.quality > 0);
        CHECK(stop.report.blocks == full.report.blocks);  // planes that only cross cannot end
        CHECK(verify_tets(stop.reference).ok());
    }
    for (int trial = 0; trial < 5; ++trial) {  // a pyramid on a box: the plane that splits its apex ends under it
        INFO("pyramid " << trial);
        ReferenceMesh mesh = tet_meshes::read_reference("ref_pyramid_table58").mesh;
        mesh.layers.clear();
        const auto dice = [&] { return static_cast<double>(random() % 1001) / 1000 - 0.5; };
        const Vec3 stretch(1 + dice(), 1 + dice(), 1 + dice());
        const double shear = 0.5 * dice();
        for (Vec3& x : mesh.nodes) {
            x = x.cwiseProduct(stretch) + Vec3(shear * x[2], 0, 0);
        }
        MarkingOptions options;
        CHECK(mark_sheets(mesh, options).report.blocks == 92);
        options.propagation = Propagation::stop;
        const MarkedMesh stop = mark_sheets(mesh, options);
        CHECK(stop.report.valid);
        CHECK(stop.report.quality > 0);
        CHECK(stop.report.blocks == 84);
        CHECK(stop.report.nodes == 165);
        CHECK(verify_tets(stop.reference).ok());
    }
}
