#include <pavior/many_to_many/sweep_paths.hpp>

#include "support/catch.hpp"
#include "support/dice.hpp"
#include "support/occ_solids.hpp"
#include "support/path_sweeps.hpp"

#include <cmath>
#include <vector>

using namespace pavior;
using namespace pavior::test;

namespace {

/// A disc of radius r round p, across d.
gmsh::vectorpair disc(const Vec3& p, const Vec3& d, double r) {
    const gmsh::vectorpair result{{2, occ::addDisk(p[0], p[1], p[2], r, r)}};
    const Vec3 axis = Vec3::UnitZ().cross(d);
    if (axis.norm() > 0) {
        occ::rotate(result, p[0], p[1], p[2], axis[0], axis[1], axis[2], std::atan2(axis.norm(), d[2]));
    }
    return result;
}

int point(const Vec3& p) { return occ::addPoint(p[0], p[1], p[2]); }

/// The solid that a disc of radius r at the start of the curve leaves behind.
std::pair<int, int> pipe(int curve, const Vec3& p, const Vec3& d, double r) {
    gmsh::vectorpair out;
    occ::addPipe(disc(p, d, r), occ::addWire({curve}), out);
    for (const auto& entity : out) {
        if (entity.first == 3) {
            return entity;
        }
    }
    throw InputError(ErrorCode::bad_index, "no pipe", {});
}

/// A pipe elbow: two straight legs, a quarter of a circle between them, a flange at each end, and a bore.
void make_elbow() {
    const auto straight = [](const Vec3& p, const Vec3& d, double r) {
        gmsh::vectorpair out;
        occ::extrude(disc(p, d, r), d[0], d[1], d[2], out);
        return out.at(1);
    };
    const auto bend = [](double r) {
        gmsh::vectorpair out;
        occ::revolve(disc({0, 0, 0}, {0, 1, 0}, r), 3, 0, 0, 0, 0, -1, 1.5707963267948966, out);
        return out.at(1);
    };
    const auto whole = [&](double r, gmsh::vectorpair more) {
        more.push_back(straight({0, -2, 0}, {0, 2, 0}, r));
        more.push_back(bend(r));
        more.push_back(straight({3, 3, 0}, {2.5, 0, 0}, r));
        gmsh::vectorpair out;
        std::vector<gmsh::vectorpair> map;
        occ::fuse({more.front()}, {more.begin() + 1, more.end()}, out, map);
        return out;
    };
    const gmsh::vectorpair body =
        whole(1, {straight({0, -2, 0}, {0, 0.6, 0}, 1.8), straight({5, 3, 0}, {0.5, 0, 0}, 2)});
    gmsh::vectorpair out;
    std::vector<gmsh::vectorpair> map;
    occ::cut(body, whole(0.5, {}), out, map);
    occ::rotate(out, 0, 0, 0, 1, 2, 3, 0.7);
    occ::synchronize();
}

/// Pipes along splines, one after the other, each with its own radius.
void make_spline_pipe(const std::vector<std::vector<Vec3>>& splines, const std::vector<double>& radii, double bore) {
    gmsh::vectorpair pieces;
    gmsh::vectorpair holes;
    for (std::size_t i = 0; i < splines.size(); ++i) {
        std::vector<int> points;
        for (const Vec3& p : splines[i]) {
            points.push_back(point(p));
        }
        const int curve = occ::addBezier(points);
        const Vec3 d = (splines[i][1] - splines[i][0]).normalized();
        pieces.push_back(pipe(curve, splines[i][0], d, radii[i]));
        if (bore > 0) {
            holes.push_back(pipe(occ::addBezier(points), splines[i][0], d, bore));
        }
    }
    gmsh::vectorpair out = pieces;
    std::vector<gmsh::vectorpair> map;
    if (pieces.size() > 1) {
        occ::fuse({pieces.front()}, {pieces.begin() + 1, pieces.end()}, out, map);
    }
    if (bore > 0) {
        gmsh::vectorpair rest;
        occ::cut(out, holes, rest, map);
    }
    occ::synchronize();
}

/// Bezier curves that go on smoothly: two to four pieces, in a plane or not.
void make_random_pipe(unsigned seed) {
    Dice dice(seed);
    const bool plane = dice.coin();
    const auto heading = [&](const Vec3& before) {
        const Vec3 turn(dice.real(-1, 1), plane ? 0.0 : dice.real(-1, 1), dice.real(-1, 1));
        return Vec3((before + 0.8 * turn).normalized());
    };
    std::vector<std::vector<Vec3>> splines;
    std::vector<double> radii;
    Vec3 p = Vec3::Zero();
    Vec3 d = Vec3::UnitZ();
    for (int i = dice.whole(2, 4); i > 0; --i) {
        const double length = dice.real(2.5, 5);
        const Vec3 next = heading(d);
        const Vec3 end = p + 0.5 * length * (d + next);
        splines.push_back({p, p + 0.35 * length * d, end - 0.35 * length * next, end});
        double radius = dice.real(0.6, 1.3);
        radius += !radii.empty() && std::abs(radius - radii.back()) < 0.15 ? 0.3 : 0.0;
        radii.push_back(radius);
        p = end;
        d = next;
    }
    make_spline_pipe(splines, radii, dice.coin() ? dice.real(0.2, 0.45) : 0.0);
}

}  // namespace

TEST_CASE("chains of edges go from cap to cap, aside at a step") {
    const GmshBrep model = GmshBrep::build(make_elbow);
    const std::vector<EdgeChain> chains = sweep_paths(model, all_solids(model));
    REQUIRE_FALSE(chains.empty());
    std::size_t good = 0;
    for (const EdgeChain& chain : chains) {
        const auto map = spine_along(model, all_solids(model), chain, 0.4);
        good += map && is_extrusion(UnrolledBrep(model, *map), all_solids(model), Vec3::UnitZ()) ? 1 : 0;
    }
    CHECK(good >= 1);
    const GmshBrep box = GmshBrep::build([] {
        (void)occ::addBox(0, 0, 0, 1, 2, 3);
        occ::synchronize();
    });
    CHECK(sweep_paths(box, all_solids(box)).empty());
    const GmshBrep cylinder = GmshBrep::build([] {
        (void)occ::addCylinder(0, 0, 0, 0, 0, 1, 1);
        occ::synchronize();
    });
    CHECK(sweep_paths(cylinder, all_solids(cylinder)).empty());  // circles are closed
}

TEST_CASE("an unrolled elbow is a straight pipe in the middle of the path") {
    const GmshBrep model = GmshBrep::build([] {
        make_spline_pipe({{{0, 0, 0}, {0, 0, 3}, {3, 0, 3}, {3, 0, 6}}}, {0.8}, 0.0);
    });
    const auto chains = sweep_paths(model, all_solids(model));
    REQUIRE_FALSE(chains.empty());
    const auto map = spine_along(model, all_solids(model), chains.back(), 0.4);
    REQUIRE(map);
    CHECK((map->rolled({0, 0, 0}) - Vec3(0, 0, 0)).norm() < 1e-2);
    detail::for_each_boundary_point(model, all_solids(model), [&](const Vec3& p) {
        CHECK(map->unrolled(p).head<2>().norm() < 0.81);
        CHECK(map->stretch(p) > 0.1);
    });
}

TEST_CASE("a pipe elbow with straight legs and flanges is swept along its path") {
    const GmshBrep model = GmshBrep::build(make_elbow);
    for (const double size : {0.6, 0.3}) {
        const BestMultiSweep best = swept(model, size);
        REQUIRE(best.mesh);
        CHECK_FALSE(best.mesh->path.ribs.empty());
        CHECK(sound(model, *best.mesh));
        CHECK(hex_quality(best.mesh->mesh).scaled_jacobian.min > 0.1);
        CHECK(meshed_faces(*best.mesh).size() == model.face_count());
    }
}

TEST_CASE("random pipes along splines, of changing radius, are swept along their path") {
    sweep_seeds("pipe", seeds("PAVIOR_FUZZ", 4), 0.4, make_random_pipe, [](const SweepPath&) { return true; });
}
