#include "support/catch.hpp"

#include <pavior/dual/detail/index_sets.hpp>

using namespace pavior;

TEST_CASE("sets have their smallest member as root, and are numbered by it") {
    detail::IndexSets sets(7);
    sets.unite(5, 3);
    sets.unite(6, 5);
    sets.unite_shared(2, 4);
    CHECK(sets.root(6) == 3);
    CHECK(sets.root_shared(4) == 2);
    CHECK(sets.same(6, 3));
    CHECK_FALSE(sets.same(6, 2));
    CHECK(sets.attach(0, 2) == 0);
    CHECK(sets.same(4, 0));
    std::vector<Index> id;
    CHECK(detail::number_sets(sets, id, [](Index i) { return i != 1; }) == 2);
    CHECK(id == std::vector<Index>{0, no_index, 0, 1, 0, 1, 1});
    CHECK(detail::first_members(id, 2) == std::vector<Index>{0, 3});
}
