#include <pavior/many_to_many/unrolled_brep.hpp>

#include "support/catch.hpp"
#include "support/test_brep.hpp"

#include <cmath>
#include <vector>

using namespace pavior;
using namespace pavior::test;

namespace {

/// Coordinates of an archetype: the members of the concept, and nothing else.
struct Doubled {
    Doubled() = default;
    Doubled(const Doubled&) = delete;
    Doubled& operator=(const Doubled&) = delete;
    [[nodiscard]] Vec3 unrolled(const Vec3& p) const { return {p[0], p[1], 2 * p[2]}; }
    [[nodiscard]] Vec3 rolled(const Vec3& q) const { return {q[0], q[1], q[2] / 2}; }
    [[nodiscard]] Vec3 unrolled(const Vec3&, const Vec3& d) const { return {d[0], d[1], 2 * d[2]}; }
};
static_assert(path_coordinates<Doubled>);

}  // namespace

TEST_CASE("a model is seen in other coordinates") {
    TestBrep b;
    const SolidId solid = add_prism(b, l_shape(), 0, 1);
    const Doubled map;
    const UnrolledBrep view(b, map);
    static_assert(brep<UnrolledBrep<TestBrep, Doubled>>);
    CHECK(view.face_count() == b.face_count());
    double longest = 0;
    for (std::size_t e = 0; e < b.edge_count(); ++e) {
        longest = std::max(longest, view.edge_length(EdgeId{static_cast<std::int32_t>(e)}));
    }
    CHECK(longest == Approx(2).epsilon(1e-12));
    const FaceId top = b.solid_faces(solid)[1].face;
    const Vec2 uv = view.closest_on_face(top, {0.3, 0.4, 5});
    CHECK((view.face_point(top, uv) - Vec3(0.3, 0.4, 2)).norm() < 1e-12);
    double high = 0;
    std::size_t points = 0;
    detail::for_each_boundary_point(b, std::vector{solid}, [&](const Vec3& p) {
        high = std::max(high, p[2]);
        ++points;
    });
    CHECK(high == 1);
    CHECK(points > 129 * 2 * b.edge_count());  // each edge has two faces
}
