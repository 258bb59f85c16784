#pragma once
/// \file
/// Which methods take a piece of a solid, by recognition alone, and how far one that none takes is from it.

#include <cstddef>

namespace pavior {

struct PieceMethods {
    bool submap = false, sweep = false, multi_sweep = false;
    std::size_t leaning = 0;  ///< faces that are neither cap nor side in the direction with the fewest of them
    std::size_t cusps = 0;    ///< edges at which the faces meet at less than 15 degrees

    [[nodiscard]] bool any() const { return submap || sweep || multi_sweep; }
};

/// What \p cost() counts for: cuts that leave few pieces, all of which are meshed, are good.
struct CutCosts {
    double piece = 0.06;       ///< each
    double multi_sweep = 0.2;  ///< a piece that neither submap nor sweep takes: neighbours must be given to it
    double refused = 1.0;      ///< a piece that no method takes, and
    double leaning = 0.35;     ///< for each face that is neither cap nor side
    double cusp = 0.3;         ///< each
};

[[nodiscard]] inline double cost(const PieceMethods& piece, const CutCosts& costs = {}) {
    const double methods = piece.submap || piece.sweep ? 0.0
                           : piece.multi_sweep         ? costs.multi_sweep
                                               : costs.refused + costs.leaning * static_cast<double>(piece.leaning);
    return costs.piece + methods + costs.cusp * static_cast<double>(piece.cusps);
}

}  // namespace pavior
