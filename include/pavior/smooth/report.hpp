#pragma once
/// \file
/// What an untangling did.

#include <pavior/core/index.hpp>

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace pavior {

/// Outcome of untangle_quads(), untangle_surface_quads(), untangle_hexes() and improve_hexes(). The names are stable.
enum class SmoothStatus : std::uint8_t {
    unchanged,       ///< nothing was inverted, nothing to gain: not a node moved
    repaired,        ///< something was inverted, nothing is any more
    still_inverted,  ///< some cells could not be repaired; the mesh is the input or has fewer inverted cells
    improved,        ///< nothing was inverted, but nodes were moved for the quality
};

/// The stable name of \p status, e.g. "still_inverted".
[[nodiscard]] constexpr std::string_view to_string(SmoothStatus status) noexcept {
    switch (status) {
        case SmoothStatus::unchanged: return "unchanged";
        case SmoothStatus::repaired: return "repaired";
        case SmoothStatus::still_inverted: return "still_inverted";
        case SmoothStatus::improved: return "improved";
    }
    return "unknown";
}

/// Report of one untangling or improvement. "det" is the determinant of the unit edge vectors at a corner (for
/// hexahedra also of the unit axes at the centre): the scaled Jacobian, in [-1, 1], 1 for a rectangle or box, 0 where
/// an edge is null. A cell is inverted if one of its determinants is not above 1e-12. Minima are over the whole mesh;
/// 1 without cells.
struct SmoothReport {
    SmoothStatus status = SmoothStatus::unchanged;
    std::size_t inverted_before = 0;
    std::size_t inverted_after = 0;
    std::vector<Index> inverted_ids;  ///< cells inverted afterwards, ascending, UntangleOptions::max_ids at most
    double min_det_before = 1.0;
    double min_det_after = 1.0;
    int iterations = 0;           ///< iterations of the minimiser, all attempts together
    std::size_t moved_nodes = 0;  ///< nodes that were given a new place
};

}  // namespace pavior
