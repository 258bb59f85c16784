#include "support/catch.hpp"
#include "support/shapes.hpp"
#include "sweep/surfaces.hpp"

#include <pavior/mesh/boundary_loops.hpp>
#include <pavior/sweep/folded_quads.hpp>
#include <pavior/sweep/target_projection.hpp>

#include <nlohmann/json.hpp>

#include <cmath>
#include <fstream>
#include <functional>
#include <limits>
#include <numbers>
#include <vector>

using namespace pavior;

namespace {

std::vector<Vec2> points2(const nlohmann::json& list) {
    std::vector<Vec2> out;
    for (const auto& p : list) {
        out.emplace_back(p[0].get<double>(), p[1].get<double>());
    }
    return out;
}

template <class F>
auto map_all(const std::vector<Vec2>& points, const F& f) {
    std::vector<std::decay_t<decltype(f(points[0]))>> out;
    for (const Vec2& p : points) {
        out.push_back(f(p));
    }
    return out;
}

std::vector<Vec2> at_loops(const std::vector<Vec2>& uv, const Loops& loops) {
    std::vector<Vec2> out;
    for (const Index i : loops.nodes) {
        out.push_back(uv[i]);
    }
    return out;
}

template <class S>
std::vector<Vec3> evaluate(const S& surface, const std::vector<Vec2>& uv) {
    return map_all(uv, [&](const Vec2& p) -> Vec3 { return surface.point(p); });
}

/// A flat source cap with its own coordinates as parameters.
struct FlatSource {
    explicit FlatSource(QuadMesh m) : mesh(std::move(m)), loops(boundary_loops(mesh)) {
        for (const Vec3& x : mesh.nodes) {
            uv.emplace_back(x.x(), x.y());
        }
    }
    [[nodiscard]] SourceCap cap() const { return {mesh.nodes, uv, mesh.quads, loops}; }
    QuadMesh mesh;
    Loops loops;
    std::vector<Vec2> uv;
};

/// Projects to \p surface whose loops are the images of the source's loops under \p image.
template <class S, class F>
TargetMesh project(const S& surface, const FlatSource& source, const F& image, const TargetOptions& options = {}) {
    const auto loop_uv = map_all(at_loops(source.uv, source.loops), image);
    return project_target(surface, source.cap(), loop_uv, evaluate(surface, loop_uv), options);
}

TargetOptions plain() {
    TargetOptions options;
    options.correction = TargetCorrection::never;
    options.untangle = false;
    return options;
}

}  // namespace

TEST_CASE("the case file comes out to its tolerance, affine and non affine") {
    std::ifstream file(PAVIOR_TEST_DATA "/sweep/h25_target_projection.json");
    REQUIRE(file);
    const auto data = nlohmann::json::parse(file);
    std::vector<Vec2> uv = points2(data["US"]);
    const std::size_t m = uv.size();
    const auto inner = points2(data["US_inner"]);
    uv.insert(uv.end(), inner.begin(), inner.end());
    Loops loops;
    for (const auto& loop : data["loops"]) {
        loops.add(loop.get<std::vector<Index>>());
    }
    const std::vector<Vec3> nodes = evaluate(surfaces::FlatPlane{}, uv);
    const double tolerance = data["tol_abs"].get<double>();
    for (const auto& run : data["runs"]) {
        const auto loop_uv = points2(run["UT"]);
        const auto target = project_target(surfaces::Sphere{}, {nodes, uv, {}, loops}, loop_uv,
                                           evaluate(surfaces::Sphere{}, loop_uv), plain());
        for (std::size_t j = 0; j < inner.size(); ++j) {
            for (int axis = 0; axis < 2; ++axis) {
                CHECK(std::abs(target.uv[m + j][axis] -
                               run["expected_u"][j][static_cast<std::size_t>(axis)].get<double>()) <= tolerance);
            }
            for (int axis = 0; axis < 3; ++axis) {
                CHECK(std::abs(target.nodes[m + j][axis] -
                               run["expected_xyz"][j][static_cast<std::size_t>(axis)].get<double>()) <= tolerance);
            }
        }
        for (int row = 0; row < 2; ++row) {
            for (int column = 0; column < 2; ++column) {
                CHECK(std::abs(target.map.A(row, column) -
                               run["expected_A"][static_cast<std::size_t>(row)][static_cast<std::size_t>(column)]
                                   .get<double>()) <= tolerance);
            }
        }
    }
}

TEST_CASE("affine loops: exact on any surface, either orientation of the parameters") {
    const FlatSource source(shapes::square_ring(2));
    const auto affine = [](const Vec2& p) {
        return Vec2(0.4 * p.x() + 0.1 * p.y() + 0.2, -0.05 * p.x() + 0.3 * p.y());
    };
    const auto mirrored = [&](const Vec2& p) { return Vec2(affine(p).y(), affine(p).x()); };
    const auto check = [&](const auto& surface, const auto& image, bool reversed) {
        const TargetMesh target = project(surface, source, image);
        CHECK(target.residual < 1e-14);
        CHECK(target.reversed == reversed);
        CHECK(target.folded_by_map.empty());
        CHECK(target.folded.empty());
        CHECK_FALSE(target.corrected);
        CHECK(target.smooth.iterations == 0);
        for (std::size_t j = 0; j < source.uv.size(); ++j) {
            CHECK((target.uv[j] - image(source.uv[j])).norm() < 1e-14);
            CHECK((target.nodes[j] - surface.point(image(source.uv[j]))).norm() < 1e-13);
        }
    };
    check(surfaces::SkewPlane{}, affine, false);
    check(surfaces::Cylinder{}, affine, false);
    check(surfaces::Cylinder{2.0, true}, mirrored, true);
    check(surfaces::Sphere{}, affine, false);
    check(surfaces::Sphere{}, mirrored, true);
    check(surfaces::Saddle{}, affine, false);
    check(surfaces::Torus{}, mirrored, true);
}

TEST_CASE("clockwise loops or clockwise quads in the source parameters change nothing") {
    const auto image = [](const Vec2& p) { return Vec2(0.3 * p.x() * (1.0 + 0.2 * p.y()), 0.3 * p.y()); };
    FlatSource source(shapes::l_shape(3));
    const auto before = project(surfaces::Saddle{}, source, image);
    CHECK_FALSE(before.reversed);
    Loops turned;
    for (std::size_t l = 0; l < source.loops.size(); ++l) {
        const auto loop = source.loops[l];
        turned.add(std::vector<Index>(loop.rbegin(), loop.rend()));
    }
    source.loops = turned;
    const auto after = project(surfaces::Saddle{}, source, image);
    CHECK_FALSE(after.reversed);
    CHECK(after.folded.empty());
    for (std::size_t j = 0; j < source.uv.size(); ++j) {
        CHECK((before.uv[j] - after.uv[j]).norm() < 1e-13);
    }
}

TEST_CASE("loop nodes and their parameters are returned bit by bit") {
    const FlatSource source(shapes::grid_cap(6, 5));
    const auto image = [](const Vec2& p) { return Vec2(0.3 * p.x() + 0.05 * p.y() * p.y(), 0.3 * p.y()); };
    const surfaces::Cylinder surface;
    auto loop_uv = map_all(at_loops(source.uv, source.loops), image);
    auto loop_nodes = evaluate(surface, loop_uv);
    for (Vec3& x : loop_nodes) {
        x += Vec3(1e-7, -1e-7, 1e-7);  // the nodes of a CAD edge lie off the surface a little
    }
    for (const auto correction : {TargetCorrection::never, TargetCorrection::always}) {
        TargetOptions options;
        options.correction = correction;
        const auto target = project_target(surface, source.cap(), loop_uv, loop_nodes, options);
        for (std::size_t i = 0; i < loop_uv.size(); ++i) {
            CHECK(target.uv[source.loops.nodes[i]] == loop_uv[i]);
            CHECK(target.nodes[source.loops.nodes[i]] == loop_nodes[i]);
        }
        CHECK(target.corrected == (correction == TargetCorrection::always));
        for (std::size_t j = 0; j < target.uv.size(); ++j) {
            CHECK((target.nodes[j] - surface.point(target.uv[j])).norm() < 1e-6);
        }
    }
}

TEST_CASE("the correction interpolates the loops and reproduces what is affine") {
    // Next to a boundary node the corrected map follows that node.
    FlatSource source(shapes::grid_cap(8, 8));
    const std::size_t next = 1 * 9 + 4;  // above boundary node 4
    source.uv[next] = source.uv[4] + Vec2(0.0, 1e-9);
    source.mesh.nodes[next] = source.mesh.nodes[4] + Vec3(0.0, 1e-9, 0.0);
    const auto image = [](const Vec2& p) { return Vec2(p.x() + 0.3 * p.y() * p.y(), p.y() - 0.2 * std::sin(p.x())); };
    TargetOptions options = plain();
    CHECK((project(surfaces::FlatPlane{}, source, image, options).uv[next] - image(source.uv[next])).norm() > 1e-3);
    options.correction = TargetCorrection::always;
    CHECK((project(surfaces::FlatPlane{}, source, image, options).uv[next] - image(source.uv[next])).norm() < 1e-8);
}

TEST_CASE("the harmonic correction interpolates the loops too, within their residuals, otherwise than by distances") {
    const FlatSource source(shapes::grid_cap(8, 8));
    const auto image = [](const Vec2& p) { return Vec2(p.x() + 0.3 * p.y() * p.y(), p.y() - 0.2 * std::sin(p.x())); };
    TargetOptions options = plain();
    const TargetMesh none = project(surfaces::FlatPlane{}, source, image, options);
    options.correction = TargetCorrection::always;
    const TargetMesh idw = project(surfaces::FlatPlane{}, source, image, options);
    options.by = BoundaryCorrection::harmonic;
    const TargetMesh harmonic = project(surfaces::FlatPlane{}, source, image, options);
    options.by = BoundaryCorrection::none;
    CHECK_FALSE(project(surfaces::FlatPlane{}, source, image, options).corrected);
    CHECK(harmonic.corrected);
    double apart = 0, moved = 0;
    for (std::size_t j = 0; j < source.uv.size(); ++j) {
        apart = std::max(apart, (harmonic.uv[j] - idw.uv[j]).norm());
        moved = std::max(moved, (harmonic.uv[j] - none.uv[j]).norm());
    }
    CHECK(apart > 1e-3);
    CHECK(moved > 1e-3);
    CHECK(moved <= none.residual * std::sqrt(2.0) * (1 + 1e-9));
}

TEST_CASE("convex source, concave target: folded by the affine map, fold-free in the end") {
    const FlatSource source(shapes::grid_cap(12, 12));
    // The top and bottom of the square are pushed in.
    const auto concave = [](const Vec2& p) {
        const double dent = 0.75 * std::exp(-4.0 * p.x() * p.x());
        return Vec2(p.x(), p.y() * (1.0 - dent));
    };
    const auto check = [&](const auto& surface, const auto& image) {
        const TargetMesh off = project(surface, source, image, plain());
        CHECK(off.folded_by_map.size() > 4);
        CHECK(off.folded == off.folded_by_map);
        CHECK_FALSE(off.corrected);
        for (std::size_t j = 0; j < source.uv.size(); ++j) {
            if (std::abs(source.uv[j].x()) < 0.99 && std::abs(source.uv[j].y()) < 0.99) {
                CHECK((off.uv[j] - off.map(source.uv[j])).norm() == 0.0);
            }
        }
        const TargetMesh on = project(surface, source, image);
        CHECK(on.folded_by_map == off.folded_by_map);
        CHECK(on.folded.empty());
        TargetOptions no_correction;
        no_correction.correction = TargetCorrection::never;
        const TargetMesh untangled = project(surface, source, image, no_correction);
        CHECK(untangled.folded.empty());
        CHECK(untangled.smooth.status == SmoothStatus::repaired);
        return on;
    };
    check(surfaces::FlatPlane{2.0}, concave);
    check(surfaces::Cylinder{}, [&](const Vec2& p) { return Vec2(0.8 * concave(p)); });
    check(surfaces::Cylinder{2.0, true}, [&](const Vec2& p) { return Vec2(concave(p).y(), concave(p).x()); });
    check(surfaces::Sphere{}, [&](const Vec2& p) { return Vec2(0.7 * concave(p)); });
    check(surfaces::Saddle{}, concave);
    check(surfaces::Torus{}, concave);
}

TEST_CASE("a star, a disc with a displaced hole and a square with a deep notch become fold-free") {
    const surfaces::FlatPlane plane{1.0};
    const FlatSource disc(shapes::annulus(48, 8));
    const auto star = [](const Vec2& p) {
        const double r = p.norm();
        const double a = std::atan2(p.y(), p.x());
        const double outer = 1.0 + 0.65 * std::cos(5.0 * a);
        return r > 1.5 ? Vec2(p * outer) : Vec2(p * 0.3);
    };
    const auto displaced = [](const Vec2& p) { return p.norm() > 1.5 ? p : Vec2(0.5 * p + Vec2(1.2, 0.3)); };
    const FlatSource square(shapes::grid_cap(16, 16));
    const auto notched = [](const Vec2& p) {
        return p.y() < 1.0 ? p : Vec2(p.x(), 1.0 - 1.7 * std::max(0.0, 1.0 - 2.0 * std::abs(p.x())));
    };
    for (const TargetMesh& target :
         {project(plane, disc, star), project(plane, disc, displaced), project(plane, square, notched)}) {
        CHECK_FALSE(target.folded_by_map.empty());
        CHECK(target.folded.empty());
    }
}

TEST_CASE("the plane coordinates of a source without a surface") {
    QuadMesh mesh = shapes::square_ring(2);
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(1.1, Vec3(1.0, 2.0, -0.5).normalized()).toRotationMatrix();
    for (Vec3& x : mesh.nodes) {
        x = turn * x + Vec3(1e3, -1e3, 1e3);
    }
    const auto uv = plane_coordinates(mesh.nodes, mesh.quads);
    CHECK(folded_plane_quads(uv, mesh.quads).empty());
    for (std::size_t i = 0; i < uv.size(); ++i) {
        CHECK((uv[i] - uv[0]).norm() == Approx((mesh.nodes[i] - mesh.nodes[0]).norm()).epsilon(1e-9));
    }
    for (Vec3& x : mesh.nodes) {
        x = x.x() * Vec3::UnitX();
    }
    CHECK_THROWS_AS(plane_coordinates(mesh.nodes, mesh.quads), InputError);
}

TEST_CASE("wrong sizes, ids and coordinates are refused") {
    FlatSource source(shapes::grid_cap(3, 3));
    const surfaces::FlatPlane plane;
    const auto loop_uv = at_loops(source.uv, source.loops);
    const auto loop_nodes = evaluate(plane, loop_uv);
    const auto code = [&](const SourceCap& cap, const std::vector<Vec2>& uv, const std::vector<Vec3>& nodes) {
        try {
            static_cast<void>(project_target(plane, cap, uv, nodes));
        } catch (const InputError& error) {
            return error.code();
        }
        return ErrorCode::overflow;
    };
    auto short_uv = loop_uv;
    short_uv.pop_back();
    auto short_nodes = loop_nodes;
    short_nodes.pop_back();
    CHECK(code(source.cap(), short_uv, loop_nodes) == ErrorCode::size_mismatch);
    CHECK(code(source.cap(), loop_uv, short_nodes) == ErrorCode::size_mismatch);
    auto nan_uv = loop_uv;
    nan_uv[2].x() = std::numeric_limits<double>::quiet_NaN();
    CHECK(code(source.cap(), nan_uv, loop_nodes) == ErrorCode::not_finite);
    auto cap_uv = source.uv;
    cap_uv.pop_back();
    CHECK(code({source.mesh.nodes, cap_uv, source.mesh.quads, source.loops}, loop_uv, loop_nodes) ==
          ErrorCode::size_mismatch);
    auto quads = source.mesh.quads;
    quads[1][2] = 99;
    CHECK(code({source.mesh.nodes, source.uv, quads, source.loops}, loop_uv, loop_nodes) == ErrorCode::bad_index);
    Loops loops = source.loops;
    loops.nodes[0] = loops.nodes[1];
    CHECK(code({source.mesh.nodes, source.uv, source.mesh.quads, loops}, loop_uv, loop_nodes) == ErrorCode::bad_index);
    CHECK(code({source.mesh.nodes, source.uv, source.mesh.quads, Loops{}}, {}, {}) == ErrorCode::empty_input);
}
