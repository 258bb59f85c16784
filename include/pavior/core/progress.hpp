#pragma once
/// \file
/// A sink for progress; long algorithms take one and never print themselves.

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

}  // namespace pavior
