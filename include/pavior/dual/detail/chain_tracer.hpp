#pragma once
/// \file
/// The chains of a cell complex.

#include <pavior/core/disjoint_sets.hpp>
#include <pavior/core/stop.hpp>
#include <pavior/dual/classify.hpp>

#include <algorithm>
#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <span>
#include <stop_token>
#include <tuple>
#include <utility>
#include <vector>

namespace pavior::detail {

/// Runs along stack edges from vertex to vertex.
template <class Complex>
class ChainTracer {
public:
    ChainTracer(const TetTopology& topology, const EntityClasses& classes, Complex& out)
        : topology_(topology), classes_(classes), out_(out), at_node_(topology.node_count(), {no_index, no_index}) {}

    void run(const std::stop_token& stop = {}) {
        number(stop);
        const std::vector<Index> first = first_members(out_.edge_chain, count_);
        std::vector<std::array<Index, 2>> start(count_, {no_index, no_index});  // edge and node
        for (const Index e : stoppable(IndexRange(topology_.edges.size()), stop)) {
            for (const Index i : topology_.edges[e]) {
                const Index chain = out_.edge_chain[e];
                if (chain != no_index && start[chain][0] == no_index && at_node_[i][1] == no_index) {
                    start[chain] = {e, i};
                }
            }
        }
        for (const Index chain : stoppable(IndexRange(count_), stop)) {
            const bool closed = start[chain][0] == no_index;
            const Index e = closed ? first[chain] : start[chain][0];
            const Index from = closed ? topology_.edges[e][0] : start[chain][1];
            trace(e, from);
            out_.chains.push_back({first[chain], {out_.node_vertex[from], out_.node_vertex[out_.chain_nodes.back()]}});
            out_.chain_begin.push_back(static_cast<Index>(out_.chain_nodes.size()));
        }
    }

private:
    void number(const std::stop_token& stop) {
        DisjointSets sets(topology_.edges.size());
        for (const Index e : stoppable(IndexRange(topology_.edges.size()), stop)) {
            if (classes_.edge[e] != EntityClass::stack) {
                continue;
            }
            for (const Index i : topology_.edges[e]) {
                if (classes_.node[i] == EntityClass::stack) {
                    at_node_[i][at_node_[i][0] == no_index ? 0 : 1] = e;
                    sets.unite(e, at_node_[i][0]);
                }
            }
        }
        count_ = number_sets(sets, out_.edge_chain, [&](Index e) { return classes_.edge[e] == EntityClass::stack; });
    }

    void trace(Index e, Index node) {
        const Index first = e;
        out_.chain_nodes.push_back(node);
        do {
            const auto [a, b] = topology_.edges[e];
            node = node == a ? b : a;
            out_.chain_nodes.push_back(node);
            const auto [one, other] = at_node_[node];
            e = other == no_index ? no_index : one == e ? other : one;
        } while (e != no_index && e != first);
    }

    const TetTopology& topology_;
    const EntityClasses& classes_;
    Complex& out_;
    std::vector<std::array<Index, 2>> at_node_;  ///< the stack edges of a node of class stack
    Index count_ = 0;
};

}  // namespace pavior::detail
