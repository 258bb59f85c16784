#include <pavior/brep/all_tags.hpp>

#include "support/catch.hpp"
#include "support/test_brep.hpp"

using namespace pavior;
using namespace pavior::test;

namespace {

/// The first solid is a piece of the solids 7 and 3 of the file.
struct Cut : TestBrep {
    [[nodiscard]] std::vector<int> all_tags(int dim, std::size_t index) const {
        return dim == 3 && index == 0 ? std::vector{3, 7} : std::vector{tag(dim, index)};
    }
};

}  // namespace

TEST_CASE("A model without all_tags() has one tag an entity, others have what they say") {
    TestBrep plain;
    (void)add_prism(plain, rectangle(1, 1), 0, 1);
    CHECK(all_tags(plain, 2, 4) == std::vector{5});
    CHECK(has_tag(plain, 3, 0, 1));
    Cut cut;
    (void)add_prism(cut, rectangle(1, 1), 0, 1);
    CHECK(all_tags(cut, 3, 0) == std::vector{3, 7});
    CHECK(has_tag(cut, 3, 0, 7));
    CHECK_FALSE(has_tag(cut, 3, 0, 1));
}

TEST_CASE("The smallest size of any of its tags counts") {
    Cut cut;
    (void)add_prism(cut, rectangle(1, 1), 0, 1);
    CHECK_FALSE(size_by_tag(cut, 3, 0, {}).has_value());
    CHECK_FALSE(size_by_tag(cut, 3, 0, {{1, 0.5}}).has_value());
    CHECK(size_by_tag(cut, 3, 0, {{7, 0.5}}) == 0.5);
    CHECK(size_by_tag(cut, 3, 0, {{7, 0.5}, {3, 0.25}}) == 0.25);
    CHECK(size_by_tag(cut, 2, 1, {{2, 0.125}}) == 0.125);
}
