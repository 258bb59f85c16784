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

}  // namespace pavior
