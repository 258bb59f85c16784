#pragma once
/// \file
/// Union-find over node, edge, face or tetrahedron ids.

#include <pavior/core/index.hpp>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

namespace pavior::detail {

/// Disjoint sets over [0, n); the root of a set is its smallest member, in whatever order sets were united. 4 bytes a
/// member.
class IndexSets {
public:
    explicit IndexSets(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), Index{0}); }

    [[nodiscard]] std::size_t size() const { return parent_.size(); }
    /// The smallest member of the set of \p i.
    [[nodiscard]] Index root(Index i) {
        while (parent_[i] != i) {
            parent_[i] = parent_[parent_[i]];
            i = parent_[i];
        }
        return i;
    }
    void unite(Index i, Index j) {
        i = root(i);
        j = root(j);
        parent_[std::max(i, j)] = std::min(i, j);
    }
    [[nodiscard]] bool same(Index i, Index j) { return root(i) == root(j); }
    /// Unites the set of \p i with that of which \p root is the root; returns the new root. Fast where i hangs there
    /// already.
    Index attach(Index i, Index root_of_set) {
        if (parent_[i] == root_of_set) {
            return root_of_set;
        }
        const Index other = root(i);
        const Index low = std::min(other, root_of_set);
        parent_[std::max(other, root_of_set)] = low;
        parent_[i] = low;
        return low;
    }

    /// As unite(), from any number of threads at once.
    void unite_shared(Index i, Index j) {
        while (true) {
            i = root_shared(i);
            j = root_shared(j);
            if (i == j) {
                return;
            }
            if (i < j) {
                std::swap(i, j);
            }
            Index expected = i;
            if (at(i).compare_exchange_strong(expected, j, std::memory_order_acq_rel, std::memory_order_relaxed)) {
                return;
            }
        }
    }
    /// As root(), from any number of threads at once.
    [[nodiscard]] Index root_shared(Index i) {
        while (true) {
            Index up = at(i).load(std::memory_order_acquire);
            if (up == i) {
                return i;
            }
            const Index next = at(up).load(std::memory_order_acquire);
            if (next == up) {
                return up;
            }
            at(i).compare_exchange_weak(up, next, std::memory_order_acq_rel, std::memory_order_relaxed);
            i = next;
        }
    }

private:
    [[nodiscard]] std::atomic_ref<Index> at(Index i) { return std::atomic_ref<Index>(parent_[i]); }

    std::vector<Index> parent_;
};

/// Numbers the sets 0, 1, 2 ... in the order of their smallest members: id[i] for members with used(i), else no_index.
/// \returns the number of sets
template <class Used>
[[nodiscard]] Index number_sets(IndexSets& sets, std::vector<Index>& id, const Used& used) {
    id.assign(sets.size(), no_index);
    Index count = 0;
    for (const Index i : IndexRange(sets.size())) {
        if (used(i)) {
            const Index root = sets.root(i);
            if (id[root] == no_index) {
                id[root] = count++;
            }
            id[i] = id[root];
        }
    }
    return count;
}

/// The smallest member of each set of a numbering.
[[nodiscard]] inline std::vector<Index> first_members(const std::vector<Index>& id, Index count) {
    std::vector<Index> first(count, no_index);
    for (const Index i : IndexRange(id.size())) {
        if (id[i] != no_index && first[id[i]] == no_index) {
            first[id[i]] = i;
        }
    }
    return first;
}

}  // namespace pavior::detail
