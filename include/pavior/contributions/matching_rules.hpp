#pragma once
/// \file
/// The matching rules: which candidates become local dual contributions (Algorithms 5.6 to 5.8 \cite roca2009).

#include <pavior/dual/classify.hpp>

#include <cstdint>

namespace pavior {

/// What becomes of a candidate. Regions on both sides are one (none), apart without a primal edge between them (soft),
/// or joined by a primal edge (hard).
enum class Contribution : std::uint8_t { none, soft, hard };

/// How Algorithm 5.8 treats a node of class layer.
enum class VertexRule : std::uint8_t {
    repaired,  ///< soft where the edge is free, none elsewhere
    printed,   ///< soft where neither candidate of the edge was added: leaves the node of a cap of one tetrahedron on a
               ///< boundary face in a region of its own
};

/// Algorithm 5.6: the contribution of c(f; t).
[[nodiscard]] constexpr Contribution match_face(EntityClass face) {
    return face == EntityClass::layer ? Contribution::hard : Contribution::none;
}

/// Algorithm 5.7: the contribution of c(e; f; t), given that of c(f; t).
[[nodiscard]] constexpr Contribution match_edge(EntityClass edge, Contribution face) {
    if (edge == EntityClass::free) {
        return Contribution::none;
    }
    if (face == Contribution::none) {
        return Contribution::soft;
    }
    return edge == EntityClass::layer ? Contribution::none : Contribution::hard;
}

/// Algorithm 5.8: the contribution of c(v; e; t), given those of the two candidates of e.
[[nodiscard]] constexpr Contribution match_vertex(EntityClass node, EntityClass edge, Contribution first,
                                                  Contribution second, VertexRule rule = VertexRule::repaired) {
    const bool absent = first == Contribution::none && second == Contribution::none;
    const bool hard = first == Contribution::hard || second == Contribution::hard;
    switch (node) {
        case EntityClass::free: return Contribution::none;
        case EntityClass::layer:
            return (rule == VertexRule::repaired ? edge == EntityClass::free : absent) ? Contribution::soft
                                                                                       : Contribution::none;
        case EntityClass::stack: return hard ? Contribution::none : Contribution::soft;
        case EntityClass::hexahedron: break;
    }
    return hard ? Contribution::hard : Contribution::soft;
}

}  // namespace pavior
