#pragma once
/// \file
/// A sink for progress; long algorithms take one and never print themselves.

#include <cmath>
#include <functional>
#include <string_view>

namespace pavior {

/// Called with the name of the running stage and the fraction done in [0, 1], from the calling thread only.
/// An empty function is silence.
using Progress = std::function<void(std::string_view stage, double fraction)>;

/// Reports to \p progress if there is one.
inline void report(const Progress& progress, std::string_view stage, double fraction) {
    if (progress) {
        progress(stage, fraction);
    }
}

/// The sink for one stage of several, which reports 0 to 1 of its own: \p progress then sees \p from to \p to. Empty
/// if \p progress is, which is copied.
[[nodiscard]] inline Progress stage_of(const Progress& progress, double from, double to) {
    if (!progress) {
        return {};
    }
    return [progress, from, to](std::string_view stage, double fraction) {
        progress(stage, std::lerp(from, to, fraction));
    };
}

}  // namespace pavior
