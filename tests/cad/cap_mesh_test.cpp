#include <pavior/brep/edge_chain.hpp>
#include <pavior/cad/cap_mesh.hpp>

#include "cad/brep_checks.hpp"

#include <pavior/brep/boundary_mesh.hpp>
#include <pavior/math/quadrilateral.hpp>
#include <pavior/mesh/boundary_loops.hpp>
#include <pavior/mesh/span_mesh.hpp>
#include <pavior/mesh/verify_quads.hpp>

#include <gmsh.h>

#include <cmath>
#include <string>
#include <vector>

using namespace pavior;
using namespace pavior::test;
namespace occ = gmsh::model::occ;

namespace {

const std::string data = PAVIOR_EXAMPLE_DATA;

double shortest_edge(const GmshBrep& b) {
    double shortest = b.edge_length(EdgeId{0});
    for (std::size_t e = 1; e < b.edge_count(); ++e) {
        shortest = std::min(shortest, b.edge_length(edge_id(e)));
    }
    return shortest;
}

CapBoundary boundary_of(const GmshBrep& b, FaceId face, double size) {
    std::vector<int> intervals(b.edge_count(), 0);
    for (const EdgeLoop& loop : b.face_loops(face)) {
        for (const OrientedEdge& e : loop) {
            const auto ends = b.edge_vertices(e.edge);
            const int pairs = static_cast<int>(std::lround(b.edge_length(e.edge) / size / 2));
            intervals[e.edge.index()] = 2 * std::max(ends[0] == ends[1] ? 2 : 1, pairs);
        }
    }
    return cap_boundary(b, mesh_edges(b, intervals), face);
}

/// The smallest determinant of unit edge vectors at a corner, about the face's own normal.
double worst_corner(const GmshBrep& b, FaceId face, const CapMesh& cap) {
    double worst = 1;
    for (const QuadCorners& q : cap.quads) {
        const QuadPoints x{cap.nodes[q[0]], cap.nodes[q[1]], cap.nodes[q[2]], cap.nodes[q[3]]};
        const Vec2 middle = 0.25 * (cap.uv[q[0]] + cap.uv[q[1]] + cap.uv[q[2]] + cap.uv[q[3]]);
        const auto [du, dv] = b.face_derivatives(face, middle);
        const auto areas = quad_corner_areas(x, du.cross(dv).normalized());
        for (std::size_t k = 0; k < 4; ++k) {
            worst = std::min(worst, areas[k] / ((x[(k + 1) % 4] - x[k]).norm() * (x[(k + 3) % 4] - x[k]).norm()));
        }
    }
    return worst;
}

/// The contract of mesh_cap(). Returns the worst corner.
double check_cap(const GmshBrep& b, FaceId face, const CapBoundary& boundary, const CapMesh& cap) {
    const std::size_t m = boundary.points.size();
    REQUIRE(cap.nodes.size() >= m);
    REQUIRE(cap.uv.size() == cap.nodes.size());
    for (std::size_t i = 0; i < m; ++i) {
        REQUIRE(cap.nodes[i] == boundary.points[i]);
        REQUIRE(cap.uv[i] == boundary.uv[i]);
    }
    for (std::size_t i = m; i < cap.nodes.size(); ++i) {
        REQUIRE(cap.nodes[i] == b.face_point(face, cap.uv[i]));
    }
    const QuadMesh mesh{cap.nodes, cap.quads};
    CHECK(verify_quads(mesh, {16, false, 1}).ok());
    const Loops loops = boundary_loops(mesh);
    REQUIRE(loops.size() + 1 == boundary.offsets.size());
    for (std::size_t l = 0; l < loops.size(); ++l) {
        REQUIRE(loops[l].size() == boundary.offsets[l + 1] - boundary.offsets[l]);
        for (std::size_t i = 0; i < loops[l].size(); ++i) {
            REQUIRE(loops[l][i] == boundary.offsets[l] + i);
        }
    }
    const double worst = worst_corner(b, face, cap);
    CHECK(worst > 0);
    return worst;
}

double area(const CapMesh& cap) {
    double sum = 0;
    for (const QuadCorners& q : cap.quads) {
        sum += quad_vector_area({cap.nodes[q[0]], cap.nodes[q[1]], cap.nodes[q[2]], cap.nodes[q[3]]}).norm();
    }
    return sum;
}

/// The flat face with the most edges.
FaceId richest_face(const GmshBrep& b) {
    FaceId best{0};
    std::size_t most = 0;
    for (std::size_t f = 0; f < b.face_count(); ++f) {
        std::size_t edges = 0;
        for (const EdgeLoop& loop : b.face_loops(face_id(f))) {
            edges += loop.size();
        }
        if (b.face_kind(face_id(f)) == "Plane" && edges > most) {
            most = edges;
            best = face_id(f);
        }
    }
    return best;
}

bool straight(const GmshBrep& b, FaceId face) {
    for (const EdgeLoop& loop : b.face_loops(face)) {
        for (const OrientedEdge& e : loop) {
            const auto r = b.edge_range(e.edge);
            if ((b.edge_point(e.edge, r[1]) - b.edge_point(e.edge, r[0])).norm() < (1 - 1e-9) * b.edge_length(e.edge)) {
                return false;
            }
        }
    }
    return true;
}

}  // namespace

TEST_CASE("caps of real parts: all quads, conforming, exact boundary") {
    const std::string file =
        GENERATE(as<std::string>(), "mfcad/0-0-6-8-19.step", "mfcad/0-1-19.step", "mfcad/0-1-3-4-6-23.step",
                 "mfcad/0-8-8-13-14-23.step", "mfcad/1-3-5-19.step", "mfcad/2-6-19.step", "mfcad/4-4-19.step",
                 "mfcad/6-6-8-8-12-23.step", "mfcad/6-8-8-8-19.step", "mfcad/4-8-8-8-13-23.step",
                 "hexme/s09o_bridge.step", "hexme/n11o_limit_cycle.stp", "hexme/s15o_cylinder.stp");
    CAPTURE(file);
    const GmshBrep b = GmshBrep::load(data + "/" + file, {true, 0});
    const FaceId face = richest_face(b);
    for (const double divisor : {1.0, 2.0, 4.0}) {
        CAPTURE(divisor);
        const double size = std::max(shortest_edge(b) / divisor, b.diagonal() / 60);
        const CapBoundary boundary = boundary_of(b, face, size);
        const CapMesh cap = mesh_cap(b, face, boundary);
        CHECK(check_cap(b, face, boundary, cap) > 0.2);
        if (straight(b, face)) {
            CHECK(area(cap) == Approx(b.face_area(face)).epsilon(1e-10));
        }
    }
}

TEST_CASE("every face of a part can be a cap") {
    const GmshBrep b = GmshBrep::load(data + "/mfcad/1-3-5-19.step", {true, 0});
    const double size = shortest_edge(b);
    double total = 0;
    double expected = 0;
    for (std::size_t f = 0; f < b.face_count(); ++f) {
        CAPTURE(b.tag(2, f));
        const CapBoundary boundary = boundary_of(b, face_id(f), size);
        const CapMesh cap = mesh_cap(b, face_id(f), boundary);
        CHECK(check_cap(b, face_id(f), boundary, cap) > 0.2);
        total += area(cap);
        expected += b.face_area(face_id(f));
    }
    CHECK(total == Approx(expected).epsilon(1e-10));
}

TEST_CASE("a rectangle becomes a grid, unless told otherwise") {
    const GmshBrep b = GmshBrep::build([] { occ::addBox(0, 0, 0, 3, 2, 1); });
    const FaceId top{5};
    const CapBoundary boundary = boundary_of(b, top, 0.25);
    const CapMesh grid = mesh_cap(b, top, boundary);
    CHECK(check_cap(b, top, boundary, grid) == Approx(1));
    CHECK(grid.quads.size() == 12 * 8);
    CapOptions free;
    free.structured = false;
    CHECK(check_cap(b, top, boundary, mesh_cap(b, top, boundary, free)) > 0.2);
}

TEST_CASE("a smaller size gives smaller quads inside") {
    const GmshBrep b = GmshBrep::build([] { occ::addCylinder(0, 0, 0, 0, 0, 1, 10); });
    const FaceId disc = richest_face(b);
    const CapBoundary boundary = boundary_of(b, disc, 2);
    CapOptions fine;
    fine.size = 1;
    const CapMesh usual = mesh_cap(b, disc, boundary);
    const CapMesh finer = mesh_cap(b, disc, boundary, fine);
    check_cap(b, disc, boundary, finer);
    CHECK(finer.quads.size() > 3 * usual.quads.size() / 2);
}

TEST_CASE("curved caps: nodes on the surface, quads right side up") {
    const int kind = GENERATE(range(0, 4));
    CAPTURE(kind);
    const GmshBrep b = GmshBrep::build([&] {
        gmsh::vectorpair result;
        std::vector<gmsh::vectorpair> map;
        if (kind == 0) {  // a patch of a cylinder with a hole
            occ::addCylinder(0, 0, 0, 0, 0, 4, 3, 1, M_PI / 2);
            occ::addCylinder(0, 0, 2, 4, 4, 0, 0.7, 2);
            occ::cut({{3, 1}}, {{3, 2}}, result, map);
        } else if (kind == 1) {  // a zone of a sphere
            occ::addSphere(0, 0, 0, 3, 1, -M_PI / 5, M_PI / 4, 2);
        } else if (kind == 2) {  // a tilted slice through a cylinder and a wavy roof
            occ::addBox(0, 0, 0, 4, 4, 3, 1);
            occ::addCylinder(-1, 2, 5, 6, 0, 0, 3, 2);
            occ::cut({{3, 1}}, {{3, 2}}, result, map);
        } else {  // spline sides between two squares, the upper one turned
            for (const int k : {0, 1}) {
                std::vector<int> lines;
                for (int i = 0; i < 4; ++i) {
                    const double angle = M_PI / 2 * i + 0.5 * k;
                    occ::addPoint(2 * std::cos(angle), 2 * std::sin(angle), 3 * k, 0, 4 * k + i + 1);
                }
                for (int i = 0; i < 4; ++i) {
                    lines.push_back(occ::addLine(4 * k + i + 1, 4 * k + (i + 1) % 4 + 1, 4 * k + i + 1));
                }
                occ::addWire(lines, k + 1);
            }
            occ::addThruSections({1, 2}, result, 1, true);
        }
    });
    std::size_t curved = 0;
    for (std::size_t f = 0; f < b.face_count(); ++f) {
        if (b.face_kind(face_id(f)) == "Plane") {
            continue;
        }
        ++curved;
        CAPTURE(b.tag(2, f));
        const CapBoundary boundary = boundary_of(b, face_id(f), 0.4);
        const CapMesh cap = mesh_cap(b, face_id(f), boundary);
        CHECK(check_cap(b, face_id(f), boundary, cap) > 0.2);
        CHECK(area(cap) == Approx(b.face_area(face_id(f))).epsilon(0.02));
        CapOptions free;
        free.structured = false;
        CHECK(check_cap(b, face_id(f), boundary, mesh_cap(b, face_id(f), boundary, free)) > 0.1);
    }
    CHECK(curved > 0);
}

TEST_CASE("coarse loops of few nodes") {
    const GmshBrep b = GmshBrep::build([] { occ::addCylinder(0, 0, 0, 0, 0, 1, 1); });
    const FaceId disc = richest_face(b);
    const EdgeId circle = b.face_loops(disc)[0][0].edge;
    for (const int n : {4, 6, 8, 10, 12}) {
        CAPTURE(n);
        std::vector<int> intervals(b.edge_count(), 0);
        intervals[circle.index()] = n;
        const CapBoundary boundary = cap_boundary(b, mesh_edges(b, intervals), disc);
        const CapMesh cap = mesh_cap(b, disc, boundary);
        check_cap(b, disc, boundary, cap);
    }
}

TEST_CASE("same input, same bytes; options of Gmsh are put back") {
    const GmshBrep b = GmshBrep::load(data + "/mfcad/1-3-5-19.step", {true, 0});
    const FaceId face = richest_face(b);
    const CapBoundary boundary = boundary_of(b, face, shortest_edge(b) / 2);
    gmsh::option::setNumber("Mesh.Algorithm", 5);
    gmsh::option::setNumber("Mesh.MeshSizeMax", 0.01);
    const CapMesh once = mesh_cap(b, face, boundary);
    double value = 0;
    gmsh::option::getNumber("Mesh.Algorithm", value);
    CHECK(value == 5);
    gmsh::option::getNumber("Mesh.MeshSizeMax", value);
    CHECK(value == 0.01);
    const CapMesh again = GmshCapMesher{&b}(face, boundary);
    CHECK(once.nodes == again.nodes);
    CHECK(once.uv == again.uv);
    CHECK(once.quads == again.quads);
}

TEST_CASE("boundaries that no quads fill are refused by name") {
    const GmshBrep b = GmshBrep::build([] { occ::addBox(0, 0, 0, 3, 2, 1); });
    const FaceId top{5};
    const CapBoundary good = boundary_of(b, top, 0.5);
    const auto code_of = [&](const CapBoundary& boundary, const CapOptions& options = {}) {
        try {
            (void)mesh_cap(b, top, boundary, options);
        } catch (const InputError& error) {
            return error.code();
        }
        return ErrorCode::cad_failure;
    };
    CapBoundary odd = good;
    odd.ids.pop_back();
    odd.points.pop_back();
    odd.uv.pop_back();
    --odd.offsets.back();
    CHECK(code_of(odd) == ErrorCode::size_mismatch);
    CapBoundary short_uv = good;
    short_uv.uv.pop_back();
    CHECK(code_of(short_uv) == ErrorCode::size_mismatch);
    CapBoundary nan = good;
    nan.points[3].x() = NAN;
    CHECK(code_of(nan) == ErrorCode::not_finite);
    CapBoundary reversed = good;
    std::reverse(reversed.points.begin(), reversed.points.end());
    std::reverse(reversed.uv.begin(), reversed.uv.end());
    CHECK(code_of(reversed) == ErrorCode::bad_orientation);
    CHECK(code_of(CapBoundary{}) == ErrorCode::empty_input);
    CapOptions negative;
    negative.size = -1;
    CHECK(code_of(good, negative) == ErrorCode::bad_option);
}
