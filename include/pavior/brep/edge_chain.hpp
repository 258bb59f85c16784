#pragma once
/// \file
/// Edges of a model head to tail.

#include <pavior/brep/brep.hpp>
#include <pavior/core/compiled.hpp>

#include <span>
#include <vector>

namespace pavior {

/// Edges head to tail.
using EdgeChain = std::vector<OrientedEdge>;

/// The chain run the other way round.
[[nodiscard]] PAVIOR_INLINE EdgeChain reversed(std::span<const OrientedEdge> chain);

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

#ifndef PAVIOR_COMPILED
#include <pavior/brep/edge_chain-inl.hpp>
#endif
