#include "support/catch.hpp"
#include "support/tet_meshes.hpp"

#include <pavior/marking/faces.hpp>

using namespace pavior;

namespace {

/// A box of 2 x 1 x 1 cubes and the sheet x = 1 of its lattice.
struct Halves {
    CutMesh cut{tet_meshes::reference(tet_meshes::box(2, 1, 1), 1, false), {}, {}};
    SheetCut sheet;
    Halves() {
        for (const Vec3& x : cut.mesh.nodes) {
            sheet.values.push_back(x[0] - 1);
        }
        sheet.fixed.assign(cut.mesh.nodes.size(), 0);
        cut.marks.assign(cut.mesh.tets.size(), 0);
    }
};

}  // namespace

TEST_CASE("the faces of a sheet lie between its two sides") {
    const Halves halves;
    const std::vector<SheetFace> faces = sheet_faces(halves.cut.mesh, halves.sheet);
    REQUIRE(faces.size() == 2);
    for (const SheetFace& face : faces) {
        for (const Index i : face.nodes) {
            CHECK(halves.cut.mesh.nodes[i][0] == 1.0);
        }
        for (const std::size_t side : {std::size_t{0}, std::size_t{1}}) {
            double sum = 0;
            for (const Index i : halves.cut.mesh.tets[face.tets[side]]) {
                sum += halves.sheet.values[i];
            }
            CHECK((side == 0 ? sum < 0 : sum > 0));
        }
    }
}

TEST_CASE("only components with a start are kept, and no face twice") {
    Halves halves;
    const std::vector<SheetFace> faces = sheet_faces(halves.cut.mesh, halves.sheet);
    CHECK(detail::keep_started(halves.cut, halves.sheet, faces).empty());
    halves.sheet.start_marks = true;
    halves.cut.marks[faces[0].tets[1]] = 1;
    const std::vector<SheetFace> kept = detail::keep_started(halves.cut, halves.sheet, faces);
    CHECK(kept.size() == 2);  // the two triangles share an edge inside
    CHECK(detail::add_layers(halves.cut, kept, 3) == 2);
    CHECK(detail::add_layers(halves.cut, kept, 4) == 0);
    CHECK(halves.cut.layer_sheets == std::vector<Index>{3, 3});
}
