#pragma once
/// \file
/// Which fronts share one sheet.

#include <pavior/core/compiled.hpp>
#include <pavior/marking/fronts.hpp>
#include <pavior/marking/marking.hpp>

#include <span>
#include <vector>

namespace pavior {

/// Fronts on one surface.
struct SheetMember {
    PatchSurface surface;
    double sign = 1.0;          ///< of its distance in the field of the group
    std::vector<Index> fronts;  ///< ascending
};

/// One sheet to be: a surface, or several that the sheet blends.
struct SheetGroup {
    SheetKind kind = SheetKind::front;
    std::vector<SheetMember> members;
};

/// The sheets that the fronts ask for, in the order of their first fronts, those on reversal curves last. Fronts of
/// one surface (within \p tolerance, a length) share a sheet, and so do the two of a reversal curve; with
/// Grouping::blended also those that face each other on surfaces that deviate by \p blend_angle degrees at most.
/// O(F^2 n) for F fronts.
[[nodiscard]] PAVIOR_INLINE std::vector<SheetGroup> sheet_groups(std::span<const Front> fronts,
                                                                 const FrontBoundary& boundary,
                                                                 std::span<const Vec3> nodes, Grouping grouping,
                                                                 double tolerance, double blend_angle);

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/marking/groups-inl.hpp>
#endif
