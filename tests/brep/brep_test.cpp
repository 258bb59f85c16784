#include "support/catch.hpp"
#include "support/test_brep.hpp"

#include <pavior/brep/brep.hpp>
#include <pavior/one_to_one/sweep_topology.hpp>

#include <algorithm>
#include <type_traits>
#include <vector>

using namespace pavior;

namespace {

/// A model that lacks one requirement.
struct WithoutPeriods : test::TestBrep {
    void face_period(FaceId) = delete;
};

}  // namespace

static_assert(brep<test::TestBrep>);
static_assert(!brep<WithoutPeriods>);
static_assert(!brep<int>);
static_assert(!std::is_convertible_v<EdgeId, FaceId>);

TEST_CASE("ids are invalid until set, and ordered") {
    CHECK_FALSE(FaceId{}.valid());
    CHECK(FaceId{3}.valid());
    CHECK(FaceId{3}.index() == 3);
    CHECK(FaceId{1} < FaceId{2});
    CHECK(OrientedEdge{EdgeId{1}, false} < OrientedEdge{EdgeId{1}, true});
}

TEST_CASE("the loops of a model run head to tail and use each edge of a solid twice") {
    test::TestBrep b;
    test::add_cylinder(b, 2, 1, 3, 0.5);
    test::add_prism(b, test::l_shape(), 5, 6);
    for (std::size_t s = 0; s < b.solid_count(); ++s) {
        std::vector<int> uses(b.edge_count(), 0);
        for (const OrientedFace& face : b.solid_faces(SolidId{static_cast<std::int32_t>(s)})) {
            for (const EdgeLoop& loop : b.face_loops(face.face)) {
                for (std::size_t i = 0; i < loop.size(); ++i) {
                    CHECK(last_vertex(b, loop[i]) == first_vertex(b, loop[(i + 1) % loop.size()]));
                    uses[loop[i].edge.index()] += loop[i].forward == face.outward ? 1 : -1;
                }
            }
        }
        CHECK(std::all_of(uses.begin(), uses.end(), [](int n) { return n == 0; }));
    }
}
