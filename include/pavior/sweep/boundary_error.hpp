#pragma once
/// \file
/// Boundary-error correction: what an affine map leaves on the loops of a level is spread over its inner nodes.

#include <pavior/core/compiled.hpp>
#include <pavior/core/execution.hpp>
#include <pavior/mesh/cells.hpp>
#include <pavior/sweep/harmonic_error.hpp>
#include <pavior/sweep/inverse_distance_error.hpp>

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <variant>

namespace pavior {

/// How residuals on the loops are interpolated to the inner nodes, once for each cap.
enum class BoundaryCorrection : std::uint8_t {
    idw,       ///< weights 1 / distance^2 on the cap, normalised (InverseDistanceError)
    harmonic,  ///< discrete harmonic functions on the quads of the cap (HarmonicError)
    none,      ///< no correction: the loops of a level and its inner nodes may not fit together
};

/// "idw", "harmonic" or "none".
[[nodiscard]] constexpr std::string_view to_string(BoundaryCorrection correction) noexcept {
    switch (correction) {
        case BoundaryCorrection::idw: return "idw";
        case BoundaryCorrection::harmonic: return "harmonic";
        case BoundaryCorrection::none: return "none";
    }
    return "unknown";
}

/// The correction operator of one cap, made once and used for every level; `none` adds nothing.
class BoundaryError {
public:
    /// Residuals of some columns, made ready for add().
    using Prepared = std::variant<std::monostate, InverseDistanceError::Prepared, HarmonicError::Prepared>;

    BoundaryError() = default;
    /// \param nodes all nodes of the cap  \param quads its quads (harmonic only)  \param loop its m loop nodes
    BoundaryError(BoundaryCorrection correction, std::span<const Vec3> nodes, std::span<const QuadCorners> quads,
                  std::span<const Index> loop);

    /// \param residuals m x c, a row for each loop node in order
    [[nodiscard]] Prepared prepare(const Eigen::Ref<const Eigen::MatrixXd>& residuals, Execution execution = {}) const;

    /// Adds the correction of column c at node i to out[c * stride + (i - begin)] for begin <= i < end. \p begin must
    /// be a multiple of 16, and so \p stride, which is at least end - begin rounded up to 16. What is added at loop
    /// nodes is of no use. A column's bits do not depend on the others.
    void add(const Prepared& prepared, std::size_t begin, std::size_t end, double* out, std::size_t stride) const;

private:
    std::optional<InverseDistanceError> idw_;
    std::optional<HarmonicError> harmonic_;
};

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/sweep/boundary_error-inl.hpp>
#endif
