#pragma once
/// \file
/// Wished lengths of mesh edges at some entities of a model.

#include <map>

namespace pavior {

/// Sizes by tag, as in IntervalOptions: an edge takes its own, else the smallest of its faces, else of its solids.
struct LocalSizes {
    std::map<int, double> edge, face, solid;
};

}  // namespace pavior
