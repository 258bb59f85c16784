// One-to-one sweeps with linking sides that are unions of rectangles: faces that a patch has taken a part of.
#include "support/catch.hpp"
#include "support/test_brep.hpp"

#include <pavior/brep/face_distance.hpp>
#include <pavior/cad/region_quads.hpp>
#include <pavior/glpk/solve_program.hpp>
#include <pavior/mesh/quality.hpp>
#include <pavior/mesh/verify_hexes.hpp>
#include <pavior/mesh/verify_quads.hpp>
#include <pavior/one_to_one/cap_order.hpp>
#include <pavior/one_to_one/intervals.hpp>
#include <pavior/one_to_one/recognition.hpp>
#include <pavior/one_to_one/sweep_model.hpp>

#include <map>
#include <numbers>

using namespace pavior;
using namespace pavior::test;

namespace {

using GridPoint = std::array<int, 2>;
using Pattern = std::vector<std::vector<GridPoint>>;

/// A frustum over a regular polygon, twisted or not. Its first wall is cut into the polygons of a pattern on a grid of
/// 3 x 3, (0, 0) below on the left seen from outside; with \p inwards their normals point into the solid.
SolidId add_notched_frustum(TestBrep& b, std::size_t corners, const Pattern& pattern, bool inwards = false) {
    const auto ring = [&](double r, double z) {
        std::vector<Vec3> points;
        for (std::size_t i = 0; i < corners; ++i) {
            const double a = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(corners);
            points.emplace_back(r * std::cos(a), r * std::sin(a), z);
        }
        return points;
    };
    const std::vector<Vec3> low = ring(2, 0);
    const std::vector<Vec3> high = ring(1.2, 3);
    std::map<GridPoint, VertexId> grid;
    const auto at = [&](const GridPoint& p) {
        const double s = p[0] / 3.0;
        const double t = p[1] / 3.0;
        const auto [entry, added] = grid.try_emplace(p);
        if (added) {
            entry->second = b.vertex((1 - t) * ((1 - s) * low[0] + s * low[1]) + t * ((1 - s) * high[0] + s * high[1]));
        }
        return entry->second;
    };
    std::vector<std::vector<VertexId>> pieces;
    for (const auto& piece : pattern) {
        pieces.emplace_back();
        for (const GridPoint& p : piece) {
            pieces.back().push_back(at(p));
        }
    }
    // vertices on an outer line of the grid, in order
    const auto line = [&](std::size_t axis, int value) {
        std::vector<VertexId> result;
        for (const auto& [p, v] : grid) {
            if (p[1 - axis] == value) {
                result.push_back(v);
            }
        }
        return result;
    };
    std::vector<VertexId> bottom = line(0, 0);
    std::vector<VertexId> top = line(0, 3);
    std::vector<VertexId> left = line(1, 0);
    std::vector<VertexId> right = line(1, 3);
    std::vector<VertexId> low_ring = bottom;
    std::vector<VertexId> high_ring = top;
    std::vector<std::vector<VertexId>> ribs{right};
    for (std::size_t i = 2; i < corners; ++i) {
        low_ring.push_back(b.vertex(low[i]));
        high_ring.push_back(b.vertex(high[i]));
        ribs.push_back({low_ring.back(), high_ring.back()});
    }
    ribs.push_back(left);
    std::vector<OrientedFace> faces{{b.flat_polygon(low_ring), false}, {b.flat_polygon(high_ring), true}};
    for (std::size_t i = 0; i + 1 < ribs.size(); ++i) {
        std::vector<VertexId> wall = ribs[i + 1];
        wall.insert(wall.begin(), ribs[i].rbegin(), ribs[i].rend());
        faces.push_back({b.flat_polygon(wall), true});
    }
    for (std::vector<VertexId>& piece : pieces) {
        if (inwards) {
            std::reverse(piece.begin(), piece.end());
        }
        faces.push_back({b.flat_polygon(piece), !inwards});
    }
    return b.solid(std::move(faces));
}

/// Meshes plane caps.
struct PlaneCap {
    const TestBrep* model;

    CapMesh operator()(FaceId face, const CapBoundary& boundary) const {
        const PlaneQuadMesh made = mesh_region({boundary.uv, boundary.offsets});
        CapMesh result{{}, made.nodes, made.quads};
        for (const Vec2& uv : result.uv) {
            result.nodes.push_back(model->face_point(face, uv));
        }
        return result;
    }
};

double solid_volume(const TestBrep& b, SolidId solid) {
    double six = 0;
    for (const OrientedFace& f : b.solid_faces(solid)) {
        const EdgeLoop& loop = b.face_loops(f.face)[0];
        const Vec3 a = b.vertex_point(first_vertex(b, loop[0]));
        for (const OrientedEdge& use : loop) {
            const double part = a.dot(b.vertex_point(first_vertex(b, use)).cross(b.vertex_point(last_vertex(b, use))));
            six += f.outward ? part : -part;
        }
    }
    return six / 6;
}

struct Case {
    const char* name;
    Pattern pattern;
    std::size_t notched;  ///< sides that are no rectangles
};

const std::vector<Case>& cases() {
    static const std::vector<Case> all{
        {"a patch at the upper right",
         {{{0, 0}, {3, 0}, {3, 2}, {1, 2}, {1, 3}, {0, 3}}, {{1, 2}, {3, 2}, {3, 3}, {1, 3}}},
         1},
        {"a patch at the lower left",
         {{{1, 0}, {3, 0}, {3, 3}, {0, 3}, {0, 1}, {1, 1}}, {{0, 0}, {1, 0}, {1, 1}, {0, 1}}},
         1},
        {"a patch at the right",
         {{{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 2}, {3, 2}, {3, 3}, {0, 3}}, {{1, 1}, {3, 1}, {3, 2}, {1, 2}}},
         1},
        {"a patch at the top",
         {{{0, 0}, {3, 0}, {3, 3}, {2, 3}, {2, 1}, {1, 1}, {1, 3}, {0, 3}}, {{1, 1}, {2, 1}, {2, 3}, {1, 3}}},
         1},
        {"a patch at the bottom",
         {{{0, 0}, {1, 0}, {1, 2}, {2, 2}, {2, 0}, {3, 0}, {3, 3}, {0, 3}}, {{1, 0}, {2, 0}, {2, 2}, {1, 2}}},
         1},
        {"two interlocking pieces",
         {{{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 2}, {0, 2}}, {{1, 1}, {3, 1}, {3, 3}, {0, 3}, {0, 2}, {1, 2}}},
         2},
        {"stairs",
         {{{0, 0}, {3, 0}, {3, 1}, {2, 1}, {2, 2}, {1, 2}, {1, 3}, {0, 3}},
          {{2, 1}, {3, 1}, {3, 3}, {1, 3}, {1, 2}, {2, 2}}},
         2},
    };
    return all;
}

std::size_t notched_sides(const SweepTopology& sweep) {
    std::size_t count = 0;
    for (const std::vector<LinkingSide>& loop : sweep.loops) {
        count += static_cast<std::size_t>(
            std::count_if(loop.begin(), loop.end(), [](const LinkingSide& side) { return !side.rectangle(); }));
    }
    return count;
}

}  // namespace

TEST_CASE("linking sides with a notch are swept one-to-one") {
    for (const Case& example : cases()) {
        for (const std::size_t corners : {5U, 6U}) {
            for (const bool inwards : {false, true}) {
                CAPTURE(example.name, corners, inwards);
                TestBrep b;
                const SolidId solid = add_notched_frustum(b, corners, example.pattern, inwards);
                const Recognition recognition = recognise_sweeps(b, solid);
                REQUIRE(recognition.sweepable());
                const SweepTopology& sweep = recognition.candidates.front();
                CHECK(sweep.source == b.solid_faces(solid)[0].face);
                CHECK(sweep.target == b.solid_faces(solid)[1].face);
                CHECK(notched_sides(sweep) == example.notched);
                for (const double size : {9.0, 1.0, 0.35}) {
                    IntervalOptions options;
                    options.size = size;
                    const IntervalAssignment intervals =
                        assign_intervals(b, std::span(&sweep, 1), options, GlpkSolver{});
                    for (const bool backwards : {false, true}) {
                        const SweepTopology way = backwards ? reversed(sweep) : sweep;
                        const ModelMesh mesh = sweep_model(b, std::span(&way, 1), intervals.intervals, PlaneCap{&b});
                        const HexReport report = verify_hexes(mesh.mesh);
                        INFO(report.text());
                        CHECK(report.ok());
                        CHECK(hex_quality(mesh.mesh).scaled_jacobian.min > 0.2);
                        CHECK(report.volume == Approx(solid_volume(b, solid)).epsilon(1e-9));
                        CHECK(face_distance(b, mesh.mesh.nodes, mesh.quads, mesh.quad_face).distance < 1e-9);
                        CHECK(mesh.solids[0].layers == static_cast<std::size_t>(intervals.layers[0]));
                        CHECK(std::set<FaceId>(mesh.quad_face.begin(), mesh.quad_face.end()).size() == b.face_count());
                    }
                }
            }
        }
    }
}

TEST_CASE("a notch seen upside down twice is itself") {
    TestBrep b;
    const SolidId solid = add_notched_frustum(b, 5, cases()[0].pattern);
    const SweepTopology sweep = best_sweep(b, solid);
    for (const LinkingSide& side : sweep.loops[0]) {
        CHECK(upside_down(upside_down(side)) == side);
        CHECK((upside_down(side) == side) == false);
        CHECK(outline_of(side).front().second == SideRole::bottom);
        CHECK(outline_of(upside_down(side)).front().second == SideRole::bottom);
    }
}

TEST_CASE("a notched side that its neighbour has meshed otherwise is refused by name") {
    TestBrep b;
    const SolidId solid = add_notched_frustum(b, 5, cases()[0].pattern);
    const SweepTopology sweep = best_sweep(b, solid);
    IntervalOptions options;
    options.size = 0.5;
    const std::vector<int> intervals = assign_intervals(b, std::span(&sweep, 1), options, GlpkSolver{}).intervals;
    BoundaryMesh mesh = mesh_edges(b, intervals);
    FaceId notched;
    for (const LinkingSide& side : sweep.loops[0]) {
        (void)mesh_linking_side(b, mesh, side, true);
        notched = side.rectangle() ? notched : side.face;
    }
    CHECK(level_ids(b, mesh, sweep, intervals).layers > 3);
    FaceMesh& face = mesh.faces[notched.index()];
    std::swap(face.quads[0][0], face.quads[0][2]);  // a quad with two corners exchanged
    try {
        (void)level_ids(b, mesh, sweep, intervals);
        FAIL("accepted");
    } catch (const UnmeshableError& error) {
        CHECK(error.ids() == Error::Ids{notched.value + 1});
    }
}
