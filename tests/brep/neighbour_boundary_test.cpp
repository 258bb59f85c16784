#include <pavior/brep/neighbour_boundary.hpp>

#include "support/catch.hpp"
#include "support/grid_cap.hpp"
#include "support/test_brep.hpp"

#include <pavior/one_to_one/recognition.hpp>
#include <pavior/one_to_one/sweep_model.hpp>

using namespace pavior;

namespace {

ModelMesh swept(const test::TestBrep& b, int n) {
    const SolidId solid{0};
    const std::vector<SweepTopology> sweeps{
        sweep_between(b, solid, b.solid_faces(solid)[0].face, b.solid_faces(solid)[1].face)};
    return sweep_model(b, sweeps, std::vector<int>(b.edge_count(), n), test::GridCap<test::TestBrep>{&b});
}

std::vector<FaceId> faces_of(const test::TestBrep& b) {
    std::vector<FaceId> faces;
    for (const OrientedFace& f : b.solid_faces(SolidId{0})) {
        faces.push_back(f.face);
    }
    return faces;
}

/// Reads the mesh of all faces back and compares it with the model.
BoundaryMesh read_back(const test::TestBrep& b, int n) {
    const ModelMesh mesh = swept(b, n);
    BoundaryMesh given = neighbour_boundary(b, mesh.mesh.nodes, mesh.quads, mesh.quad_face, faces_of(b));
    CHECK(given.nodes.size() == mesh.mesh.nodes.size());
    for (std::size_t e = 0; e < b.edge_count(); ++e) {
        const EdgeId id{static_cast<std::int32_t>(e)};
        const EdgeNodes& edge = given.edges[e];
        REQUIRE(edge.nodes.size() == static_cast<std::size_t>(n) + 1);
        CHECK(edge.nodes.front() == given.vertices[b.edge_vertices(id)[0].index()]);
        CHECK(edge.nodes.back() == given.vertices[b.edge_vertices(id)[1].index()]);
        CHECK(std::is_sorted(edge.parameters.begin(), edge.parameters.end()));
        for (std::size_t i = 0; i < edge.nodes.size(); ++i) {
            CHECK((b.edge_point(id, edge.parameters[i]) - given.nodes[edge.nodes[i]]).norm() < 1e-12);
        }
    }
    std::size_t quads = 0;
    for (const FaceId f : faces_of(b)) {
        const FaceMesh& face = given.faces[f.index()];
        CHECK(face.uv.size() == face.nodes.size());
        for (std::size_t i = 0; i < face.nodes.size(); ++i) {
            CHECK((b.face_point(f, face.uv[i]) - given.nodes[face.nodes[i]]).norm() < 1e-9);
        }
        quads += face.quads.size();
    }
    CHECK(quads == mesh.quads.size());
    return given;
}

}  // namespace

TEST_CASE("the mesh of a prism is read back from its quads") {
    test::TestBrep b;
    test::add_prism(b, {{0, 0}, {3, 0}, {3, 2}, {0, 1}}, 0, 2);
    (void)read_back(b, 3);
}

TEST_CASE("closed edges and seams are found") {
    test::TestBrep b;
    test::add_cylinder(b, 1, 0.6, 2);
    (void)read_back(b, 16);
}

TEST_CASE("a mesh that does not follow the edges is refused, and the face named") {
    test::TestBrep b;
    test::add_prism(b, test::rectangle(2, 1), 0, 3);
    ModelMesh mesh = swept(b, 4);
    const std::vector<FaceId> faces = faces_of(b);
    const auto read = [&] { return neighbour_boundary(b, mesh.mesh.nodes, mesh.quads, mesh.quad_face, faces); };
    const ModelMesh whole = mesh;
    mesh.mesh.nodes[neighbour_boundary(b, mesh.mesh.nodes, mesh.quads, mesh.quad_face, faces).edges[0].nodes[2]] +=
        Vec3(0.1, 0.1, 0.1);
    CHECK_THROWS_WITH(read(), Catch::Contains("does not follow edge 1"));
    mesh = whole;
    mesh.mesh.nodes[read().vertices[0]] += Vec3(0.1, 0, 0);
    CHECK_THROWS_WITH(read(), Catch::Contains("has no node at vertex 1"));
    mesh = whole;
    mesh.quads.clear();
    mesh.quad_face.clear();
    CHECK_THROWS_WITH(read(), Catch::Contains("has no quads"));
    mesh.quads.resize(1);
    CHECK_THROWS_AS(read(), InputError);
}
