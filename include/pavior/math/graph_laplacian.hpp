#pragma once
/// \file
/// The Laplacian of a weighted graph, factored for values that are given at some of its nodes.

#include <pavior/core/compiled.hpp>

#include <Eigen/Core>

#include <cstdint>
#include <memory>
#include <span>

namespace pavior {

/// Solves sum_j w_ij (e_i - e_j) = 0 over the edges of every unknown node i, with e_j given at the others: discrete
/// harmonic functions, a mean of their neighbours each. Factored once: sparse LDL^T, about O(n log n) memory and
/// O(n^1.5) time on plane graphs; a solution costs O(n log n). Copies share the factor; const calls are thread-safe.
class GraphLaplacian {
public:
    /// Nodes by number: an unknown has its row 0, 1, ..., a given one -1 - column. Edges between the same two nodes add
    /// up; those between given nodes are left out.
    struct Edge {
        std::int64_t a, b;
        double weight;  ///< positive
    };

    /// No equations.
    GraphLaplacian() = default;
    /// Every unknown must be connected with a given node.
    GraphLaplacian(std::int64_t unknowns, std::int64_t given, std::span<const Edge> edges);

    /// The unknowns for one set of given values, by column. No unknowns: an empty vector.
    [[nodiscard]] Eigen::VectorXd solve(const Eigen::Ref<const Eigen::VectorXd>& given) const;

private:
    struct Factor;
    std::shared_ptr<const Factor> factor_;
};

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/math/graph_laplacian-inl.hpp>
#endif
