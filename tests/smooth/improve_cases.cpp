// Inner nodes of four solids are displaced at random: no hexahedron stays inverted, and the quality comes back.

#include <pavior/mesh/edge_table.hpp>
#include <pavior/mesh/span_mesh.hpp>
#include <pavior/mesh/verify_hexes.hpp>
#include <pavior/smooth/improve_hexes.hpp>

#include "smooth/meshes.hpp"
#include "smooth/solid_meshes.hpp"
#include "support/catch.hpp"

#include <cstddef>
#include <cstdio>
#include <string>

using namespace pavior;
using namespace pavior_test;

namespace {

// Displaces by up to `amount` edges in each direction, improves, prints and checks.
void displace_and_improve(const std::string& name, const HexGrid& mesh, double amount, unsigned seed) {
    const double original = least(mesh);
    REQUIRE(original > 0.5);
    const double edge = (mesh.nodes[mesh.hexes[0][1]] - mesh.nodes[mesh.hexes[0][0]]).norm();
    HexGrid grid = mesh;
    shake(grid, amount * edge, seed);
    const HexGrid before = grid;
    const SmoothReport report = improve_hexes(grid.nodes, grid.hexes, FixedNodes{grid.fixed});
    std::printf("%-13s %5zu hexes, seed %2u, %4.2f edges: %5zu -> %zu inverted, minimum %6.3f -> %6.3f -> %6.3f\n",
                name.c_str(), grid.hexes.size(), seed, amount, report.inverted_before, report.inverted_after, original,
                report.min_det_before, report.min_det_after);
    CAPTURE(name, amount, seed, original);
    CHECK(report.status == (report.inverted_before != 0 ? SmoothStatus::repaired : SmoothStatus::improved));
    CHECK(report.inverted_before >= count_inverted(before.nodes, before.hexes, 1));
    CHECK(report.inverted_before >= (amount > 0.3 ? 50U : 0U));
    CHECK(report.inverted_after == 0);
    CHECK(report.inverted_ids.empty());
    CHECK(count_inverted(grid.nodes, grid.hexes, 1) == 0);
    CHECK(least(grid) >= 0.95 * original);
    CHECK(report.min_det_before == Approx(least(before)).margin(1e-12));
    CHECK(report.min_det_after == Approx(least(grid)).margin(1e-12));
    CHECK(fixed_kept(before, grid));
    CHECK(verify_hexes(HexMeshView<>{grid.nodes, grid.hexes}).ok());
}

void displace_and_improve(const std::string& name, const HexGrid& mesh) {
    for (const double amount : {0.25, 0.5, 2.0}) {
        for (const unsigned seed : {17U, 18U}) {
            displace_and_improve(name, mesh, amount, seed);
        }
    }
}

}  // namespace

TEST_CASE("a displaced box regains 95 % of its quality", "[improve_cases]") {
    displace_and_improve("box", hex_grid(7, 8, 6));
}

TEST_CASE("a displaced twisted sweep regains 95 % of its quality", "[improve_cases]") {
    displace_and_improve("twisted sweep", twisted_sweep(5, 14));
}

TEST_CASE("a displaced sweep between caps that no affine map relates regains 95 %", "[improve_cases]") {
    displace_and_improve("unlike caps", sweep_between_unlike_caps(7, 9));
}

TEST_CASE("a displaced part with several sources and targets regains 95 %", "[improve_cases]") {
    displace_and_improve("many to many", many_to_many_part());
}
