#pragma once
/// \file
/// Boundary error by discrete harmonic functions on the quads of a cap.

#include <pavior/core/compiled.hpp>
#include <pavior/core/execution.hpp>
#include <pavior/math/graph_laplacian.hpp>
#include <pavior/math/point.hpp>
#include <pavior/mesh/cells.hpp>

#include <Eigen/Core>

#include <cstddef>
#include <span>
#include <vector>

namespace pavior {

/// e solves L e = 0 at the inner nodes with e = e_i on the loops. L is the Laplacian of the graph of quad edges; the
/// weight of an edge is the sum, over its quads, of the distance from its middle to the centre of the quad, divided by
/// its length: the finite-volume Laplacian, right for any rectangular grid, with positive weights on any mesh. Hence
/// the weights of the loop nodes are positive, sum to 1, and no correction exceeds the residuals on the loop.
/// L is factored once, a column costs O(n log n): GraphLaplacian.
class HarmonicError {
public:
    /// n x c: the correction of every column at every node.
    struct Prepared {
        Eigen::MatrixXd field;
    };

    /// \throws InputError non_manifold if some inner node is not connected to the loops by quads
    HarmonicError(std::span<const Vec3> nodes, std::span<const QuadCorners> quads, std::span<const Index> loop);

    [[nodiscard]] Prepared prepare(const Eigen::Ref<const Eigen::MatrixXd>& residuals, Execution execution = {}) const;

    /// See BoundaryError::add().
    void add(const Prepared& prepared, std::size_t begin, std::size_t end, double* out, std::size_t stride) const;

private:
    /// stableNorm() keeps 1e200 and 1e-200 right; an edge of length zero counts as very short.
    static double edge_weight(const Vec3& a, const Vec3& b, const Vec3& centre);

    std::size_t size_ = 0;      ///< nodes
    std::vector<Index> inner_;  ///< nodes of the unknowns
    GraphLaplacian laplacian_;
};

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/sweep/harmonic_error-inl.hpp>
#endif
