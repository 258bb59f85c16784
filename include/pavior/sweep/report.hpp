#pragma once
/// \file
/// What a sweep reports besides its nodes.

#include <pavior/core/compiled.hpp>
#include <pavior/core/error.hpp>

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace pavior {

/// Things worth knowing that are no errors.
enum class SweepNotice : std::uint8_t {
    ambiguous_normal,  ///< method h: the sign of an offset direction was arbitrary (levels)
    loops_reversed,    ///< all loops run against the quads; no effect on the nodes (no ids)
    against_front,     ///< the first layer lies behind the quads: its hexahedra have negative volume (no ids)
    many_sheets,       ///< the source consists of several sheets that are swept together (a quad of each)
};

/// The stable name of \p notice.
[[nodiscard]] constexpr std::string_view to_string(SweepNotice notice) noexcept {
    switch (notice) {
        case SweepNotice::ambiguous_normal: return "ambiguous_normal";
        case SweepNotice::loops_reversed: return "loops_reversed";
        case SweepNotice::against_front: return "against_front";
        case SweepNotice::many_sheets: return "many_sheets";
    }
    return "unknown";
}

/// One notice and the entities that it is about.
struct SweepWarning {
    SweepNotice notice = SweepNotice::ambiguous_normal;
    Error::Ids ids;
};

/// How well the affine maps fit one level, user's unit.
struct LevelResidual {
    double max = 0;  ///< largest distance between a loop point and its image, worse of both caps
    double rms = 0;  ///< root mean square of these distances, worse of both caps
};

/// \p warning as a sentence.
[[nodiscard]] std::string text_of(const SweepWarning& warning);

/// Report of sweep(). Times are wall-clock seconds.
struct SweepReport {
    std::size_t nodes = 0;       ///< (r + 1) n
    std::size_t hexahedra = 0;   ///< r times the number of quads
    std::size_t layers = 0;      ///< r
    std::size_t loop_nodes = 0;  ///< m
    std::size_t loops = 0;
    std::vector<LevelResidual> residuals;  ///< of levels 1 .. r - 1, before the boundary correction
    std::vector<SweepWarning> warnings;
    double verify_seconds = 0;
    double fit_seconds = 0;      ///< affine maps
    double prepare_seconds = 0;  ///< correction operators and arrays
    double nodes_seconds = 0;    ///< positions

    /// The first warning of this kind, null if there is none.
    [[nodiscard]] const SweepWarning* find(SweepNotice notice) const;
};

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/sweep/report-inl.hpp>
#endif
