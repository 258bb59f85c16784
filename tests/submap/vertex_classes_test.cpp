#include <pavior/submap/vertex_classes.hpp>

#include "support/catch.hpp"
#include "support/test_brep.hpp"

using namespace pavior;
using namespace pavior::test;

namespace {

std::vector<VertexClasses> classes(const std::vector<double>& corners, const std::vector<double>& dihedrals,
                                   double deviation = 60.0) {
    return vertex_classes(corners, dihedrals, {deviation, false});
}

}  // namespace

TEST_CASE("the corner of a box, from within and from without") {
    const auto convex = classes({90, 90, 90}, {90, 90, 90}, 30);
    REQUIRE(convex.size() == 1);
    CHECK(convex[0].cost == 0.0);
    CHECK(convex[0].corner == std::vector<CornerClass>(3, CornerClass::end));
    CHECK(classes({90, 90, 90}, {270, 270, 270}, 30).size() == 1);
    CHECK(classes({90, 90, 90}, {90, 90, 270}, 30).empty());
    CHECK(classes({90, 90, 270}, {90, 90, 270}, 30).empty());
}

TEST_CASE("the foot of a step: one concave edge between two ends and a corner") {
    // faces 90, 90, 270; the edge between the two small ones is concave
    std::size_t found = 0;
    for (const auto& dihedrals : std::vector<std::vector<double>>{{270, 90, 90}, {90, 270, 90}, {90, 90, 270}}) {
        found += classes({90, 90, 270}, dihedrals, 30).size();
    }
    CHECK(found == 1);
}

TEST_CASE("a vertex in an edge, in a face, and where four faces meet") {
    CHECK(classes({180, 180}, {90, 90}, 30).size() == 1);
    CHECK(classes({180, 180}, {90, 270}, 30).empty());
    CHECK(classes({90, 90, 90, 90}, {180, 180, 180, 180}, 30).size() == 1);
    CHECK(classes({90, 90, 180}, {180, 180, 180}, 30).size() == 1);
}

TEST_CASE("ambiguous angles give several ways, each with its cost") {
    const auto ways = classes({135, 90, 90}, {90, 90, 90});
    REQUIRE(!ways.empty());
    for (const VertexClasses& way : ways) {
        double cost = 0.0;
        const std::array<double, 3> corner{135, 90, 90};
        for (std::size_t i = 0; i < 3; ++i) {
            cost += corner_cost(corner[i], way.corner[i]) +
                    0.5 * corner_cost(90, static_cast<CornerClass>(way.dihedral[i]));
        }
        CHECK(way.cost == Approx(cost));
    }
    CHECK(classes({45, 45, 45}, {10, 90, 90}).empty());
}

TEST_CASE("every half-edge of a solid lies in one umbrella, umbrellas turn round their vertices") {
    TestBrep b;
    const SolidBoundary boundary = solid_boundary(b, add_boss(b));
    const std::vector<Umbrella> all = umbrellas(boundary);
    CHECK(all.size() == b.vertex_count());
    std::vector<int> seen(boundary.half_edges.size(), 0);
    for (const Umbrella& umbrella : all) {
        CHECK(umbrella.half_edges.size() == 3);
        for (std::size_t i = 0; i < umbrella.half_edges.size(); ++i) {
            const std::size_t h = umbrella.half_edges[i], next = umbrella.half_edges[(i + 1) % 3];
            ++seen[h];
            CHECK(boundary.half_edges[h].start == umbrella.vertex);
            // the edge of the next one ends at the vertex in the face of this one
            CHECK(boundary.half_edges[boundary.half_edges[next].twin].next == h);
        }
    }
    CHECK(seen == std::vector<int>(seen.size(), 1));
}
