#include "support/catch.hpp"

#include <pavior/marking/marking.hpp>

#include <set>

using namespace pavior;

TEST_CASE("every kind of sheet has a name of its own") {
    std::set<std::string_view> names;
    int kinds = 0;
    for (; to_string(static_cast<SheetKind>(kinds)) != "unknown"; ++kinds) {
        names.insert(to_string(static_cast<SheetKind>(kinds)));
    }
    CHECK(kinds == 8);
    CHECK(names.size() == 8);
    CHECK(to_string(SheetKind::front) == "front");
}
