#include "support/catch.hpp"
#include "support/test_brep.hpp"

#include <pavior/part/plane_guide.hpp>

using namespace pavior;
using namespace pavior::test;

namespace {

/// A box whose faces are known to be plane, the one named in `curved` excepted.
struct PlaneBox : TestBrep {
    FaceId curved;
    [[nodiscard]] std::string face_kind(FaceId f) const { return f == curved ? "BSpline" : "Plane"; }
    [[nodiscard]] Vec2 face_interior(FaceId f) const { return edge_on_face(face_loops(f)[0][0].edge, 0, f, true); }
};

/// The nodes of a grid of 2 x 2 x 2 cells on the box [0, 2]^3 with the quads of its faces by tag.
HexMeshData grid(const PlaneBox& b) {
    HexMeshData data;
    for (int k = 0; k < 3; ++k) {
        for (int j = 0; j < 3; ++j) {
            for (int i = 0; i < 3; ++i) {
                data.mesh.nodes.emplace_back(i, j, k);
            }
        }
    }
    const auto at = [](int i, int j, int k) { return static_cast<Index>(i + 3 * j + 9 * k); };
    for (int k = 0; k < 2; ++k) {
        for (int j = 0; j < 2; ++j) {
            for (int i = 0; i < 2; ++i) {
                data.mesh.hexes.push_back({at(i, j, k), at(i + 1, j, k), at(i + 1, j + 1, k), at(i, j + 1, k),
                                           at(i, j, k + 1), at(i + 1, j, k + 1), at(i + 1, j + 1, k + 1),
                                           at(i, j + 1, k + 1)});
            }
        }
    }
    for (const QuadCorners& quad : boundary_quads(data.mesh)) {
        Vec3 middle = Vec3::Zero();
        for (const Index i : quad) {
            middle += data.mesh.nodes[i] / 4;
        }
        for (std::int32_t f = 0; f < static_cast<std::int32_t>(b.face_count()); ++f) {
            if ((b.face_point(FaceId{f}, b.closest_on_face(FaceId{f}, middle)) - middle).norm() < 1e-9) {
                data.quads.push_back(quad);
                data.quad_groups.push_back(b.tag(2, FaceId{f}.index()));
            }
        }
    }
    return data;
}

}  // namespace

TEST_CASE("Nodes slide in planes and along edges, not at vertices, and inner ones are free") {
    PlaneBox b;
    add_prism(b, rectangle(2, 2), 0, 2);
    const HexMeshData data = grid(b);
    REQUIRE(data.quads.size() == 24);
    const PlaneGuide guide(b, data);
    CHECK(guide.freedom(0) == Freedom::fixed);
    CHECK(guide.freedom(1) == Freedom::curve);    // (1, 0, 0)
    CHECK(guide.freedom(4) == Freedom::surface);  // (1, 1, 0)
    CHECK(guide.freedom(13) == Freedom::space);   // the middle
    CHECK((guide.project(4, Vec3(0.3, 0.7, 0.5)) - Vec3(0.3, 0.7, 0)).norm() < 1e-15);
    CHECK((guide.project(1, Vec3(0.3, 0.7, 0.5)) - Vec3(0.3, 0, 0)).norm() < 1e-15);
    CHECK(std::abs(guide.direction(1, Vec3::Zero()).x()) == Approx(1));
}

TEST_CASE("Nodes on faces that are not plane, and on no face, stay") {
    PlaneBox b;
    add_prism(b, rectangle(2, 2), 0, 2);
    HexMeshData data = grid(b);
    for (std::size_t q = 0; q < data.quads.size(); ++q) {
        if (data.mesh.nodes[data.quads[q][0]].z() == 0 && data.mesh.nodes[data.quads[q][2]].z() == 0) {
            b.curved = FaceId{static_cast<std::int32_t>(0)};
            while (b.tag(2, b.curved.index()) != data.quad_groups[q]) {
                ++b.curved.value;
            }
        }
    }
    const PlaneGuide guide(b, data);
    CHECK(guide.freedom(4) == Freedom::fixed);
    CHECK(guide.freedom(1) == Freedom::fixed);  // between a plane face and the curved one
    CHECK(guide.freedom(22) == Freedom::surface);
    data.quads.clear();
    data.quad_groups.clear();
    const PlaneGuide none(b, data);
    CHECK(none.freedom(22) == Freedom::fixed);
    CHECK(none.freedom(13) == Freedom::space);
}
