#pragma once
/// \file
/// What was found when the solids of a file were intersected with each other.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace pavior {

/// How two solids lie in each other.
enum class OverlapKind : std::uint8_t {
    overlap,    ///< each has a part outside the other
    nested,     ///< the second lies inside the first
    duplicate,  ///< both are the same
};

/// Two solids that have a volume in common. Solids are known by their tags in the file.
struct SolidOverlap {
    std::array<int, 2> solids{};
    OverlapKind kind = OverlapKind::overlap;
    double volume = 0;  ///< that they have in common
};

/// Two solids that nearly touch.
struct SolidGap {
    std::array<int, 2> solids{};
    double distance = 0;  ///< least that was found, not 0
};

/// A piece of solids that were cut by others.
struct SolidPiece {
    std::vector<int> solids;  ///< that it is a piece of, ascending
    double thickness = 0;     ///< twice its volume over its area: that of a plate, less than that of a block
};

/// Lengths and volumes are those of the model.
struct ImprintReport {
    std::vector<SolidOverlap> overlaps;  ///< by solids, ascending
    std::vector<SolidGap> gaps;          ///< the same
    std::vector<SolidPiece> pieces;      ///< of solids in more than one piece, thinnest first
};

/// A sentence for each overlap and each gap.
[[nodiscard]] std::vector<std::string> warnings_of(const ImprintReport& report);

/// \throws UnmeshableError cad_failure naming the solids if one of their pieces is thinner than a hundredth of \p size:
/// such slices come from solids that were meant to touch (CadOptions::imprint_tolerance)
void refuse_slices(const ImprintReport& report, double size);

}  // namespace pavior
