#include "support/catch.hpp"
#include "support/test_brep.hpp"

#include <pavior/one_to_one/mesh_linking_side.hpp>
#include <pavior/one_to_one/recognition.hpp>

using namespace pavior;

namespace {

/// Volume of the cone with apex 0 over the face mesh; the sign tells the orientation.
double cone_volume(const BoundaryMesh& mesh, const FaceMesh& face) {
    double volume = 0;
    for (const QuadCorners& q : face.quads) {
        const auto x = [&](std::size_t k) { return mesh.nodes[face.nodes[q[k]]]; };
        volume += (x(0).dot(x(1).cross(x(2))) + x(0).dot(x(2).cross(x(3)))) / 6;
    }
    return volume;
}

}  // namespace

TEST_CASE("a linking side is a structured mesh on its face, oriented as the face itself") {
    test::TestBrep b;
    const SolidId solid = test::add_cylinder(b, 1, 1, 2, 0.5);
    const SweepTopology sweep = sweep_between(b, solid, b.solid_faces(solid)[0].face, b.solid_faces(solid)[1].face);
    BoundaryMesh mesh = mesh_edges(b, std::vector<int>(b.edge_count(), 6));
    for (const auto& loop : sweep.loops) {
        for (const LinkingSide& side : loop) {
            const LinkingFaceReport report = mesh_linking_side(b, mesh, side, true);
            CHECK(report.folded.empty());
            const FaceMesh& face = mesh.faces[side.face.index()];
            CHECK(face.columns == 6);
            CHECK(face.rows == 6);
            REQUIRE(face.quads.size() == 36);
            for (std::size_t i = 0; i < face.nodes.size(); ++i) {
                CHECK((b.face_point(side.face, face.uv[i]) - mesh.nodes[face.nodes[i]]).norm() < 1e-12);
            }
            const double radius = side.outward ? 1.0 : 0.5;  // the inner wall's own normal points away from the axis
            CHECK(cone_volume(mesh, face) ==
                  Approx(0.5 * 6 * radius * radius * std::sin(std::numbers::pi / 3) * 2 * 2 / 3));
        }
    }
    CHECK(mesh.nodes.size() == 4 + 4 * 5 + 2 * 5 + 2 * 25);
}
