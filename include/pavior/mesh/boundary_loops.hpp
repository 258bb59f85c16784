#pragma once
/// \file
/// The boundary loops of a quad mesh.

#include <pavior/core/error.hpp>
#include <pavior/mesh/edge_table.hpp>

#include <string>
#include <vector>

namespace pavior {

namespace detail {
/// bad_index if a quad has a node out of range or twice.
template <quad_mesh M>
void require_good_quads(const M& mesh) {
    const std::size_t nodes = node_count(mesh);
    for (const Index q : IndexRange(quad_count(mesh))) {
        const QuadCorners c = quad(mesh, q);
        for (std::size_t k = 0; k < 4; ++k) {
            if (c[k] >= nodes) {
                throw InputError(ErrorCode::bad_index,
                                 "quad " + std::to_string(q) + " names node " + std::to_string(c[k]) + " of " +
                                     std::to_string(nodes),
                                 {q});
            }
        }
        if (c[0] == c[1] || c[0] == c[2] || c[0] == c[3] || c[1] == c[2] || c[1] == c[3] || c[2] == c[3]) {
            throw InputError(ErrorCode::bad_index, "quad " + std::to_string(q) + " names a node twice", {q});
        }
    }
}

/// For each boundary node the next one along the boundary, no_index elsewhere.
template <quad_mesh M>
[[nodiscard]] std::vector<Index> boundary_successors(const M& mesh) {
    std::vector<Index> next(node_count(mesh), no_index);
    EdgeTable(mesh).for_each([&](Index low, Index high, std::span<const EdgeTable::Use> uses) {
        const bool upwards = runs_along(quad(mesh, uses[0].quad), low, high);
        const auto name = [&] { return "edge (" + std::to_string(low) + ", " + std::to_string(high) + ") "; };
        if (uses.size() > 2) {
            throw InputError(ErrorCode::non_manifold, name() + "belongs to " + std::to_string(uses.size()) + " quads",
                             {low, high});
        }
        if (uses.size() == 2) {
            if (runs_along(quad(mesh, uses[1].quad), low, high) == upwards) {
                throw InputError(ErrorCode::bad_orientation,
                                 name() + "is run in one sense by quads " + std::to_string(uses[0].quad) + " and " +
                                     std::to_string(uses[1].quad),
                                 {low, high});
            }
            return;
        }
        const Index from = upwards ? low : high;
        if (next[from] != no_index) {
            throw InputError(ErrorCode::non_manifold, "the boundary touches itself at node " + std::to_string(from),
                             {from});
        }
        next[from] = upwards ? high : low;
    });
    return next;
}
}  // namespace detail

/// The boundary of \p mesh as loops that run as its quads do: where these are counter-clockwise, outer loops are
/// counter-clockwise and holes clockwise. Each loop starts at its smallest node id, and loops ascend by it. No loop for
/// a closed or an empty mesh; coordinates are not looked at, and unused nodes do not matter.
/// Throws InputError: bad_index (ids: the quad) where a quad names a node twice or one that does not exist;
/// non_manifold (the two nodes) for an edge of more than two quads, or (the node) where the boundary touches itself;
/// bad_orientation (the two nodes) for an edge run twice in the same sense.
/// O(n) time, 36 bytes a quad and 12 a node; safe to call from several threads.
template <quad_mesh M>
[[nodiscard]] Loops boundary_loops(const M& mesh) {
    detail::require_good_quads(mesh);
    std::vector<Index> next = detail::boundary_successors(mesh);
    Loops loops;
    for (std::size_t start = 0; start < next.size(); ++start) {
        if (next[start] == no_index) {
            continue;
        }
        for (std::size_t at = start; next[at] != no_index;) {
            loops.nodes.push_back(static_cast<Index>(at));
            const Index to = next[at];
            next[at] = no_index;
            at = to;
        }
        loops.offsets.push_back(loops.nodes.size());
    }
    return loops;
}

}  // namespace pavior
