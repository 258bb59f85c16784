#include <pavior/one_to_one/structure_side.hpp>

#include "support/catch.hpp"
#include "support/grid_cap.hpp"
#include "support/test_brep.hpp"

#include <pavior/one_to_one/mesh_linking_side.hpp>
#include <pavior/one_to_one/recognition.hpp>

#include <algorithm>
#include <numeric>
#include <random>

using namespace pavior;

namespace {

/// Forgets rows and columns: nodes, quads and the first corners of quads in any order.
FaceMesh shuffled(const FaceMesh& face, unsigned seed) {
    std::mt19937 random(seed);
    std::vector<Index> ids = face.nodes;
    std::sort(ids.begin(), ids.end());
    ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
    std::shuffle(ids.begin(), ids.end(), random);
    FaceMesh result;
    result.nodes = ids;
    result.uv.resize(ids.size());
    const auto position = [&](Index id) {
        return static_cast<Index>(std::find(ids.begin(), ids.end(), id) - ids.begin());
    };
    for (std::size_t i = face.nodes.size(); i-- > 0;) {
        result.uv[position(face.nodes[i])] = face.uv[i];
    }
    for (QuadCorners quad : face.quads) {
        for (Index& corner : quad) {
            corner = position(face.nodes[corner]);
        }
        std::rotate(quad.begin(), quad.begin() + random() % 4, quad.end());
        result.quads.push_back(quad);
    }
    std::shuffle(result.quads.begin(), result.quads.end(), random);
    return result;
}

void check_sides(const test::TestBrep& b, const std::vector<int>& intervals) {
    const SolidId solid{0};
    const SweepTopology sweep = sweep_between(b, solid, b.solid_faces(solid)[0].face, b.solid_faces(solid)[1].face);
    for (const std::vector<LinkingSide>& loop : sweep.loops) {
        for (const LinkingSide& side : loop) {
            BoundaryMesh mesh = mesh_edges(b, intervals);
            (void)mesh_linking_side(b, mesh, side, true);
            FaceMesh& face = mesh.faces[side.face.index()];
            const FaceMesh wanted = face;
            face = shuffled(wanted, 7);
            REQUIRE(structure_side(mesh, side, b.face_period(side.face)));
            CHECK(face.nodes == wanted.nodes);
            CHECK(face.columns == wanted.columns);
            CHECK(face.rows == wanted.rows);
            CHECK(face.quads == wanted.quads);
            for (std::size_t i = 0; i < face.uv.size(); ++i) {
                CHECK((face.uv[i] - wanted.uv[i]).norm() < 1e-12);
            }

            face = shuffled(wanted, 8);
            face.quads.pop_back();
            const FaceMesh torn = face;
            CHECK_FALSE(structure_side(mesh, side, b.face_period(side.face)));
            CHECK(face.nodes == torn.nodes);
            CHECK_FALSE(face.structured());
        }
    }
}

}  // namespace

TEST_CASE("rows and columns of linking sides are found again") {
    test::TestBrep b;
    test::add_prism(b, {{0, 0}, {3, 0}, {3, 2}, {0, 1}}, 0, 2);
    check_sides(b, std::vector<int>(b.edge_count(), 3));
}

TEST_CASE("a grid between other nodes is none of the side's") {
    test::TestBrep b;
    test::add_prism(b, test::rectangle(2, 1), 0, 3);
    const SweepTopology sweep =
        sweep_between(b, SolidId{0}, b.solid_faces(SolidId{0})[0].face, b.solid_faces(SolidId{0})[1].face);
    BoundaryMesh mesh = mesh_edges(b, std::vector<int>(b.edge_count(), 2));
    const LinkingSide& side = sweep.loops[0][0];
    (void)mesh_linking_side(b, mesh, side, true);
    FaceMesh& face = mesh.faces[side.face.index()];
    face = shuffled(face, 9);
    for (QuadCorners& quad : face.quads) {
        std::swap(quad[1], quad[3]);  // seen from the wrong side
    }
    CHECK_FALSE(structure_side(mesh, side, b.face_period(side.face)));
}
