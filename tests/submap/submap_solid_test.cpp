#include <pavior/glpk/solve_program.hpp>
#include <pavior/submap/submap_solid.hpp>

#include "support/catch.hpp"
#include "support/voxel_brep.hpp"

#include <pavior/mesh/span_mesh.hpp>
#include <pavior/mesh/verify_hexes.hpp>
#include <pavior/submap/submap_recognition.hpp>

using namespace pavior;
using namespace pavior::test;

namespace {

struct Solid {
    BoundaryMesh mesh;
    SubmapSolid solid;
};

/// A voxel solid with one interval for each unit of length.
Solid filled(const VoxelBrep& model, const SolidSubmapOptions& options = {}) {
    const TestBrep& b = model.brep();
    const SubmapModel submaps = recognise_submaps(b, model.solids(), {}, GlpkSolver{});
    SubmapNumbers numbers;
    for (std::size_t e = 0; e < b.edge_count(); ++e) {
        numbers.edges.push_back(static_cast<int>(std::lround(b.edge_length(EdgeId{static_cast<std::int32_t>(e)}))));
    }
    std::vector<std::optional<SubmapFace>> faces(b.face_count());
    Solid result{mesh_edges(b, numbers.edges), {}};
    for (std::size_t f = 0; f < b.face_count(); ++f) {
        numbers.links.emplace_back();
        for (const LoopLink& link : submaps.faces[f].links) {
            numbers.links.back().push_back(
                {static_cast<int>(std::lround(link.length[0])), static_cast<int>(std::lround(link.length[1]))});
        }
    }
    for (std::size_t f = 0; f < b.face_count(); ++f) {
        const FaceId id{static_cast<std::int32_t>(f)};
        faces[f] = mesh_submap_face(b, result.mesh, id, submaps.faces[f], numbers);
    }
    result.solid = submap_solid(b, result.mesh, submaps, submaps.solids[0], numbers, faces, options);
    return result;
}

HexMesh hexes(const Solid& filled) {
    HexMesh mesh{{}, filled.solid.hexes};
    for (const Index n : filled.solid.nodes) {
        mesh.nodes.push_back(filled.mesh.nodes[n]);
    }
    return mesh;
}

Voxels stepped() {
    Voxels voxels(4, 4, 4);
    voxels.fill({0, 0, 0}, {4, 4, 2}, 1);
    voxels.fill({0, 0, 2}, {4, 2, 4}, 1);
    voxels.fill({1, 3, 0}, {2, 4, 2}, 0);
    return voxels;
}

}  // namespace

TEST_CASE("a unit lattice comes back, with nodes where their coordinates say") {
    const VoxelBrep model(stepped());
    REQUIRE(model.sound());
    const Solid done = filled(model);
    const HexReport report = verify_hexes(hexes(done));
    INFO(report.text());
    CHECK(report.ok());
    CHECK(done.solid.hexes.size() == 32 + 16 - 2);
    const Vec3 shift = done.mesh.nodes[done.solid.nodes[0]] -
                       Vec3(done.solid.lattice[0][0], done.solid.lattice[0][1], done.solid.lattice[0][2]);
    std::size_t inner = 0;
    for (std::size_t n = 0; n < done.solid.nodes.size(); ++n) {
        const LatticePoint<3>& p = done.solid.lattice[n];
        CHECK((done.mesh.nodes[done.solid.nodes[n]] - shift - Vec3(p[0], p[1], p[2])).norm() < 1e-7);
        CHECK((n == 0 ||
               std::array{p[2], p[1], p[0]} > std::array{done.solid.lattice[n - 1][2], done.solid.lattice[n - 1][1],
                                                         done.solid.lattice[n - 1][0]}));
    }
    for (std::size_t n = 0; n < done.solid.nodes.size(); ++n) {
        inner += std::count_if(done.solid.hexes.begin(), done.solid.hexes.end(), [&](const HexCorners& h) {
                     return std::find(h.begin(), h.end(), static_cast<Index>(n)) != h.end();
                 }) == 8;
    }
    CHECK(inner == done.solid.inner_nodes);
    CHECK(done.solid.smooth.status == SmoothStatus::unchanged);
}

TEST_CASE("without smoothing the nodes stay where they are put, and the report still tells") {
    const VoxelBrep model(stepped(), true, [](const Vec3& x) { return Vec3(x[0] + 0.5 * x[2], x[1], x[2]); });
    REQUIRE(model.sound());
    SolidSubmapOptions options;
    options.smooth = false;
    const Solid done = filled(model, options);
    CHECK(done.solid.smooth.moved_nodes == 0);
    CHECK(done.solid.smooth.min_det_after > 0.5);
    CHECK(done.solid.smooth.min_det_after < 0.95);
    CHECK(verify_hexes(hexes(done)).ok());
}

TEST_CASE("improvement frees inner nodes only and never makes things worse") {
    const VoxelBrep model(stepped());
    REQUIRE(model.sound());
    const Solid done = filled(model);
    HexMesh mesh = hexes(done);
    std::vector<std::uint8_t> fixed(mesh.nodes.size(), 1);
    std::size_t moved = mesh.nodes.size();
    for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
        const auto uses = std::count_if(mesh.hexes.begin(), mesh.hexes.end(), [&](const HexCorners& h) {
            return std::find(h.begin(), h.end(), static_cast<Index>(n)) != h.end();
        });
        if (uses == 8) {
            fixed[n] = 0;
            moved = n;
        }
    }
    REQUIRE(moved < mesh.nodes.size());
    mesh.nodes[moved] += Vec3(0.95, 0.9, 0.9);  // nearly flat hexahedra
    const std::vector<Vec3> before = mesh.nodes;
    const SmoothReport report = detail::improve_solid(mesh.nodes, mesh.hexes, fixed, {});
    CHECK(report.min_det_after >= report.min_det_before);
    CHECK(report.min_det_after > 0.2);
    for (std::size_t n = 0; n < fixed.size(); ++n) {
        CHECK((fixed[n] == 0 || mesh.nodes[n] == before[n]));
    }
}
