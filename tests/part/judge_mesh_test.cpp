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
    const auto [check, volume] = judge_mesh(b, solids, sequential, good);
    CHECK(good.outcome == TryOutcome::mesh);
    CHECK(good.reason.empty());
    CHECK(good.hexahedra == 1);
    CHECK(good.min_jacobian == Approx(1));
    CHECK(volume == 1);
    CHECK(check.valid());
    b.volume = 1.001;
    MethodTry small = cube();
    (void)judge_mesh(b, solids, sequential, small);
    CHECK(small.outcome == TryOutcome::invalid);
    CHECK_THAT(small.reason, Catch::Contains("1.001"));
    TestBrep unknown;
    const std::vector<SolidId> other{add_prism(unknown, rectangle(5, 1), 0, 1)};
    MethodTry any = cube();
    CHECK_FALSE(judge_mesh(unknown, other, sequential, any).second.has_value());
    CHECK(any.outcome == TryOutcome::mesh);
}

TEST_CASE("Inverted, flat and torn meshes are invalid, and the reason says which") {
    Measured b;
    const std::vector<SolidId> solids{add_prism(b, rectangle(1, 1), 0, 1)};
    MethodTry inverted = cube();
    std::swap(inverted.data.mesh.nodes[0], inverted.data.mesh.nodes[6]);
    (void)judge_mesh(b, solids, sequential, inverted);
    CHECK(inverted.outcome == TryOutcome::invalid);
    CHECK_THAT(inverted.reason, Catch::Contains("1 inverted"));
    MethodTry flat = cube();
    flat.data.mesh.nodes[1] = (flat.data.mesh.nodes[0] + flat.data.mesh.nodes[2]) / 2;
    (void)judge_mesh(b, solids, sequential, flat);
    CHECK(flat.outcome == TryOutcome::invalid);
    MethodTry torn = cube();
    torn.data.mesh.hexes[0][0] = 99;
    (void)judge_mesh(b, solids, sequential, torn);
    CHECK(torn.outcome == TryOutcome::invalid);
    CHECK_FALSE(torn.reason.empty());
}
