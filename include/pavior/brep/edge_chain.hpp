#pragma once
/// \file
/// Edges of a model head to tail.

#include <pavior/brep/brep.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace pavior {

/// Edges head to tail.
using EdgeChain = std::vector<OrientedEdge>;

/// The chain run the other way round.
[[nodiscard]] inline EdgeChain reversed(std::span<const OrientedEdge> chain) {
    EdgeChain result;
    result.reserve(chain.size());
    for (std::size_t i = chain.size(); i-- > 0;) {
        result.push_back({chain[i].edge, !chain[i].forward});
    }
    return result;
}

/// The vertex where \p use begins.
template <brep B>
[[nodiscard]] VertexId first_vertex(const B& b, OrientedEdge use) {
    return b.edge_vertices(use.edge)[use.forward ? 0 : 1];
}

/// The vertex where \p use ends.
template <brep B>
[[nodiscard]] VertexId last_vertex(const B& b, OrientedEdge use) {
    return b.edge_vertices(use.edge)[use.forward ? 1 : 0];
}

}  // namespace pavior
