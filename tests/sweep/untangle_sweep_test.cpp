#include "support/catch.hpp"

#include <pavior/core/large_array.hpp>
#include <pavior/mesh/boundary_loops.hpp>
#include <pavior/mesh/span_mesh.hpp>
#include <pavior/mesh/verify_hexes.hpp>
#include <pavior/smooth/hexes.hpp>
#include <pavior/sweep/untangle_sweep.hpp>

#include <cstring>
#include <vector>

using namespace pavior;

namespace {

constexpr Index cells = 4;
constexpr std::size_t layers = 4;

QuadMesh square() {
    QuadMesh mesh;
    for (Index j = 0; j <= cells; ++j) {
        for (Index i = 0; i <= cells; ++i) {
            mesh.nodes.emplace_back(i, j, 0);
            if (i < cells && j < cells) {
                const Index a = j * (cells + 1) + i;
                mesh.quads.push_back({a, a + 1, a + cells + 2, a + cells + 1});
            }
        }
    }
    return mesh;
}

SweepMesh bar() {
    const QuadMesh cap = square();
    std::vector<Vec3> nodes;
    for (std::size_t k = 0; k <= layers; ++k) {
        for (const Vec3& x : cap.nodes) {
            nodes.emplace_back(x + static_cast<double>(k) * Vec3::UnitZ());
        }
    }
    return {nodes, cap.quads, layers};
}

}  // namespace

TEST_CASE("a sweep without inverted hexahedra keeps its bytes and tells its smallest determinant") {
    SweepMesh mesh = bar();
    mesh.nodes()[mesh.numbering().node(2, 12)] += Vec3(0.3, 0, 0);
    const std::vector<Vec3> before(mesh.nodes().begin(), mesh.nodes().end());
    const SmoothReport report = untangle_sweep(mesh, boundary_loops(square()));
    CHECK(report.status == SmoothStatus::unchanged);
    CHECK(report.inverted_before == 0);
    CHECK(std::memcmp(before.data(), mesh.nodes().data(), before.size() * sizeof(Vec3)) == 0);
    const std::vector<HexCorners> hexes = mesh.hexes();
    const std::vector<std::uint8_t> fixed(before.size(), 1);
    CHECK(report.min_det_before == untangle_hexes(mesh.nodes(), hexes, fixed).min_det_before);
}

TEST_CASE("inverted hexahedra are repaired with caps and loops fixed") {
    SweepMesh mesh = bar();
    const Loops loops = boundary_loops(square());
    std::vector<Vec3> given(mesh.nodes().begin(), mesh.nodes().end());
    for (const Index i : {6U, 7U, 12U}) {
        mesh.nodes()[mesh.numbering().node(2, i)] += Vec3(0, 0, 1.7);
    }
    REQUIRE_FALSE(verify_hexes(mesh).ok());
    const SmoothReport report = untangle_sweep(mesh, loops);
    CHECK(report.status == SmoothStatus::repaired);
    CHECK(report.inverted_before > 0);
    CHECK(report.inverted_after == 0);
    CHECK(verify_hexes(mesh).ok());
    for (std::size_t k = 0; k <= layers; ++k) {
        for (const Index i : loops.nodes) {
            const std::size_t node = mesh.numbering().node(k, i);
            CHECK(mesh.nodes()[node] == given[node]);
        }
    }
}

TEST_CASE("a boundary that is turned over cannot be repaired and is reported") {
    SweepMesh mesh = bar();
    for (std::size_t i = 0; i < mesh.level_size(); ++i) {
        mesh.nodes()[mesh.numbering().node(layers, i)][2] = -1;
    }
    const SmoothReport report = untangle_sweep(mesh, boundary_loops(square()));
    CHECK(report.status == SmoothStatus::still_inverted);
    CHECK_FALSE(report.inverted_ids.empty());
}
