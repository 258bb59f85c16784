#include <pavior/part/sweep_groups.hpp>

#include "support/catch.hpp"
#include "support/occ_solids.hpp"

#include <pavior/cad/gmsh_brep.hpp>

using namespace pavior;
using namespace pavior::test;

namespace {

/// A box with a blind hole from `at` along `axis`.
int drilled(const Vec3& low, const Vec3& size, const Vec3& at, const Vec3& axis) {
    return cut(occ::addBox(low[0], low[1], low[2], size[0], size[1], size[2]),
               {{3, occ::addCylinder(at[0], at[1], at[2], axis[0], axis[1], axis[2], 0.5)}});
}

}  // namespace

TEST_CASE("solids of one direction are one group, the side comes before the cap on it") {
    const GmshBrep model = GmshBrep::build([] {
        share_faces(
            {{3, drilled({4, 0, 0}, {3, 8, 3}, {7, 6, 1.5}, {-1, 0, 0})},  // its cap lies on the side of the next
             {3, drilled({0, 0, 0}, {4, 4, 3}, {2, 2, 3}, {0, 0, -1})},
             {3, drilled({0, 0, 3}, {2, 4, 3}, {1, 2, 6}, {0, 0, -1})}});
    });
    REQUIRE(model.solid_count() == 3);
    const std::vector<SweepGroups> ways = sweep_groups(model, all_solids(model));
    REQUIRE_FALSE(ways.empty());
    const auto& groups = ways[0].groups;
    REQUIRE(groups.size() == 2);
    CHECK(groups[0].size() == 2);
    CHECK(groups[1].size() == 1);
    for (std::size_t i = 0; i + 1 < ways.size(); ++i) {
        CHECK(ways[i].cost <= ways[i + 1].cost);
    }
    CHECK(sweep_groups(model, all_solids(model), 1).size() == 1);
}

TEST_CASE("solids without a straight direction make groups by touching") {
    const GmshBrep model = GmshBrep::build([] {
        share_faces({{3, occ::addSphere(0, 0, 0, 1)}, {3, occ::addSphere(5, 0, 0, 1)}});
    });
    const std::vector<SweepGroups> ways = sweep_groups(model, all_solids(model));
    REQUIRE(ways.size() == 1);
    CHECK(ways[0].groups.size() == 2);
}
