#include "support/catch.hpp"

#include <pavior/cad/tetrahedra.hpp>
#include <pavior/core/error.hpp>
#include <pavior/core/stop.hpp>
#include <pavior/mesh/verify_tets.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>
#include <stop_token>

#include <gmsh.h>

using namespace pavior;
namespace occ = gmsh::model::occ;

namespace {

TetSizes of_size(double size) {
    TetSizes sizes;
    sizes.size = size;
    sizes.least = 0.3 * size;
    return sizes;
}

double volume_of_tets(const SolidsTets& made, SolidId solid) {
    double sum = 0;
    const auto& x = made.tets.mesh.nodes;
    for (std::size_t t = 0; t < made.tet_solid.size(); ++t) {
        const TetCorners& c = made.tets.mesh.tets[t];
        const double six = (x[c[1]] - x[c[0]]).cross(x[c[2]] - x[c[0]]).dot(x[c[3]] - x[c[0]]);
        sum += made.tet_solid[t] == solid ? six / 6 : 0;
    }
    return sum;
}

/// Tags are right: all that they name lies on the model.
void check_tags(const GmshBrep& model, const SolidsTets& made) {
    const auto& x = made.tets.mesh.nodes;
    for (const TaggedTriangle& t : made.tets.triangles) {
        for (const Index i : t.nodes) {
            const FaceId f{t.tag};
            REQUIRE((model.face_point(f, model.closest_on_face(f, x[i])) - x[i]).norm() < 1e-6);
        }
    }
    for (const TaggedNode& v : made.tets.vertices) {
        REQUIRE((model.vertex_point(VertexId{v.tag}) - x[v.node]).norm() < 1e-9);
    }
    REQUIRE_FALSE(made.tets.edges.empty());
}

GmshBrep two_boxes_and_a_pin() {
    return GmshBrep::build([] {
        occ::addBox(0, 0, 0, 2, 2, 1);
        occ::addBox(0, 0, 1, 2, 2, 1);
        occ::addCylinder(5, 0, 0, 0, 0, 2, 1);
    });
}

}  // namespace

TEST_CASE("A drilled block: everything is tagged, seams are no edges, the size holds") {
    const GmshBrep model = GmshBrep::build([] {
        const int box = occ::addBox(0, 0, 0, 4, 4, 2);
        const int hole = occ::addCylinder(2, 2, -1, 0, 0, 4, 0.8);
        gmsh::vectorpair out;
        std::vector<gmsh::vectorpair> map;
        occ::cut({{3, box}}, {{3, hole}}, out, map);
    });
    const std::array solids{SolidId{0}};
    const SolidsTets made = tetrahedra_of(model, solids, of_size(1));
    CHECK(verify_tets(made.tets.mesh).ok());
    check_tags(model, made);
    CHECK(made.tets.triangles.size() == verify_tets(made.tets.mesh).boundary_faces);
    std::set<std::int32_t> faces, edges;
    for (const TaggedTriangle& t : made.tets.triangles) {
        faces.insert(t.tag);
    }
    for (const TaggedEdge& e : made.tets.edges) {
        edges.insert(e.tag);
    }
    CHECK(faces.size() == 7);
    CHECK(edges.size() == 14);  // twelve of the box, two circles
    CHECK(made.tets.vertices.size() == model.vertex_count());
    const double volume = volume_of_tets(made, SolidId{0});
    CHECK(volume == Approx(model.solid_volume(SolidId{0})).epsilon(0.05));
    const SolidsTets fine = tetrahedra_of(model, solids, of_size(0.5));
    CHECK(fine.tets.mesh.tets.size() > 3 * made.tets.mesh.tets.size());
    const SolidsTets again = tetrahedra_of(model, solids, of_size(1));
    CHECK(again.tets.mesh.nodes == made.tets.mesh.nodes);
    CHECK(again.tets.triangles == made.tets.triangles);
    TetSizes other = of_size(1);
    other.variant = 1;
    CHECK(verify_tets(tetrahedra_of(model, solids, other).tets.mesh).ok());
    TetSizes round = of_size(1);
    round.per_turn = 24;
    round.least = 0.01;
    CHECK(volume_of_tets(tetrahedra_of(model, solids, round), SolidId{0}) < volume);  // a hole with more corners
}

TEST_CASE("Touching solids share their nodes, others are left alone") {
    const GmshBrep model = two_boxes_and_a_pin();
    REQUIRE(model.solid_count() == 3);
    std::vector<SolidId> boxes;
    for (const SolidId s : all_solids(model)) {
        if (model.solid_volume(s) == Approx(4)) {
            boxes.push_back(s);
        }
    }
    REQUIRE(boxes.size() == 2);
    const SolidsTets made = tetrahedra_of(model, boxes, of_size(0.8));
    const TetReport report = verify_tets(made.tets.mesh);
    CHECK(report.ok());
    CHECK(report.volume == Approx(8));
    CHECK(volume_of_tets(made, boxes[0]) == Approx(4));
    CHECK(made.tets.triangles.size() > report.boundary_faces);
    check_tags(model, made);
    const SolidsTets one = tetrahedra_of(model, std::array{boxes[1]}, of_size(0.8));
    CHECK(verify_tets(one.tets.mesh).volume == Approx(4));
    CHECK(one.tets.triangles.size() == verify_tets(one.tets.mesh).boundary_faces);
}

TEST_CASE("Edges, faces and solids have their own lengths") {
    const GmshBrep model = two_boxes_and_a_pin();
    const std::vector<SolidId> all = all_solids(model);
    const std::size_t coarse = tetrahedra_of(model, all, of_size(1)).tets.mesh.tets.size();
    for (const int kind : {1, 2, 3}) {
        TetSizes sizes = of_size(1);
        sizes.least = 0.05;
        if (kind == 1) {
            sizes.edge[EdgeId{0}] = 0.1;
        } else if (kind == 2) {
            sizes.face[FaceId{0}] = 0.2;
        } else {
            sizes.solid[SolidId{0}] = 0.3;
        }
        CAPTURE(kind);
        const SolidsTets fine = tetrahedra_of(model, all, sizes);
        CHECK(verify_tets(fine.tets.mesh).ok());
        CHECK(fine.tets.mesh.tets.size() > coarse + 300);
    }
}

TEST_CASE("Lengths grow from a point on") {
    const GmshBrep model = two_boxes_and_a_pin();
    const std::vector<SolidId> all = all_solids(model);
    TetSizes sizes = of_size(1);
    sizes.least = 0.05;
    const SolidsTets plain = tetrahedra_of(model, all, sizes);
    sizes.near = {{Vec3(2, 2, 2), 0.1}};
    const SolidsTets graded = tetrahedra_of(model, all, sizes);
    CHECK(verify_tets(graded.tets.mesh).ok());
    const auto within = [](const SolidsTets& made, const Vec3& x, double radius) {
        const auto& nodes = made.tets.mesh.nodes;
        return std::count_if(nodes.begin(), nodes.end(), [&](const Vec3& y) { return (x - y).norm() < radius; });
    };
    CHECK(within(graded, Vec3(2, 2, 2), 0.4) > 10 + within(plain, Vec3(2, 2, 2), 0.4));
    CHECK(within(graded, Vec3(5, 0, 1), 1.6) < 2 * within(plain, Vec3(5, 0, 1), 1.6));  // far away
    sizes.growth = 0.2;
    CHECK(tetrahedra_of(model, all, sizes).tets.mesh.tets.size() > graded.tets.mesh.tets.size());
    sizes.near[0].size = 0;
    CHECK_THROWS_AS(tetrahedra_of(model, all, sizes), InputError);
}

TEST_CASE("What makes no sense is refused, time is kept, a stop is a stop") {
    const GmshBrep model = two_boxes_and_a_pin();
    const std::array solids{SolidId{0}};
    CHECK_THROWS_AS(tetrahedra_of(model, solids, of_size(0)), InputError);
    TetSizes turn = of_size(1);
    turn.per_turn = 2;
    CHECK_THROWS_AS(tetrahedra_of(model, solids, turn), InputError);
    CHECK_THROWS_AS(tetrahedra_of(model, std::array{SolidId{7}}, of_size(1)), InputError);
    TetSizes late = of_size(0.02);
    late.seconds = 0.1;
    CHECK_THROWS_WITH(tetrahedra_of(model, solids, late), Catch::Contains("in time"));
    std::stop_source source;
    source.request_stop();
    TetSizes stopped = of_size(0.02);
    stopped.stop = source.get_token();
    CHECK_THROWS_AS(tetrahedra_of(model, solids, stopped), Stopped);
}
