#include "support/catch.hpp"

#include <pavior/core/disjoint_sets.hpp>
#include <pavior/core/parallel_for.hpp>

#include <cstdint>
#include <utility>
#include <vector>

using pavior::DisjointSets;
using pavior::Index;

namespace {

using Pairs = std::vector<std::pair<Index, Index>>;

Pairs pairs(Index members, std::size_t count, std::uint32_t seed) {
    Pairs result;
    const auto next = [&] { return (seed = 1664525U * seed + 1013904223U) % members; };
    for (std::size_t i = 0; i < count; ++i) {
        const Index first = next();
        result.emplace_back(first, next());
    }
    return result;
}

/// Roots by walking the graph of pairs, lowest member first.
std::vector<Index> walked(Index members, const Pairs& pairs) {
    std::vector<std::vector<Index>> beside(members);
    for (const auto& [a, b] : pairs) {
        beside[a].push_back(b);
        beside[b].push_back(a);
    }
    std::vector<Index> root(members, pavior::no_index);
    for (Index i = 0; i < members; ++i) {
        std::vector<Index> waiting{i};
        while (!waiting.empty()) {
            const Index at = waiting.back();
            waiting.pop_back();
            if (root[at] == pavior::no_index) {
                root[at] = i;
                waiting.insert(waiting.end(), beside[at].begin(), beside[at].end());
            }
        }
    }
    return root;
}

}  // namespace

TEST_CASE("The root of a set is its smallest member, in whatever order sets are united") {
    for (const Index members : {1U, 7U, 500U}) {
        const Pairs all = pairs(members, members * 3 / 4, members);
        const std::vector<Index> expected = walked(members, all);
        DisjointSets forwards(members);
        DisjointSets<std::size_t> backwards(members);
        DisjointSets hung(members);
        for (std::size_t i = 0; i < all.size(); ++i) {
            const auto& [c, d] = all[all.size() - 1 - i];
            forwards.unite(all[i].first, all[i].second);
            backwards.unite(c, d);
            const Index root = hung.attach(c, hung.root(d));
            CHECK(hung.root(c) == root);
            CHECK(hung.root(d) == root);
        }
        REQUIRE(forwards.size() == members);
        const DisjointSets<>& constant = forwards;
        for (Index i = 0; i < members; ++i) {
            CHECK(constant.root(i) == expected[i]);
            CHECK(forwards.root(i) == expected[i]);
            CHECK(backwards.root(i) == expected[i]);
            CHECK(hung.root(i) == expected[i]);
            CHECK(forwards.same(i, 0) == (expected[i] == 0));
        }
    }
}

TEST_CASE("Sets united by several threads are the same") {
    const Index members = 20000;
    const Pairs all = pairs(members, 15000, 3);
    const std::vector<Index> expected = walked(members, all);
    DisjointSets sets(members);
    pavior::parallel_for({4}, all.size(), 64, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            sets.unite_shared(all[i].first, all[i].second);
        }
    });
    for (Index i = 0; i < members; ++i) {
        REQUIRE(sets.root_shared(i) == expected[i]);
        REQUIRE(sets.root(i) == expected[i]);
    }
}

TEST_CASE("Sets are numbered by their first members in use") {
    DisjointSets sets(7);
    sets.unite(5, 1);
    sets.unite(6, 3);
    sets.unite(3, 0);
    std::vector<Index> id;
    CHECK(pavior::number_sets(sets, id, [](Index) { return true; }) == 4);
    CHECK(id == std::vector<Index>{0, 1, 2, 0, 3, 1, 0});
    CHECK(pavior::first_members(id, 4) == std::vector<Index>{0, 1, 2, 4});

    constexpr Index no = pavior::no_index;
    CHECK(pavior::number_sets(sets, id, [](Index i) { return i % 3 != 0; }) == 3);
    CHECK(id == std::vector<Index>{no, 0, 1, no, 2, 0, no});
}
