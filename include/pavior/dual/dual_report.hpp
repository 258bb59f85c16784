#pragma once
/// \file
/// What keeps a dual from giving valid hexahedral blocks: kinds, entities, text.

#include <pavior/core/compiled.hpp>
#include <pavior/core/error.hpp>
#include <pavior/core/index.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace pavior {

/// Kinds of violations, with the ids that a DualViolation of this kind carries.
enum class DualFault : std::uint8_t {
    corner_not_three_valent,    ///< a corner of a cell meets not three chains (vertex, cell, chains met)
    corner_not_disc,            ///< a cell touches itself at a vertex (vertex, cell, rings of layer faces)
    chain_closed,               ///< stack edges in a closed loop without a vertex (chain)
    chain_one_vertex,           ///< a chain with one vertex at both ends (chain, vertex)
    chain_dangling,             ///< a chain that ends at no vertex (chain, node)
    patch_not_disc,             ///< a patch that is no open disc (patch, loops round it)
    patch_few_corners,          ///< a patch with fewer than three corners (patch, corners)
    patch_touches_along_chain,  ///< a patch on two sides of one chain (patch, chain)
    patch_touches_at_vertex,    ///< a patch with one vertex at two of its corners (patch, vertex)
    pinched_node,               ///< layer faces that touch at a node without a dual curve there (node)
    dangling_layer,             ///< layer faces that end at edges with no other layer face (patch, edge, such edges)
    cell_not_ball,              ///< a cell that is no open ball (cell)
    cell_on_both_sides,         ///< a cell on both sides of a patch (cell, patch)
    orphan,                     ///< vertex, chain, patch or cell (dimension, id) of no block
};

inline constexpr std::size_t dual_fault_count = 14;

/// The stable name of \p fault, e.g. "chain_closed".
[[nodiscard]] constexpr std::string_view to_string(DualFault fault) noexcept {
    constexpr std::array<std::string_view, dual_fault_count> names{
        "corner_not_three_valent", "corner_not_disc", "chain_closed",      "chain_one_vertex",
        "chain_dangling",          "patch_not_disc",  "patch_few_corners", "patch_touches_along_chain",
        "patch_touches_at_vertex", "pinched_node",    "dangling_layer",    "cell_not_ball",
        "cell_on_both_sides",      "orphan"};
    return names[static_cast<std::size_t>(fault)];
}

/// One violation. Unused ids are no_index.
struct DualViolation {
    DualFault fault = DualFault::orphan;
    std::array<Index, 3> ids{no_index, no_index, no_index};

    friend auto operator<=>(const DualViolation&, const DualViolation&) = default;
};

/// One sentence about \p violation, e.g. "chain 4 has vertex 2 at both ends".
[[nodiscard]] PAVIOR_INLINE std::string describe(const DualViolation& violation);

/// All violations, ascending by kind and ids. Ids of vertices, chains, patches and cells are those of the CellComplex,
/// ids of nodes and edges those of the mesh and its topology.
struct DualReport {
    std::vector<DualViolation> violations;

    /// True if the corners of the cells are valid, conforming blocks.
    [[nodiscard]] bool valid() const { return violations.empty(); }
    [[nodiscard]] std::size_t count(DualFault fault) const {
        return static_cast<std::size_t>(std::count_if(violations.begin(), violations.end(),
                                                      [&](const DualViolation& v) { return v.fault == fault; }));
    }
    /// One line a violation, \p most lines at most; empty if valid.
    [[nodiscard]] std::string text(std::size_t most = 20) const;
    /// Throws UnmeshableError (invalid_dual) with the text and the ids of the first violation; nothing if valid.
    void throw_if_invalid() const;
};

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/dual/dual_report-inl.hpp>
#endif
