#pragma once
/// \file
/// Union-find over node, edge, face or cell ids.

#include <pavior/core/index.hpp>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

namespace pavior {

/// Disjoint sets over [0, n), each member alone at first; \p T (unsigned) holds a member, sizeof(T) bytes each. The
/// root of a set is its smallest member, in whatever order and by however many threads sets were united: what is
/// numbered by roots is the same bytes always. Members are not checked. root() and unite() take O(log n) amortized;
/// they shorten paths, so that only the members named *_shared, and root() of a const object, may be called from
/// several threads.
template <class T = Index>
class DisjointSets {
public:
    explicit DisjointSets(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), T{0}); }

    /// The number of members.
    [[nodiscard]] std::size_t size() const { return parent_.size(); }
    /// The smallest member of the set of \p i.
    [[nodiscard]] T root(T i) {
        while (parent_[i] != i) {
            parent_[i] = parent_[parent_[i]];
            i = parent_[i];
        }
        return i;
    }
    [[nodiscard]] T root(T i) const {
        while (parent_[i] != i) {
            i = parent_[i];
        }
        return i;
    }
    void unite(T i, T j) {
        i = root(i);
        j = root(j);
        parent_[std::max(i, j)] = std::min(i, j);
    }
    [[nodiscard]] bool same(T i, T j) { return root(i) == root(j); }
    /// Unites the set of \p i with that of which \p root_of_set is the root; returns the new root. Fast where \p i
    /// hangs there already.
    T attach(T i, T root_of_set) {
        if (parent_[i] == root_of_set) {
            return root_of_set;
        }
        const T other = root(i);
        const T low = std::min(other, root_of_set);
        parent_[std::max(other, root_of_set)] = low;
        parent_[i] = low;
        return low;
    }

    /// As unite(), from any number of threads at once.
    void unite_shared(T i, T j) {
        while (true) {
            i = root_shared(i);
            j = root_shared(j);
            if (i == j) {
                return;
            }
            if (i < j) {
                std::swap(i, j);
            }
            T expected = i;
            if (at(i).compare_exchange_strong(expected, j, std::memory_order_acq_rel, std::memory_order_relaxed)) {
                return;
            }
        }
    }
    /// As root(), from any number of threads at once.
    [[nodiscard]] T root_shared(T i) {
        while (true) {
            T up = at(i).load(std::memory_order_acquire);
            if (up == i) {
                return i;
            }
            const T next = at(up).load(std::memory_order_acquire);
            if (next == up) {
                return up;
            }
            at(i).compare_exchange_weak(up, next, std::memory_order_acq_rel, std::memory_order_relaxed);
            i = next;
        }
    }

private:
    [[nodiscard]] std::atomic_ref<T> at(T i) { return std::atomic_ref<T>(parent_[i]); }

    std::vector<T> parent_;
};

/// Numbers the sets 0, 1, 2 ... in the order of their smallest members: id[i] for members with used(i), which must hold
/// for all members of a set or for none, else no_index. \returns the number of sets in use
template <class Used>
Index number_sets(DisjointSets<>& sets, std::vector<Index>& id, const Used& used) {
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

}  // namespace pavior
