#pragma once

#include <pavior/sweep/boundary_error.hpp>

#include <cstddef>
#include <span>

namespace pavior {

PAVIOR_INLINE BoundaryError::BoundaryError(BoundaryCorrection correction, std::span<const Vec3> nodes,
                                           std::span<const QuadCorners> quads, std::span<const Index> loop) {
    if (correction == BoundaryCorrection::idw) {
        idw_.emplace(nodes, loop);
    } else if (correction == BoundaryCorrection::harmonic) {
        harmonic_.emplace(nodes, quads, loop);
    }
}

PAVIOR_INLINE BoundaryError::Prepared BoundaryError::prepare(const Eigen::Ref<const Eigen::MatrixXd>& residuals,
                                                             Execution execution) const {
    if (idw_) {
        return idw_->prepare(residuals);
    }
    if (harmonic_) {
        return harmonic_->prepare(residuals, execution);
    }
    return {};
}

PAVIOR_INLINE void BoundaryError::add(const Prepared& prepared, std::size_t begin, std::size_t end, double* out,
                                      std::size_t stride) const {
    if (idw_) {
        idw_->add(std::get<InverseDistanceError::Prepared>(prepared), begin, end, out, stride);
    } else if (harmonic_) {
        harmonic_->add(std::get<HarmonicError::Prepared>(prepared), begin, end, out, stride);
    }
}

}  // namespace pavior
