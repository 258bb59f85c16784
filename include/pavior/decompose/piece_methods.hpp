#pragma once
/// \file
/// Which methods take a piece of a solid, by recognition alone, and how far one that none takes is from it.

#include <pavior/math/point.hpp>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace pavior {

struct PieceMethods {
    bool submap = false, sweep = false, multi_sweep = false;
    std::size_t leaning = 0;  ///< faces that are neither cap nor side in the direction with the fewest of them
    /// Along which a many-to-many sweep is possible, of length 1; those round an axis are not among them. Filled where
    /// nothing else is possible.
    std::vector<Vec3> directions = {};
    double quality = 2;     ///< least scaled Jacobian of a mesh of it alone, below 0: there is none; 2: not meshed yet
    std::size_t cusps = 0;  ///< edges at which the faces meet at less than 15 degrees

    [[nodiscard]] bool only_multi_sweep() const { return multi_sweep && !submap && !sweep; }
    [[nodiscard]] bool any() const { return quality >= 0 && (submap || sweep || multi_sweep); }
};

/// What \p cost() counts for: cuts that leave few pieces, all of which are meshed, are good.
struct CutCosts {
    double piece = 0.06;       ///< each
    double multi_sweep = 0.2;  ///< a piece that neither submap nor sweep takes: neighbours must be given to it
    double refused = 0.3;      ///< a piece that no method takes, and
    double leaning = 0.8;      ///< for each face that is neither cap nor side
    double cusp = 0.3;         ///< each
    double poor = 0.4;         ///< a piece whose own mesh has a quality below `sufficient`
    double sufficient = 0.2;
    double misfit = 0.5;  ///< pieces that cannot be meshed together
    double clash = 0.25;  ///< two that touch and are only swept many-to-many, in different directions
};

[[nodiscard]] inline double cost(const PieceMethods& piece, const CutCosts& costs = {}) {
    double result = costs.piece + costs.cusp * static_cast<double>(piece.cusps);
    if (!piece.any()) {  // what looked well and cannot be meshed counts as one face that leans
        result += costs.refused +
                  costs.leaning * static_cast<double>(std::max<std::size_t>(piece.leaning, piece.quality < 0 ? 1 : 0));
    } else {
        result += piece.submap || piece.sweep ? 0.0 : costs.multi_sweep;
        result += piece.quality < costs.sufficient ? costs.poor : 0.0;
    }
    return result;
}

}  // namespace pavior
