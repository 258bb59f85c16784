#include "support/catch.hpp"
#include "support/extruded_cases.hpp"
#include "support/occ_solids.hpp"
#include "support/test_brep.hpp"

#include <pavior/brep/neighbour_boundary.hpp>
#include <pavior/cad/region_quads.hpp>
#include <pavior/many_to_many/multi_sweep_model.hpp>
#include <pavior/mesh/verify_hexes.hpp>

using namespace pavior;
using namespace pavior::test;

namespace {

BestMultiSweep best(const TestBrep& b, double size) {
    MultiSweepOptions options;
    options.size = size;
    return best_multi_sweep(b, all_solids(b), options, imprint, solved, GmshRegionMesher{}, [] { return false; });
}

/// The quads of each face lie on it, about its own normal.
void verify_faces(const TestBrep& b, const MultiSweptModel& model) {
    for (std::size_t q = 0; q < model.quads.size(); ++q) {
        const FaceId face = model.quad_face[q];
        std::array<Vec3, 4> x;
        for (std::size_t k = 0; k < 4; ++k) {
            x[k] = model.mesh.nodes[model.quads[q][k]];
            CHECK((b.face_point(face, b.closest_on_face(face, x[k])) - x[k]).norm() < 1e-9);
        }
        const auto [du, dv] = b.face_derivatives(face, b.closest_on_face(face, x[0]));
        CHECK((x[2] - x[0]).cross(x[3] - x[1]).dot(du.cross(dv)) > 0);
    }
}

}  // namespace

TEST_CASE("a boss on a box: valid, exact, groups kept") {
    TestBrep b;
    add_boss(b);
    const BestMultiSweep result = best(b, 0.5);
    REQUIRE(result.mesh);
    const HexReport report =
        verify_hexes(result.mesh->mesh, std::span<const QuadCorners>(result.mesh->quads), VerifyHexesOptions{});
    CHECK(report.volume == Approx(10).epsilon(1e-13));
    CHECK(verify_hexes(result.mesh->mesh).ok());
    CHECK(report.boundary_quads == result.mesh->quads.size());
    verify_faces(b, *result.mesh);
    for (std::size_t f = 0; f < b.face_count(); ++f) {
        CHECK(std::count(result.mesh->quad_face.begin(), result.mesh->quad_face.end(),
                         FaceId{static_cast<std::int32_t>(f)}) > 0);
    }
    CHECK(result.attempts.size() == 1);
}

TEST_CASE("a pipe keeps its cylinders") {
    TestBrep b;
    add_cylinder(b, 2, 2, 3, 1);
    const BestMultiSweep result = best(b, 0.5);
    REQUIRE(result.mesh);
    CHECK(verify_hexes(result.mesh->mesh).ok());
    verify_faces(b, *result.mesh);
    CHECK(result.mesh->path.direction == Vec3::UnitZ());
}

TEST_CASE("solids that share faces are meshed as one, the faces between them once") {
    TestBrep b;
    add_box_row(b, {0, 1, 2.5, 3});
    const BestMultiSweep result = best(b, 0.5);
    REQUIRE(result.mesh);
    CHECK(verify_hexes(result.mesh->mesh).ok());
    CHECK(verify_hexes(result.mesh->mesh).volume == Approx(3));
    CHECK(std::count(result.mesh->quad_face.begin(), result.mesh->quad_face.end(), FaceId{1}) == 4);
    for (std::int32_t s = 0; s < 3; ++s) {
        CHECK(std::count(result.mesh->hex_solid.begin(), result.mesh->hex_solid.end(), SolidId{s}) > 0);
    }
}

TEST_CASE("what is no extrusion is refused with its faces, and a lost attempt says why") {
    TestBrep cone;
    add_cylinder(cone, 1, 0.9, 2);
    CHECK_THROWS_AS(best(cone, 0.5), UnmeshableError);
    TestBrep pyramid;  // its caps meet in a sharp edge all round
    add_pyramid(pyramid);
    const BestMultiSweep result = best(pyramid, 0.5);
    CHECK_FALSE(result.mesh);
    REQUIRE_FALSE(result.attempts.empty());
    CHECK_FALSE(result.attempts[0].error.empty());
    CHECK_FALSE(result.attempts[0].tags.empty());
}

TEST_CASE("the nodes of a neighbour are kept, on a cap and on a side, whatever the own size") {
    TestBrep b;
    add_box_row(b, {0, 1, 2.5});
    const std::array<SolidId, 1> done{SolidId{0}}, next{SolidId{1}};
    const auto swept = [&](const std::array<SolidId, 1>& solid, const Vec3& direction, double size,
                           const BoundaryMesh* given) {
        MultiSweepOptions options;
        options.size = size;
        return multi_sweep_model(b, solid, extrusion_along(b, solid, direction), options, imprint, solved,
                                 GmshRegionMesher{}, {}, given);
    };
    for (const Vec3& before : {Vec3::UnitX().eval(), Vec3::UnitY().eval(), Vec3::UnitZ().eval()}) {
        const MultiSweptModel first = swept(done, before, 0.21, nullptr);
        const BoundaryMesh given = neighbour_boundary(b, first.mesh.nodes, first.quads, first.quad_face,
                                                      detail::faces_of(b, std::span<const SolidId>(done)));
        for (const Vec3& after : {Vec3::UnitX().eval(), Vec3::UnitY().eval(), Vec3::UnitZ().eval()}) {
            const MultiSweptModel second = swept(next, after, 0.5, &given);
            SolidsMesh all = first;
            join_solids(second, given_nodes(b, next, second, given), given, all);
            const HexReport report = verify_hexes(all.mesh);
            INFO(report.text());
            CHECK(report.ok());
            CHECK(report.volume == Approx(2.5));
            CHECK(all.mesh.nodes.size() == first.mesh.nodes.size() + second.mesh.nodes.size() - 36);
        }
    }
}
