#include "support/catch.hpp"
#include "support/tet_meshes.hpp"

#include <pavior/dual/tet_topology.hpp>
#include <pavior/marking/cut.hpp>
#include <pavior/mesh/verify_tets.hpp>

#include <cmath>

using namespace pavior;

namespace {

CutMesh box() { return {tet_meshes::reference(tet_meshes::box(2, 2, 2), 1, false), {}, {}}; }

/// A sheet that may start anywhere.
SheetCut sheet_of(CutMesh& cut, std::function<double(const Vec3&)> field, bool curved) {
    SheetCut sheet;
    sheet.field = std::move(field);
    sheet.curved = curved;
    sheet.tolerance = 1e-9;
    for (const Vec3& x : cut.mesh.nodes) {
        const double v = sheet.field(x);
        sheet.values.push_back(std::abs(v) <= sheet.tolerance ? 0.0 : v);
    }
    sheet.fixed.assign(cut.mesh.nodes.size(), 0);
    cut.marks.assign(cut.mesh.tets.size(), 1);
    sheet.start_marks = true;
    return sheet;
}

double layer_area(const ReferenceMesh& mesh) {
    double sum = 0;
    for (const TriCorners& f : mesh.layers) {
        sum += 0.5 * (mesh.nodes[f[1]] - mesh.nodes[f[0]]).cross(mesh.nodes[f[2]] - mesh.nodes[f[0]]).norm();
    }
    return sum;
}

}  // namespace

TEST_CASE("a plane cuts a box into two: the layers are the section, whole and once") {
    for (const Vec3& normal : {Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(3, -1, 2)}) {
        CutMesh cut = box();
        const Vec3 n = normal.normalized();
        SheetCut sheet = sheet_of(
            cut, [n](const Vec3& x) { return n.dot(x - Vec3(0.9, 1.05, 1.1)); }, false);
        const std::size_t added = cut_sheet(cut, sheet, 4);
        CHECK(added == cut.mesh.layers.size());
        CHECK(cut.layer_sheets == std::vector<Index>(added, 4));
        const TetReport report = verify_tets(cut.mesh);
        CHECK(report.ok());
        CHECK(report.volume == Approx(8.0).epsilon(1e-12));
        for (const TriCorners& f : cut.mesh.layers) {
            for (const Index i : f) {
                CHECK(std::abs(n.dot(cut.mesh.nodes[i] - Vec3(0.9, 1.05, 1.1))) < 1e-8);
            }
        }
        if (normal == Vec3(1, 0, 0)) {
            CHECK(layer_area(cut.mesh) == Approx(4.0).epsilon(1e-9));
        }
        for (const auto& tet : cut.mesh.tets) {  // no tetrahedron lies on both sides
            double low = 0;
            double high = 0;
            for (const Index i : tet) {
                low = std::min(low, n.dot(cut.mesh.nodes[i] - Vec3(0.9, 1.05, 1.1)));
                high = std::max(high, n.dot(cut.mesh.nodes[i] - Vec3(0.9, 1.05, 1.1)));
            }
            CHECK(std::min(-low, high) < 1e-8);
        }
    }
}

TEST_CASE("a plane along the faces of the mesh bisects nothing") {
    CutMesh cut = box();
    const std::size_t tets = cut.mesh.tets.size();
    SheetCut sheet = sheet_of(
        cut, [](const Vec3& x) { return x[2] - 1; }, false);
    CHECK(cut_sheet(cut, sheet, 0) == 8);
    CHECK(cut.mesh.tets.size() == tets);
    CHECK(layer_area(cut.mesh) == Approx(4.0));
    SheetCut again = sheet_of(
        cut, [](const Vec3& x) { return x[2] - 1; }, false);
    CHECK(cut_sheet(cut, again, 1) == 0);
}

TEST_CASE("a curved sheet that passes between the nodes is found") {
    CutMesh cut = box();
    const Vec3 centre(1.0, 1.0, 1.0);
    SheetCut sheet = sheet_of(
        cut, [centre](const Vec3& x) { return (x - centre).norm() - 0.45; }, true);
    CHECK(cut_sheet(cut, sheet, 0) > 20);
    CHECK(verify_tets(cut.mesh).ok());
    CHECK(layer_area(cut.mesh) == Approx(4 * 3.14159265 * 0.45 * 0.45).epsilon(0.35));
}

TEST_CASE("of two components only the one that starts is kept, and only there is cut") {
    const auto solid = tet_meshes::voxels({3, 2, 1}, [](Index i, Index j, Index) { return i != 1 || j == 0; });
    CutMesh cut{tet_meshes::reference(solid, 1, false), {}, {}};
    const auto field = [](const Vec3& x) { return x[1] - 1.5; };  // both prongs of a U
    SheetCut sheet = sheet_of(cut, field, false);
    for (const Index t : IndexRange(cut.mesh.tets.size())) {
        const Vec3& x = cut.mesh.nodes[cut.mesh.tets[t][0]];
        cut.marks[t] = x[0] < 1.5 ? 1 : 0;
    }
    CHECK(cut_sheet(cut, sheet, 0) > 0);
    for (const TriCorners& f : cut.mesh.layers) {
        CHECK(cut.mesh.nodes[f[0]][0] < 1.5);
    }
    CHECK(layer_area(cut.mesh) == Approx(1.0).epsilon(1e-9));
}

TEST_CASE("a barrier stops a sheet") {
    CutMesh cut{tet_meshes::reference(tet_meshes::box(2, 1, 1), 1, false), {}, {}};
    SheetCut sheet = sheet_of(
        cut, [](const Vec3& x) { return x[2] - x[1]; }, false);
    const TetTopology topology = tet_topology(cut.mesh);
    for (const auto& [a, b] : topology.edges) {  // the diagonal of the middle section
        const Vec3 d = cut.mesh.nodes[b] - cut.mesh.nodes[a];
        if (cut.mesh.nodes[a][0] == 1 && cut.mesh.nodes[b][0] == 1 && d[1] != 0 && d[2] != 0) {
            sheet.barriers.push_back({std::min(a, b), std::max(a, b)});
        }
    }
    REQUIRE(sheet.barriers.size() == 1);
    for (const Index t : IndexRange(cut.mesh.tets.size())) {
        double middle = 0;
        for (const Index i : cut.mesh.tets[t]) {
            middle += 0.25 * cut.mesh.nodes[i][0];
        }
        cut.marks[t] = middle < 1 ? 1 : 0;
    }
    CHECK(cut_sheet(cut, sheet, 0) == 2);
    CHECK(layer_area(cut.mesh) == Approx(std::sqrt(2.0)));
}
