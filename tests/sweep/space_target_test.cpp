#include "support/catch.hpp"
#include "support/shapes.hpp"
#include "sweep/surfaces.hpp"

#include <pavior/mesh/boundary_loops.hpp>
#include <pavior/sweep/space_target.hpp>

#include <cmath>
#include <vector>

using namespace pavior;

namespace {

struct Source {
    explicit Source(QuadMesh m) : mesh(std::move(m)), loops(boundary_loops(mesh)) {}
    [[nodiscard]] SourceCap cap() const { return {mesh.nodes, {}, mesh.quads, loops}; }
    template <class F>
    [[nodiscard]] std::vector<Vec3> loop_image(const F& image) const {
        std::vector<Vec3> points;
        for (const Index i : loops.nodes) {
            points.push_back(image(mesh.nodes[i]));
        }
        return points;
    }
    QuadMesh mesh;
    Loops loops;
};

Vec3 dented(const Vec3& x) { return {x.x(), x.y() * (1.0 - 0.75 * std::exp(-4.0 * x.x() * x.x())), x.z()}; }

}  // namespace

TEST_CASE("a rigid motion of the loops moves a bulging cap along") {
    const Source source(shapes::grid_cap(8, 8, 0.4));
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(2.1, Vec3(1.0, -2.0, 0.5).normalized()).toRotationMatrix();
    const auto image = [&](const Vec3& x) { return Vec3(turn * x + Vec3(10.0, 20.0, -5.0)); };
    const auto loop = source.loop_image(image);
    const auto target = project_target_in_space(source.cap(), loop);
    CHECK(target.residual < 1e-13);
    CHECK(target.folded_by_map.empty());
    CHECK(target.folded.empty());
    CHECK_FALSE(target.corrected);
    for (std::size_t j = 0; j < target.nodes.size(); ++j) {
        CHECK((target.nodes[j] - image(source.mesh.nodes[j])).norm() < 1e-12);
    }
    for (std::size_t i = 0; i < loop.size(); ++i) {
        CHECK(target.nodes[source.loops.nodes[i]] == loop[i]);
    }
}

TEST_CASE("a concave target of a convex source becomes fold-free, flat or bulging, tilted or not") {
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(1.3, Vec3(1.0, 1.0, 0.2).normalized()).toRotationMatrix();
    for (const double height : {0.0, 0.3}) {
        const Source source(shapes::grid_cap(12, 12, height));
        for (const bool tilted : {false, true}) {
            const auto image = [&](const Vec3& x) { return tilted ? Vec3(turn * dented(x)) : dented(x); };
            const auto loop = source.loop_image(image);
            TargetOptions off;
            off.correction = TargetCorrection::never;
            off.untangle = false;
            const auto plain = project_target_in_space(source.cap(), loop, off);
            CHECK(plain.folded_by_map.size() > 4);
            CHECK(plain.folded == plain.folded_by_map);
            CHECK((plain.nodes[6 * 13 + 6] - plain.map(source.mesh.nodes[6 * 13 + 6])).norm() == 0.0);
            const auto repaired = project_target_in_space(source.cap(), loop);
            CHECK(repaired.folded.empty());
            TargetOptions untangle_only;
            untangle_only.correction = TargetCorrection::never;
            const auto untangled = project_target_in_space(source.cap(), loop, untangle_only);
            CHECK(untangled.folded.empty());
            CHECK(untangled.smooth.status == SmoothStatus::repaired);
            for (std::size_t i = 0; i < loop.size(); ++i) {
                CHECK(untangled.nodes[source.loops.nodes[i]] == loop[i]);
            }
        }
    }
}

TEST_CASE("loops that run against the quads change nothing") {
    Source source(shapes::grid_cap(12, 12));
    Loops turned;
    turned.add(std::vector<Index>(source.loops.nodes.rbegin(), source.loops.nodes.rend()));
    source.loops = turned;
    const auto target = project_target_in_space(source.cap(), source.loop_image(dented));
    CHECK_FALSE(target.folded_by_map.empty());
    CHECK(target.folded.empty());
}

TEST_CASE("a cap with the pole of a sphere in its middle: nodes on the sphere, nothing folded") {
    const Source source(shapes::grid_cap(10, 10));
    const surfaces::Sphere sphere;
    const auto on_sphere = [&](const Vec3& x) { return sphere.point(sphere.closest(x)); };
    const auto image = [&](const Vec3& x) { return on_sphere(Vec3(0.4 * x.x(), 0.4 * x.y(), 0.8)); };
    const auto target = project_target_in_space(on_sphere, source.cap(), source.loop_image(image));
    CHECK(target.folded.empty());
    for (const Vec3& x : target.nodes) {
        CHECK(x.norm() == Approx(1.0).epsilon(1e-14));
        CHECK(x.z() > 0.7);
    }
}

TEST_CASE("loops without a map are refused") {
    const Source source(shapes::grid_cap(4, 4));
    const auto code = [&](const std::vector<Vec3>& loop) {
        try {
            static_cast<void>(project_target_in_space(source.cap(), loop));
        } catch (const InputError& error) {
            return error.code();
        }
        return ErrorCode::overflow;
    };
    auto loop = source.loop_image([](const Vec3& x) { return x; });
    loop.pop_back();
    CHECK(code(loop) == ErrorCode::size_mismatch);
    CHECK(code(source.loop_image([](const Vec3& x) { return Vec3(x.x(), 0.0, 0.0); })) == ErrorCode::target_degenerate);
    CHECK(code(source.loop_image([](const Vec3&) { return Vec3(1.0, std::nan(""), 0.0); })) == ErrorCode::not_finite);
}
