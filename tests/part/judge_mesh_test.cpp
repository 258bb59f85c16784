#include "support/catch.hpp"
#include "support/test_brep.hpp"

#include <pavior/part/judge_mesh.hpp>

#include <utility>

using namespace pavior;
using namespace pavior::test;

namespace {

struct Measured : TestBrep {
    double volume = 1;
    [[nodiscard]] double solid_volume(SolidId) const { return volume; }
    [[nodiscard]] std::string face_kind(FaceId) const { return "Plane"; }
};

MethodTry cube() {
    MethodTry result;
    for (const double z : {0, 1}) {
        for (const auto& [x, y] : {std::pair{0, 0}, std::pair{1, 0}, std::pair{1, 1}, std::pair{0, 1}}) {
            result.data.mesh.nodes.emplace_back(x, y, z);
        }
    }
    result.data.mesh.hexes.push_back({0, 1, 2, 3, 4, 5, 6, 7});
    return result;
}

}  // namespace

TEST_CASE("A mesh of the whole solid is one, one of a part of it is not") {
    Measured b;
    const std::vector<SolidId> solids{add_prism(b, rectangle(1, 1), 0, 1)};
    MethodTry good = cube();
    const MeshCheck check = judge_mesh(b, solids, {}, good);
    CHECK(good.outcome == TryOutcome::mesh);
    CHECK(good.reason.empty());
    CHECK(good.hexahedra == 1);
    CHECK(good.min_jacobian == Approx(1));
    CHECK(good.deviation.cad_volume == 1);
    CHECK(check.valid());
    b.volume = 1.001;
    MethodTry small = cube();
    (void)judge_mesh(b, solids, {}, small);
    CHECK(small.outcome == TryOutcome::invalid);
    CHECK_THAT(small.reason, Catch::Contains("1.001"));
    TestBrep unknown;
    const std::vector<SolidId> other{add_prism(unknown, rectangle(5, 1), 0, 1)};
    MethodTry any = cube();
    (void)judge_mesh(unknown, other, {}, any);
    CHECK_FALSE(any.deviation.cad_volume.has_value());
    CHECK(any.outcome == TryOutcome::mesh);
}

TEST_CASE("Inverted, flat and torn meshes are invalid, and the reason says which") {
    Measured b;
    const std::vector<SolidId> solids{add_prism(b, rectangle(1, 1), 0, 1)};
    MethodTry inverted = cube();
    std::swap(inverted.data.mesh.nodes[0], inverted.data.mesh.nodes[6]);
    (void)judge_mesh(b, solids, {}, inverted);
    CHECK(inverted.outcome == TryOutcome::invalid);
    CHECK_THAT(inverted.reason, Catch::Contains("1 inverted"));
    MethodTry flat = cube();
    flat.data.mesh.nodes[1] = (flat.data.mesh.nodes[0] + flat.data.mesh.nodes[2]) / 2;
    (void)judge_mesh(b, solids, {}, flat);
    CHECK(flat.outcome == TryOutcome::invalid);
    MethodTry torn = cube();
    torn.data.mesh.hexes[0][0] = 99;
    (void)judge_mesh(b, solids, {}, torn);
    CHECK(torn.outcome == TryOutcome::invalid);
    CHECK_FALSE(torn.reason.empty());
}

TEST_CASE("Without time to compare it with the model a mesh that conforms is valid, and a warning says so") {
    Measured b;
    const std::vector<SolidId> solids{add_prism(b, rectangle(1, 1), 0, 1)};
    const auto quads_of = [&](MethodTry& result) {
        result.data.quads = {{0, 3, 2, 1}, {4, 5, 6, 7}};
        result.quad_face = {b.solid_faces(solids[0])[0].face, b.solid_faces(solids[0])[1].face};
    };
    JudgeOptions options;
    options.size = 1;
    MethodTry in_time = cube();
    quads_of(in_time);
    (void)judge_mesh(b, solids, options, in_time);
    CHECK(in_time.outcome == TryOutcome::mesh);
    CHECK(in_time.warnings.empty());
    CHECK(in_time.deviation.distance.value() < 1e-12);
    struct Curved : Measured {
        [[nodiscard]] std::string face_kind(FaceId) const { return "BSpline"; }
    };
    Curved curved;
    const std::vector<SolidId> same{add_prism(curved, rectangle(1, 1), 0, 1)};
    options.out_of_time = [] { return true; };
    MethodTry late = cube();
    quads_of(late);
    (void)judge_mesh(curved, same, options, late);
    CHECK(late.outcome == TryOutcome::mesh);
    CHECK_FALSE(late.deviation.distance.has_value());
    REQUIRE(late.warnings.size() == 1);
    CHECK_THAT(late.warnings[0], Catch::Contains("not checked: out of time"));
}
