#include "support/catch.hpp"

#include <pavior/core/index.hpp>

#include <iterator>
#include <type_traits>
#include <vector>

using pavior::Id;
using pavior::Index;
using pavior::IndexRange;

TEST_CASE("a range of ids") {
    std::vector<Index> ids;
    for (const Index i : IndexRange(2, 5)) {
        ids.push_back(i);
    }
    CHECK(ids == std::vector<Index>{2, 3, 4});
    CHECK(IndexRange(2, 5).size() == 3);
    CHECK(IndexRange(std::size_t{4}).size() == 4);
    CHECK(IndexRange(std::size_t{0}).begin() == IndexRange(std::size_t{0}).end());
    auto at = IndexRange(std::size_t{3}).begin();
    CHECK(*at++ == 0);
    CHECK(*at == 1);
    static_assert(std::input_iterator<IndexRange::Iterator>);
}

TEST_CASE("ids of different kinds do not mix") {
    using A = Id<struct ATag>;
    using B = Id<struct BTag>;
    static_assert(!std::is_convertible_v<A, B> && !std::is_convertible_v<int, A>);
    CHECK_FALSE(A{}.valid());
    CHECK(A{0}.valid());
    CHECK(A{7}.index() == 7);
    CHECK(A{1} < A{2});
    CHECK(A{1} == A{1});
}
