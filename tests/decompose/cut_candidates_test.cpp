#include "decompose/candidate_checks.hpp"
#include "support/archetypes.hpp"
#include "support/catch.hpp"
#include "support/test_brep.hpp"
#include "support/voxel_brep.hpp"

#include <pavior/decompose/cut_candidates.hpp>

#include <algorithm>
#include <cstddef>
#include <numbers>
#include <random>
#include <string>
#include <variant>
#include <vector>

using namespace pavior;
using namespace pavior::test;

namespace {

/// A square plate [-a, a]^2, 0 <= z <= 1, with a round hole in its middle.
SolidId add_drilled_plate(TestBrep& b, double a, double radius) {
    const Polygon square{{-a, -a}, {a, -a}, {a, a}, {-a, a}};
    const std::vector<VertexId> low = lift(b, square, 0), high = lift(b, square, 1);
    const Ring in_low = add_circle(b, radius, 0), in_high = add_circle(b, radius, 1);
    std::vector<OrientedFace> faces{
        {b.flat({b.polygon(low), {{in_low.e, false}}}, {0, 0, 1}), false},
        {b.flat({b.polygon(high), {{in_high.e, false}}}, {0, 0, 1}), true},
        {add_round_wall(b, in_low, in_high), false},
    };
    add_sides(b, low, high, faces);
    return b.solid(std::move(faces));
}

}  // namespace

TEST_CASE("Nothing cuts a box, in any place") {
    TestBrep b;
    CHECK(cut_candidates(b, add_prism(b, rectangle(3, 2), -1, 4)).empty());
    Voxels voxels(2, 2, 2);
    voxels.fill({0, 0, 0}, {2, 2, 2}, 1);
    const Eigen::AngleAxisd turn(0.7, Vec3(1, 2, 3).normalized());
    const VoxelBrep tilted(voxels, true, [&](const Vec3& x) { return Vec3(turn * x + Vec3(100, -50, 7)); });
    CHECK(cut_candidates(tilted.brep(), SolidId{0}).empty());
}

TEST_CASE("A step gives the planes of its notch, and no others") {
    for (const bool flipped : {false, true}) {
        Voxels voxels(3, 2, 2);
        voxels.at = {std::vector<double>{0, 1, 2.5, 4}, {0, 1, 2}, {0, 0.7, 2}};
        voxels.fill({0, 0, 0}, {3, 2, 2}, 1);
        voxels.fill({2, 0, 1}, {3, 2, 2}, 0);
        const VoxelBrep step(voxels, flipped);
        const std::vector<CutCandidate> candidates = checked_candidates(step.brep(), SolidId{0});
        CHECK(candidates.size() == 2);
        CHECK(has_single(candidates, CutPlane{{2.5, 0, 0}, Vec3::UnitX()}));
        CHECK(has_single(candidates, CutPlane{{0, 0, 0.7}, Vec3::UnitZ()}));
        CHECK(count_of(candidates, CutReason::concave_edge) == 2);
    }
}

TEST_CASE("A boss is cut off by the plane that it stands on") {
    TestBrep b;
    const std::vector<CutCandidate> candidates = checked_candidates(b, add_boss(b));
    CHECK(has_single(candidates, CutPlane{{0, 0, 1}, Vec3::UnitZ()}));
    for (const double at : {1.0, 2.0}) {
        CHECK(has_single(candidates, CutPlane{{at, 0, 0}, Vec3::UnitX()}));
        CHECK(has_single(candidates, CutPlane{{0, at, 0}, Vec3::UnitY()}));
    }
}

TEST_CASE("A hole gives pairs of planes that leave a slab with it, a cylinder round it and planes through its axis") {
    TestBrep b;
    const SolidId plate = add_drilled_plate(b, 3, 1);
    const std::vector<CutCandidate> candidates = checked_candidates(archetype::Brep(b), plate);
    std::size_t pairs = 0;
    for (const CutCandidate& c : candidates) {
        if (c.reason == CutReason::slab && c.surfaces.size() == 2) {
            const auto* one = std::get_if<CutPlane>(&c.surfaces[0]);
            const auto* other = std::get_if<CutPlane>(&c.surfaces[1]);
            REQUIRE((one && other));
            CHECK(one->normal.cross(other->normal).norm() < 1e-9);
            const double sides = one->point.dot(one->normal) * other->point.dot(one->normal);
            CHECK(sides < -1);  // the hole of radius 1 lies between, whole
            ++pairs;
        }
        if (c.reason == CutReason::round_hole) {
            REQUIRE(c.surfaces.size() == 1);
            const auto* cylinder = std::get_if<CutCylinder>(&c.surfaces[0]);
            REQUIRE(cylinder);
            CHECK(cylinder->radius > 1);
            CHECK(cylinder->radius < 3);
            CHECK(cylinder->direction.cross(Vec3::UnitZ()).norm() < 1e-9);
            CHECK(distance_to_line(Vec3::Zero(), {cylinder->point, cylinder->direction}) < 1e-9);
        }
    }
    CHECK(pairs >= 2);
    CHECK(count_of(candidates, CutReason::round_hole) >= 1);
    CHECK(has_single(candidates, CutPlane{Vec3::Zero(), Vec3::UnitX()}));
    CHECK(has_single(candidates, CutPlane{Vec3::Zero(), Vec3::UnitY()}));
    CHECK(count_of(candidates, CutReason::concave_edge) == 0);
}

TEST_CASE("Where there is no room round a hole no cylinder is laid round it") {
    TestBrep b;
    const std::vector<CutCandidate> candidates = checked_candidates(b, add_cylinder(b, 1.05, 1.05, 2, 1));
    CHECK(count_of(candidates, CutReason::round_hole) == 0);
    CHECK(count_of(candidates, CutReason::slab) == 0);
    CHECK(count_of(candidates, CutReason::axis_plane) > 0);
}

TEST_CASE("A shaft that steps is cut off at its shoulder") {
    TestBrep b;
    const Ring low = add_circle(b, 2, 0), rim = add_circle(b, 2, 1), foot = add_circle(b, 1, 1),
               high = add_circle(b, 1, 3);
    const SolidId shaft = b.solid({{b.flat({{{low.e, true}}}, {0, 0, 1}), false},
                                   {b.flat({{{rim.e, true}}, {{foot.e, false}}}, {0, 0, 1}), true},
                                   {b.flat({{{high.e, true}}}, {0, 0, 1}), true},
                                   {add_round_wall(b, low, rim), true},
                                   {add_round_wall(b, foot, high), true}});
    const std::vector<CutCandidate> candidates = checked_candidates(b, shaft);
    CHECK(has_single(candidates, CutPlane{{0, 0, 1}, Vec3::UnitZ()}));
}

TEST_CASE("Candidates of random solids divide them, none comes twice, and they are the same each time") {
    std::mt19937 random(7);
    std::size_t looked_at = 0;
    for (int i = 0; i < 60; ++i) {
        const VoxelBrep solid(random_voxels(random, 4, 5, 2), i % 2 == 0);
        if (!solid.sound()) {
            continue;
        }
        for (const SolidId s : solid.solids()) {
            CAPTURE(i, s.value);
            const std::vector<CutCandidate> candidates = checked_candidates(solid.brep(), s);
            const std::vector<CutCandidate> again = cut_candidates(solid.brep(), s);
            REQUIRE(again.size() == candidates.size());
            for (std::size_t c = 0; c < again.size(); ++c) {
                CHECK(again[c].reason == candidates[c].reason);
                REQUIRE(again[c].surfaces.size() == candidates[c].surfaces.size());
                for (std::size_t k = 0; k < again[c].surfaces.size(); ++k) {
                    CHECK(same_surface(again[c].surfaces[k], candidates[c].surfaces[k], 1e-15));
                }
            }
            const std::vector<EdgeAngle> angles = edge_angles(solid.brep(), s);
            const bool notched =
                std::any_of(angles.begin(), angles.end(), [](const EdgeAngle& a) { return a.concave(); });
            CHECK((!notched || !candidates.empty()));
            ++looked_at;
        }
    }
    CHECK(looked_at > 20);
}

TEST_CASE("Ranges of azimuths go round the least way, over 180 degrees, too; a cylinder goes all round its axis") {
    const auto [begin, width] = detail::azimuth_range({170, -170, 178});
    CHECK(begin == 170);
    CHECK(width == Approx(20));
    CHECK(detail::azimuth_range({30}).second == Approx(0).margin(1e-12));
    TestBrep b;
    add_cylinder(b, 2, 2, 3);
    CHECK(detail::degrees_round(b, FaceId{0}, {Vec3::Zero(), Vec3::UnitZ()}) > 300);
    const std::vector<FaceId> wall{FaceId{0}};
    CHECK(detail::square_corners(b, std::span<const FaceId>(wall), {Vec3::Zero(), Vec3::UnitZ()}, Vec3::UnitX()) ==
          std::vector<double>{45, 135, 225, 315});
}
