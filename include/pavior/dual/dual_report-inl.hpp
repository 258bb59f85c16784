#pragma once

#include <pavior/dual/dual_report.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <string_view>

namespace pavior {

PAVIOR_INLINE std::string describe(const DualViolation& violation) {
    const auto id = [&](std::size_t k) { return std::to_string(violation.ids[k]); };
    switch (violation.fault) {
        case DualFault::corner_not_three_valent:
            return "the corner of cell " + id(1) + " at vertex " + id(0) + " meets " + id(2) + " chains, not 3";
        case DualFault::corner_not_disc:
            return "cell " + id(1) + " touches itself at vertex " + id(0) + " (" + id(2) + " rings of layer faces)";
        case DualFault::chain_closed: return "chain " + id(0) + " is closed and has no vertex";
        case DualFault::chain_one_vertex: return "chain " + id(0) + " has vertex " + id(1) + " at both ends";
        case DualFault::chain_dangling: return "chain " + id(0) + " ends at node " + id(1) + ", which is no vertex";
        case DualFault::patch_not_disc: return "patch " + id(0) + " is no disc (" + id(1) + " loops round it)";
        case DualFault::patch_few_corners: return "patch " + id(0) + " has " + id(1) + " corners, fewer than 3";
        case DualFault::patch_touches_along_chain: return "patch " + id(0) + " touches itself along chain " + id(1);
        case DualFault::patch_touches_at_vertex: return "patch " + id(0) + " touches itself at vertex " + id(1);
        case DualFault::pinched_node: return "layer faces touch at node " + id(0);
        case DualFault::dangling_layer:
            return "patch " + id(0) + " ends freely at " + id(2) + " edges, the first of them edge " + id(1);
        case DualFault::cell_not_ball: return "cell " + id(0) + " is no ball";
        case DualFault::cell_on_both_sides: return "cell " + id(0) + " lies on both sides of patch " + id(1);
        case DualFault::orphan: break;
    }
    constexpr std::array<std::string_view, 4> kinds{"vertex ", "chain ", "patch ", "cell "};
    return std::string(kinds[std::min<std::size_t>(violation.ids[0], 3)]) + id(1) + " belongs to no block";
}

PAVIOR_INLINE std::string DualReport::text(std::size_t most) const {
    std::string lines;
    for (std::size_t i = 0; i < std::min(most, violations.size()); ++i) {
        lines += (i == 0 ? "" : "\n") + describe(violations[i]);
    }
    return violations.size() <= most ? lines : lines + "\n... " + std::to_string(violations.size() - most) + " more";
}

PAVIOR_INLINE void DualReport::throw_if_invalid() const {
    if (!valid()) {
        Error::Ids ids;
        for (const Index i : violations.front().ids) {
            if (i != no_index) {
                ids.push_back(i);
            }
        }
        throw UnmeshableError(ErrorCode::invalid_dual, text(), ids);
    }
}

}  // namespace pavior
