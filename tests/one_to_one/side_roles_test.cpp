#include <pavior/one_to_one/side_roles.hpp>

#include "support/catch.hpp"
#include "support/test_brep.hpp"

using namespace pavior;
using namespace pavior::test;

TEST_CASE("Opposite roles") {
    CHECK(opposite(SideRole::bottom) == SideRole::top);
    CHECK(opposite(SideRole::top) == SideRole::bottom);
    CHECK(opposite(SideRole::left) == SideRole::right);
    CHECK(opposite(SideRole::right) == SideRole::left);
    CHECK(opposite(SideRole::none) == SideRole::none);
}

TEST_CASE("Roles by contact with the caps make a sweep, and only the right ones do") {
    TestBrep b;
    const SolidBoundary solid =
        solid_boundary(b, add_prism(b, rectangle(3, 3), 0, 2, {{{1, 1}, {1, 2}, {2, 2}, {2, 1}}}));
    const std::vector<SideRole> roles = detail::direct_roles(solid, 0, 1);
    for (std::size_t h = 0; h < roles.size(); ++h) {
        CHECK((roles[h] == SideRole::none) == (solid.half_edges[h].face < 2));
    }
    const auto sweep = detail::sweep_from_roles(solid, 0, 1, roles);
    REQUIRE(sweep);
    CHECK(sweep->loops[0].size() == 4);
    CHECK(sweep->loops[1].size() == 4);
    CHECK_FALSE(sweep->stacked);

    for (std::size_t h = 0; h < roles.size(); ++h) {  // any single wrong role spoils it
        if (roles[h] != SideRole::none) {
            std::vector<SideRole> wrong = roles;
            wrong[h] = static_cast<SideRole>((static_cast<int>(roles[h]) + 1) % 4);
            CHECK_FALSE(detail::sweep_from_roles(solid, 0, 1, wrong));
        }
    }
    CHECK_FALSE(detail::sweep_from_roles(solid, 0, 1, std::vector(roles.size(), SideRole::none)));
    CHECK_FALSE(detail::sweep_from_roles(solid, 2, 4, detail::direct_roles(solid, 2, 4)));
}

TEST_CASE("The four sides of a face are read in any rotation") {
    TestBrep b;
    const SolidBoundary solid = solid_boundary(b, add_prism(b, rectangle(1, 1), 0, 1));
    const std::size_t face = 3, begin = solid.faces[face].begin;
    for (std::size_t rotation = 0; rotation < 4; ++rotation) {
        std::vector<SideRole> roles(solid.half_edges.size(), SideRole::none);
        for (std::size_t i = 0; i < 4; ++i) {
            roles[begin + i] = static_cast<SideRole>((i + rotation) % 4);
        }
        const auto side = detail::side_from_roles(solid, face, roles);
        REQUIRE(side);
        CHECK(side->bottom[0] == solid.half_edges[begin + (4 - rotation) % 4].use);
        CHECK(first_vertex(b, side->left[0]) == first_vertex(b, side->bottom[0]));
        CHECK(last_vertex(b, side->right[0]) == last_vertex(b, side->top[0]));
        std::swap(roles[begin], roles[begin + 2]);
        CHECK_FALSE(detail::side_from_roles(solid, face, roles));
    }
}

TEST_CASE("Upper sides come after those below them") {
    TestBrep b;
    const SolidBoundary solid = solid_boundary(b, add_prism(b, rectangle(1, 1), 0, 1, {}, 2));
    std::vector<SideRole> roles(solid.half_edges.size(), SideRole::none);
    for (std::size_t face = 2; face < solid.faces.size(); ++face) {
        for (std::size_t i = 0; i < 4; ++i) {
            roles[solid.faces[face].begin + i] = static_cast<SideRole>(i);
        }
    }
    const auto sweep = detail::sweep_from_roles(solid, 0, 1, roles);
    REQUIRE(sweep);
    CHECK(sweep->stacked);
    for (std::size_t j = 0; j < 8; ++j) {
        const double z = b.vertex_point(first_vertex(b, sweep->loops[0][j].bottom[0]))[2];
        CHECK(z == Approx(j < 4 ? 0.0 : 0.5).margin(1e-12));
    }
    for (SideRole& role : roles) {  // upside down
        role = opposite(role);
    }
    CHECK(detail::sweep_from_roles(solid, 1, 0, roles));
    CHECK_FALSE(detail::sweep_from_roles(solid, 0, 1, std::vector(roles.size(), SideRole::left)));
}
