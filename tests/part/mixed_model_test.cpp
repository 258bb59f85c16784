#include <pavior/glpk/solve_program.hpp>
#include <pavior/part/mixed_model.hpp>

#include "support/catch.hpp"
#include "support/grid_cap.hpp"
#include "support/test_brep.hpp"

#include <pavior/brep/neighbour_boundary.hpp>
#include <pavior/mesh/verify_hexes.hpp>
#include <pavior/one_to_one/recognition.hpp>

using namespace pavior;

namespace {

/// A box between the x-y rectangles at two heights, faces shared with what is there. Face 0 is the bottom, face 1 the
/// top, then front (y low), right, back, left.
struct Boxes {
    test::TestBrep b;
    std::map<std::array<double, 3>, VertexId> vertices;
    std::map<std::array<VertexId, 4>, FaceId> faces;

    VertexId vertex(double x, double y, double z) {
        const auto found = vertices.find({x, y, z});
        return found != vertices.end() ? found->second : vertices[{x, y, z}] = b.vertex({x, y, z});
    }
    OrientedFace face(const std::array<VertexId, 4>& v) {
        std::array<VertexId, 4> key = v;
        std::sort(key.begin(), key.end());
        if (const auto found = faces.find(key); found != faces.end()) {
            return {found->second, false};  // made by the neighbour, outward there
        }
        return {faces[key] = b.flat_polygon({v[0], v[1], v[2], v[3]}), true};
    }
    SolidId box(const Vec3& low, const Vec3& high) {
        std::array<VertexId, 8> v;
        for (std::size_t i = 0; i < 8; ++i) {
            v[i] = vertex(i % 2 == 0 ? low[0] : high[0], i / 2 % 2 == 0 ? low[1] : high[1], i < 4 ? low[2] : high[2]);
        }
        return b.solid({face({v[0], v[2], v[3], v[1]}), face({v[4], v[5], v[7], v[6]}), face({v[0], v[1], v[5], v[4]}),
                        face({v[1], v[3], v[7], v[5]}), face({v[3], v[2], v[6], v[7]}),
                        face({v[2], v[0], v[4], v[6]})});
    }
    [[nodiscard]] FaceId side(SolidId s, std::size_t i) const { return b.solid_faces(s)[i].face; }
};

MixedMesh meshed(const Boxes& boxes, std::span<const SweepTopology> sweeps, std::span<const SolidId> submapped,
                 BoundaryMesh given = {}, double size = 0.5) {
    SubmapModel submaps;
    submaps.faces.resize(boxes.b.face_count());
    if (!submapped.empty()) {
        submaps = recognise_submaps(boxes.b, submapped, {}, GlpkSolver{});
    }
    IntervalOptions options;
    options.size = size;
    options.edge_intervals = given_intervals(boxes.b, given);
    return mixed_model(boxes.b, sweeps, submaps,
                       assign_submap_intervals(boxes.b, sweeps, submaps, options, {}, GlpkSolver{}),
                       test::GridCap<test::TestBrep>{&boxes.b}, std::move(given));
}

void check_volume(const HexMesh& mesh, double volume) {
    const HexReport report = verify_hexes(mesh);
    INFO(report.text());
    CHECK(report.ok());
    CHECK(report.volume == Approx(volume).epsilon(1e-12));
}

}  // namespace

TEST_CASE("a submapped box between swept ones shares its faces with them") {
    Boxes boxes;
    const SolidId a = boxes.box({0, 0, 0}, {1, 1, 1});
    const SolidId c = boxes.box({1, 0, 0}, {3, 1, 1});
    const SolidId d = boxes.box({1, 0, 1}, {3, 1, 2});
    const std::vector<SweepTopology> sweeps{sweep_between(boxes.b, a, boxes.side(a, 3), boxes.side(a, 5)),
                                            sweep_between(boxes.b, d, boxes.side(d, 2), boxes.side(d, 4))};
    const MixedMesh mesh = meshed(boxes, sweeps, std::vector{c});
    check_volume(mesh.mesh, 5);
    CHECK(mesh.mesh.hexes.size() == 5 * 8);
    CHECK(mesh.solids.size() == 2);
    CHECK(mesh.submapped.size() == 1);
    CHECK(mesh.submapped[0].first_hex == 24);
    CHECK(std::count(mesh.hex_solid.begin(), mesh.hex_solid.end(), c) == 16);
    CHECK(mesh.quads.size() == (6 + 10 + 10 - 1 - 2) * 4);  // 2 x 2 a unit square, shared faces once
}

TEST_CASE("solids keep the nodes that a neighbour gives them") {
    Boxes boxes;
    const SolidId a = boxes.box({0, 0, 0}, {1, 1, 1});
    const SolidId c = boxes.box({1, 0, 0}, {3, 1, 1});
    const SolidId d = boxes.box({1, 0, 1}, {3, 1, 2});
    const std::vector<SweepTopology> first{sweep_between(boxes.b, a, boxes.side(a, 3), boxes.side(a, 5))};
    IntervalOptions options;
    options.size = 0.3;  // finer than its neighbours would be
    const ModelMesh done =
        sweep_model(boxes.b, first, assign_intervals(boxes.b, first, options, GlpkSolver{}).intervals,
                    test::GridCap<test::TestBrep>{&boxes.b});
    const FaceId shared = boxes.side(a, 3);
    const BoundaryMesh given =
        neighbour_boundary(boxes.b, done.mesh.nodes, done.quads, done.quad_face, std::vector{shared});
    const auto check_joined = [&](const MixedMesh& mesh) {
        HexMesh all = mesh.mesh;
        REQUIRE(all.nodes.size() > done.mesh.nodes.size());
        CHECK(std::equal(done.mesh.nodes.begin(), done.mesh.nodes.end(), all.nodes.begin()));
        CHECK(std::find(mesh.quad_face.begin(), mesh.quad_face.end(), shared) == mesh.quad_face.end());
        all.hexes.insert(all.hexes.end(), done.mesh.hexes.begin(), done.mesh.hexes.end());
        check_volume(all, 5);
    };
    const std::vector<SweepTopology> from_it{sweep_between(boxes.b, c, boxes.side(c, 3), shared),
                                             sweep_between(boxes.b, d, boxes.side(d, 0), boxes.side(d, 1))};
    check_joined(meshed(boxes, from_it, {}, given));
    const std::vector<SweepTopology> along_it{sweep_between(boxes.b, c, boxes.side(c, 2), boxes.side(c, 4)),
                                              sweep_between(boxes.b, d, boxes.side(d, 2), boxes.side(d, 4))};
    check_joined(meshed(boxes, along_it, {}, given, 0.3));  // as the mesher of these caps wants it
    check_joined(meshed(boxes, {}, std::vector{c, d}, given));
}

TEST_CASE("unstructured quads on a face are refused by those who need structured ones") {
    Boxes boxes;
    const SolidId a = boxes.box({0, 0, 0}, {1, 1, 1});
    const FaceId f = boxes.side(a, 0);
    BoundaryMesh given = mesh_edges(boxes.b, std::vector<int>(boxes.b.edge_count(), 2));
    mesh_cap_face(boxes.b, given, f, test::GridCap<test::TestBrep>{&boxes.b});
    FaceMesh& face = given.faces[f.index()];
    REQUIRE(face.quads.size() == 4);
    // the quad at the first node becomes three with two new nodes: not a grid
    const QuadCorners old = face.quads[0];
    const auto add = [&](double s) {
        Vec3 x = (1 - s) * given.nodes[face.nodes[old[0]]] + s * given.nodes[face.nodes[old[2]]];
        face.nodes.push_back(given.add_node(x));
        face.uv.push_back(boxes.b.closest_on_face(f, x));
        return static_cast<Index>(face.nodes.size() - 1);
    };
    const Index near = add(0.4);
    const Index far = add(0.6);
    face.quads[0] = {old[0], old[1], far, near};
    face.quads.push_back({old[1], old[2], old[3], far});
    face.quads.push_back({old[0], near, far, old[3]});
    const auto tag = Catch::Contains("face " + std::to_string(boxes.b.tag(2, f.index())));
    CHECK_THROWS_WITH(meshed(boxes, {}, std::vector{a}, given), tag);
    const std::vector<SweepTopology> along_it{sweep_between(boxes.b, a, boxes.side(a, 2), boxes.side(a, 4))};
    CHECK_THROWS_WITH(meshed(boxes, along_it, {}, given), tag);
    const std::vector<SweepTopology> from_it{sweep_between(boxes.b, a, f, boxes.side(a, 1))};
    CHECK(meshed(boxes, from_it, {}, given).mesh.hexes.size() % 6 == 0);
}
