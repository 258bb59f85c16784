#include <pavior/glpk/solve_program.hpp>
#include <pavior/submap/submap_check.hpp>

#include "support/catch.hpp"
#include "support/voxel_brep.hpp"

#include <pavior/submap/submap_recognition.hpp>

#include <algorithm>
#include <vector>

using namespace pavior;
using namespace pavior::test;

namespace {

/// Faces that overlap when edge lengths become numbers through `number`.
template <class F>
std::vector<int> overlapping(const Voxels& voxels, F&& number) {
    const VoxelBrep model(voxels, true);
    REQUIRE(model.sound());
    const TestBrep& b = model.brep();
    const SubmapModel submaps = recognise_submaps(b, model.solids(), {}, GlpkSolver{});
    SubmapNumbers numbers;
    for (std::size_t e = 0; e < b.edge_count(); ++e) {
        numbers.edges.push_back(number(b.edge_length(EdgeId{static_cast<std::int32_t>(e)})));
    }
    for (const LogicalFace& face : submaps.faces) {
        numbers.links.emplace_back();
        for (const LoopLink& link : face.links) {
            numbers.links.back().push_back({number(link.length[0]), number(link.length[1])});
        }
    }
    return overlapping_faces(b, submaps, numbers);
}

int rounded(double length) { return static_cast<int>(std::lround(length)); }

Voxels two_pockets() {
    Voxels voxels(3, 3, 3);
    voxels.fill({0, 0, 0}, {3, 3, 3}, 1);
    voxels.fill({1, 1, 0}, {2, 2, 1}, 0);
    voxels.fill({1, 1, 2}, {2, 2, 3}, 0);
    voxels.at[2] = {0, 2, 3, 5};
    return voxels;
}

}  // namespace

TEST_CASE("a sound lattice") { CHECK(overlapping(two_pockets(), rounded).empty()); }

TEST_CASE("pockets that touch or cross on the lattice are told") {
    const std::vector<int> touching = overlapping(two_pockets(), [](double l) { return l > 4 ? 4 : rounded(l); });
    const std::vector<int> crossing = overlapping(two_pockets(), [](double l) { return l > 4 ? 3 : rounded(l); });
    CHECK(std::is_sorted(touching.begin(), touching.end()));
    for (const int floor : {10, 13}) {  // z = 2 and z = 3
        CHECK(std::count(touching.begin(), touching.end(), floor) == 1);
        CHECK(std::count(crossing.begin(), crossing.end(), floor) == 1);
    }
    for (const int outer : {1, 2, 3, 4, 9, 16}) {
        CHECK(std::count(touching.begin(), touching.end(), outer) == 0);
        CHECK(std::count(crossing.begin(), crossing.end(), outer) == 0);
    }
}

TEST_CASE("a face that overlaps itself is told") {
    Voxels voxels(3, 3, 2);
    voxels.fill({0, 0, 0}, {3, 3, 1}, 1);
    voxels.fill({1, 1, 1}, {2, 2, 2}, 1);
    const std::vector<int> found = overlapping(voxels, [](double l) { return l > 2 ? 3 : l == 1.0 ? 5 : rounded(l); });
    CHECK(found == std::vector<int>{6});  // round the boss
}
