#include <pavior/many_to_many/revolution.hpp>

#include "support/catch.hpp"
#include "support/dice.hpp"
#include "support/occ_solids.hpp"
#include "support/path_sweeps.hpp"
#include "support/test_brep.hpp"

#include <numbers>

using namespace pavior;
using namespace pavior::test;

namespace {

constexpr double pi = std::numbers::pi;

/// A disc of radius r round (x, 0, z) in the x-z plane, turned about the z axis from one angle to another, in degrees.
std::pair<int, int> bent_pipe(double r, double x, double z, double from, double to) {
    const int disc = occ::addDisk(x, 0, z, r, r);
    occ::rotate({{2, disc}}, x, 0, z, 1, 0, 0, pi / 2);
    occ::rotate({{2, disc}}, 0, 0, 0, 0, 0, 1, from * pi / 180);
    gmsh::vectorpair out;
    occ::revolve({{2, disc}}, 0, 0, 0, 0, 0, 1, (to - from) * pi / 180, out);
    return out.at(1);
}

/// Unites pieces, takes others away and turns what is left in space.
void combine(const gmsh::vectorpair& pieces, const gmsh::vectorpair& holes, Dice& dice) {
    gmsh::vectorpair solid{pieces.front()};
    std::vector<gmsh::vectorpair> map;
    if (pieces.size() > 1) {
        occ::fuse({pieces.front()}, {pieces.begin() + 1, pieces.end()}, solid, map);
    }
    if (!holes.empty()) {
        gmsh::vectorpair rest;
        occ::cut(solid, holes, rest, map);
        solid = rest;
    }
    occ::rotate(solid, 0, 0, 0, dice.real(-1, 1), dice.real(-1, 1), dice.real(-1, 1), dice.real(0, 3));
    occ::translate(solid, dice.real(-9, 9), dice.real(-9, 9), dice.real(-9, 9));
    occ::synchronize();
}

/// A pipe bend of 90 degrees with a flange and a collar.
void make_elbow() {
    Dice dice(1);
    combine({bent_pipe(1.6, 4, 0, 0, 15), bent_pipe(1, 4, 0, 15, 50), bent_pipe(1.4, 4, 0, 50, 62),
             bent_pipe(1, 4, 0, 62, 90)},
            {bent_pipe(0.5, 4, 0, 0, 90)}, dice);
}

/// A bend whose radius changes up to five times, with a blind or a through hole.
void make_bend(unsigned seed) {
    Dice dice(seed);
    gmsh::vectorpair pieces;
    double angle = dice.real(0, 90);
    const double first = angle;
    double last_radius = 0;
    for (int i = dice.whole(2, 5); i > 0; --i) {
        const double next = angle + dice.real(12, 50);
        double radius = dice.real(0.8, 2);
        radius += std::abs(radius - last_radius) < 0.15 ? 0.3 : 0;
        pieces.push_back(bent_pipe(radius, 5, 0, angle, next));
        last_radius = radius;
        angle = next;
    }
    gmsh::vectorpair holes;
    if (dice.whole(0, 2) > 0) {
        holes.push_back(bent_pipe(dice.real(0.3, 0.6), 5, dice.real(-0.1, 0.1), first - 1,
                                  dice.whole(0, 1) == 0 ? angle + 1 : 0.5 * (first + angle)));
    }
    combine(pieces, holes, dice);
}

}  // namespace

TEST_CASE("unrolling keeps lengths at its radius, and can be undone") {
    const Axis axis{{1, 2, 3}, Vec3(1, 2, 2) / 3};
    const Unrolling map(axis, {1, 0, 0}, 2.5);
    Dice dice(3);
    for (int i = 0; i < 50; ++i) {
        const Vec3 q(dice.real(0.5, 4), dice.real(-7, 7), dice.real(-3, 3));
        const Vec3 p = map.rolled(q);
        CHECK((map.unrolled(p) - q).norm() < 1e-13);
        const Vec3 d(dice.real(-1, 1), dice.real(-1, 1), dice.real(-1, 1));
        const double h = 1e-5;
        CHECK((map.unrolled(p, d) - (map.unrolled(p + h * d) - map.unrolled(p - h * d)) / (2 * h)).norm() < 1e-8);
        CHECK((map.rolled({2.5, 1e-4, q[2]}) - map.rolled({2.5, 0, q[2]})).norm() == Approx(1e-4));
    }
    Eigen::Matrix3d image;
    for (int k = 0; k < 3; ++k) {
        image.col(k) = map.unrolled({5, 4, 3}, Vec3::Unit(k));
    }
    CHECK(image.determinant() > 0);  // right-handed to right-handed
}

TEST_CASE("the axes of cylinders, cones and tori are found, those of planes and spheres are none") {
    test::TestBrep b;
    test::add_cylinder(b, 1, 0.6, 2, 0.3);
    const std::vector<Axis> axes = revolution_axes(b, std::vector{SolidId{0}});
    REQUIRE(axes.size() == 1);
    CHECK(axes[0].direction.cross(Vec3::UnitZ()).norm() < 1e-9);
    CHECK(axes[0].origin.head<2>().norm() < 1e-9);
    test::TestBrep box;
    test::add_prism(box, test::rectangle(2, 1), 0, 1);
    CHECK(revolution_axes(box, std::vector{SolidId{0}}).empty());

    const GmshBrep torus = GmshBrep::build([] {
        (void)bent_pipe(1, 4, 0.5, 0, 100);
        occ::synchronize();
    });
    const std::vector<Axis> bend = revolution_axes(torus, all_solids(torus));
    REQUIRE(bend.size() == 1);
    CHECK(bend[0].direction.cross(Vec3::UnitZ()).norm() < 1e-6);
    CHECK(bend[0].origin.head<2>().norm() < 1e-6);
    const GmshBrep sphere = GmshBrep::build([] {
        (void)occ::addSphere(0, 0, 0, 1);
        occ::synchronize();
    });
    CHECK(revolution_axes(sphere, all_solids(sphere)).empty());
}

TEST_CASE("solids are unrolled where they leave a gap") {
    const auto unrolled = [](double x, double from, double to) {
        const GmshBrep model = GmshBrep::build([&] {
            (void)bent_pipe(1, x, 0, from, to);
            occ::synchronize();
        });
        return unroll_round(model, all_solids(model), {}, 0.5).has_value();
    };
    CHECK(unrolled(4, 0, 90));
    CHECK(unrolled(4, 100, 400));  // beyond the half plane where an angle would be cut by default
    CHECK_FALSE(unrolled(4, 0, 355));
    CHECK_FALSE(unrolled(4, 0, 360));
    const GmshBrep wedge = GmshBrep::build([] {
        (void)occ::addCylinder(0, 0, 0, 0, 0, 1, 1, -1, pi / 2);
        occ::synchronize();
    });
    CHECK_FALSE(unroll_round(wedge, all_solids(wedge), {}, 0.5));  // an edge on the axis
}

TEST_CASE("an unrolled bend is a straight cylinder") {
    const GmshBrep model = GmshBrep::build([] {
        (void)bent_pipe(1, 4, 0, 200, 290);
        occ::synchronize();
    });
    const std::vector<SolidId> solids = all_solids(model);
    const auto map = unroll_round(model, solids, {}, 0.5);
    REQUIRE(map);
    CHECK(map->radius() == Approx(4).epsilon(1e-3));
    const UnrolledBrep straight(model, *map);
    static_assert(brep<UnrolledBrep<GmshBrep, Unrolling>>);
    const Extrusion along = extrusion_along(straight, solids, Vec3::UnitY());
    CHECK(along.possible());
    CHECK(along.caps == 2);
    CHECK(along.slanted == 0);
    double longest = 0;
    for (std::size_t e = 0; e < model.edge_count(); ++e) {
        const EdgeId id{static_cast<std::int32_t>(e)};
        const auto range = straight.edge_range(id);
        const double t = 0.3 * range[0] + 0.7 * range[1];
        const double h = 1e-5;
        const Vec3 slope = (straight.edge_point(id, t + h) - straight.edge_point(id, t - h)) / (2 * h);
        CHECK((straight.edge_derivative(id, t) - slope).norm() < 1e-6);
        longest = std::max(longest, straight.edge_length(id));
    }
    CHECK(longest == Approx(2 * pi).epsilon(0.01));  // caps 2 pi round and 2 pi apart
    for (std::size_t f = 0; f < model.face_count(); ++f) {
        const FaceId id{static_cast<std::int32_t>(f)};
        const Vec2 uv = model.face_interior(id);
        const Vec3 x = straight.face_point(id, uv);
        CHECK((straight.face_point(id, straight.closest_on_face(id, x)) - x).norm() < 1e-9);
    }
}

TEST_CASE("a pipe bend with a flange and a collar is swept round its axis") {
    const GmshBrep model = GmshBrep::build(make_elbow);
    for (const double size : {0.7, 0.35}) {
        const BestMultiSweep best = swept(model, size);
        REQUIRE(best.mesh);
        REQUIRE(best.mesh->path.axis);
        CHECK(sound(model, *best.mesh));
        CHECK(hex_quality(best.mesh->mesh).scaled_jacobian.min > 0.1);
        CHECK(meshed_faces(*best.mesh).size() == model.face_count());
    }
}

TEST_CASE("random bends of changing radius are swept round their axis") {
    sweep_seeds("bend", seeds("PAVIOR_FUZZ", 6), 0.5, make_bend, [](const SweepPath& path) { return path.axis; });
}
