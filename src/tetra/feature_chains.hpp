#pragma once
// Edges strung together. Internal to the tetra component.

#include "problem.hpp"

#include <vector>

namespace pavior::detail {

/// A run of edges between two ends, or a closed one whose first node is also its last.
struct FeatureChain {
    std::vector<Index> nodes;
    int number = 0;  ///< of the tagged edges it is made of; 0: a sharp edge without tag
};

/// Chains of tagged edges with one tag, and of the other edges between tags or sharper than \p degrees. They meet at
/// their ends only; tagged vertices are ends.
[[nodiscard]] std::vector<FeatureChain> feature_chains(const Problem& problem, double degrees);

}  // namespace pavior::detail
