#include "support/catch.hpp"
#include "support/tet_meshes.hpp"

#include <pavior/mesh/verify_tets.hpp>

#include <limits>

using namespace pavior;

namespace {
TetMesh box() { return tet_meshes::tetrahedra(tet_meshes::box(2, 2, 1)).mesh; }
bool only(const TetReport& report, MeshFault fault, const Error::Ids& ids) {
    return report.findings().size() == 1 && report.first()->fault == fault && report.first()->ids == ids;
}
}  // namespace

TEST_CASE("a sound mesh, ours and foreign") {
    const TetReport report = verify_tets(box());
    INFO(report.text());
    CHECK(report.ok());
    CHECK(report.volume == Approx(4.0));
    CHECK(report.min_volume == Approx(1.0 / 6.0));
    CHECK(report.boundary_faces == 32);
    CHECK(report.inner_faces == 32);
    CHECK(verify_tets(archetype::Tets(tet_meshes::reference(tet_meshes::box(2, 1, 1)))).ok());
}

TEST_CASE("each fault") {
    CHECK(only(verify_tets(TetMesh{}), MeshFault::empty, {}));
    TetMesh mesh = box();
    mesh.tets.push_back({0, 1, 2, 99});
    CHECK(only(verify_tets(mesh), MeshFault::id_out_of_range, {24}));
    mesh.tets.back() = {0, 1, 2, 0};
    CHECK(only(verify_tets(mesh), MeshFault::repeated_node, {24}));
    mesh = box();
    mesh.nodes.push_back(Vec3(8, 8, 8));
    CHECK(only(verify_tets(mesh), MeshFault::unused_node, {18}));
    CHECK(verify_tets(mesh, {16, true}).ok());
    mesh = box();
    std::swap(mesh.tets[7][0], mesh.tets[7][1]);
    const TetReport inverted = verify_tets(mesh);
    CHECK(inverted.find(MeshFault::inverted)->ids == Error::Ids{7});
    CHECK(inverted.count(MeshFault::same_sense) > 0);
    CHECK(inverted.min_volume < 0.0);
    mesh = box();
    mesh.tets.push_back(mesh.tets[3]);
    const TetReport twice = verify_tets(mesh);
    CHECK(twice.count(MeshFault::overused) + twice.count(MeshFault::same_sense) == 4);
    mesh = box();
    mesh.nodes[0].x() = std::numeric_limits<double>::quiet_NaN();
    CHECK(verify_tets(mesh).find(MeshFault::not_finite)->ids == Error::Ids{0});
    CHECK(std::isnan(verify_tets(mesh).volume));
}

TEST_CASE("two tetrahedra on one side of their triangle") {
    TetMesh mesh{{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1), Vec3(0.1, 0.1, 2)}, {}};
    mesh.tets = {{0, 1, 2, 3}, {0, 1, 2, 4}};
    CHECK(only(verify_tets(mesh), MeshFault::same_sense, {0, 1, 2}));
}
