#pragma once

#include <pavior/sweep/report.hpp>

namespace pavior {

PAVIOR_INLINE const SweepWarning* SweepReport::find(SweepNotice notice) const {
    for (const SweepWarning& warning : warnings) {
        if (warning.notice == notice) {
            return &warning;
        }
    }
    return nullptr;
}

PAVIOR_INLINE std::string text_of(const SweepWarning& warning) {
    std::string ids;
    for (std::size_t i = 0; i < warning.ids.size() && i < 10; ++i) {
        ids += (i == 0 ? "" : ", ") + std::to_string(warning.ids[i]);
    }
    ids += warning.ids.size() > 10 ? " and " + std::to_string(warning.ids.size() - 10) + " more" : "";
    switch (warning.notice) {
        case SweepNotice::ambiguous_normal:
            return "the side to which the offset of method h points was arbitrary at levels " + ids;
        case SweepNotice::loops_reversed: return "the loops run against the quads; the nodes are the same";
        case SweepNotice::against_front:
            return "the first layer lies behind the quads, so that its hexahedra have negative volume";
        case SweepNotice::many_sheets:
            return "the source consists of several sheets that are swept together; a quad of each: " + ids;
    }
    return "unknown";
}

}  // namespace pavior
