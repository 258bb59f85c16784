#pragma once

#include <pavior/submap/submap_model.hpp>

#include <algorithm>

namespace pavior {

PAVIOR_INLINE double SubmappedMesh::min_scaled_jacobian() const {
    double result = 1.0;
    for (const SubmapSolidReport& solid : solids) {
        result = std::min(result, solid.smooth.min_det_after);
    }
    return result;
}

}  // namespace pavior
