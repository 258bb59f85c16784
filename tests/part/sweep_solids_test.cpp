#include "support/catch.hpp"
#include "support/grid_cap.hpp"
#include "support/test_brep.hpp"

#include <pavior/glpk/solve_program.hpp>
#include <pavior/mesh/mesh_check.hpp>
#include <pavior/part/sweep_solids.hpp>

using namespace pavior;
using namespace pavior::test;

namespace {

SweptSolids swept(const TestBrep& b, const std::vector<SolidId>& solids, const SweepSolidsOptions& options) {
    return sweep_solids(b, solids, options, GlpkSolver{}, GridCap<TestBrep>{&b});
}

SweepSolidsOptions with_size(double size) {
    SweepSolidsOptions options;
    options.intervals.size = size;
    return options;
}

}  // namespace

TEST_CASE("A row of boxes is swept as one conforming mesh") {
    TestBrep b;
    const std::vector<SolidId> solids = add_box_row(b, {0, 1, 3});
    const SweptSolids result = swept(b, solids, with_size(0.5));
    const MeshCheck check = check_mesh(result.mesh.mesh);
    CHECK(check.valid());
    CHECK(check.verify.volume == Approx(3));
    CHECK(result.warnings.empty());
    CHECK(result.mesh.solids.size() == 2);
}

TEST_CASE("Caps are those asked for, and faces that do not exist are refused") {
    TestBrep b;
    const std::vector<SolidId> solids{add_prism(b, rectangle(1, 2), 0, 3)};
    for (const OrientedFace& f : b.solid_faces(solids[0])) {
        SweepSolidsOptions options = with_size(0.5);
        options.source = b.tag(2, f.face.index());
        const SweptSolids from = swept(b, solids, options);
        CHECK(from.mesh.solids[0].source == f.face);
        options.target = options.source;
        options.source.reset();
        CHECK(swept(b, solids, options).mesh.solids[0].target == f.face);
        options.source = b.tag(2, from.mesh.solids[0].target.index());
        const SweptSolids both = swept(b, solids, options);
        CHECK(both.mesh.solids[0].target == f.face);
        CHECK(both.mesh.solids[0].source == from.mesh.solids[0].target);
    }
    SweepSolidsOptions options = with_size(0.5);
    options.target = 12345;
    CHECK_THROWS_AS(swept(b, solids, options), InputError);
}

TEST_CASE("A face that is no cap of any sweep is named") {
    TestBrep b;
    const std::vector<SolidId> solids{add_cylinder(b, 1, 1, 2)};
    SweepSolidsOptions options = with_size(0.5);
    const SweptSolids free = swept(b, solids, options);
    for (const OrientedFace& f : b.solid_faces(solids[0])) {
        if (f.face != free.mesh.solids[0].source && f.face != free.mesh.solids[0].target) {
            options.source = b.tag(2, f.face.index());
            try {
                (void)swept(b, solids, options);
                FAIL("the wall of a cylinder is no cap");
            } catch (const UnmeshableError& error) {
                CHECK(error.ids() == Error::Ids{*options.source});
            }
        }
    }
    CHECK(options.source.has_value());
}
