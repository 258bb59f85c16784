#pragma once
/// \file
/// Boundary error by discrete harmonic functions on the quads of a cap.

#include <pavior/core/compiled.hpp>
#include <pavior/core/execution.hpp>
#include <pavior/math/point.hpp>
#include <pavior/mesh/cells.hpp>

#include <Eigen/Core>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include <cstddef>
#include <limits>
#include <memory>
#include <span>
#include <vector>

namespace pavior {

/// e solves L e = 0 at the inner nodes with e = e_i on the loops. L is the Laplacian of the graph of quad edges; the
/// weight of an edge is the sum, over its quads, of the distance from its middle to the centre of the quad, divided by
/// its length: the finite-volume Laplacian, right for any rectangular grid, with positive weights on any mesh. Hence
/// the weights of the loop nodes are positive, sum to 1, and no correction exceeds the residuals on the loop.
/// L is factored once (sparse LDL^T, about O(n log n) memory and O(n^1.5) time); a column costs O(n log n).
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
    using Matrix = Eigen::SparseMatrix<double>;
    using Triplet = Eigen::Triplet<double>;
    static constexpr Eigen::Index pending = std::numeric_limits<Eigen::Index>::max();
    static constexpr Eigen::Index unused = std::numeric_limits<Eigen::Index>::min();

    void assemble(std::span<const Vec3> nodes, std::span<const QuadCorners> quads);

    /// stableNorm() keeps 1e200 and 1e-200 right; an edge of length zero counts as very short.
    static double edge_weight(const Vec3& a, const Vec3& b, const Vec3& centre);

    /// Row of node \p a: its edge to \p b.
    void add_half(Index a, Index b, double weight, std::vector<Triplet>& laplacian,
                  std::vector<Triplet>& coupling) const;

    Eigen::Index loop_size_ = 0;
    std::vector<Eigen::Index> unknown_;  ///< row of an inner node; -1 - j for loop node j; `unused`
    std::vector<Index> inner_;           ///< nodes of the rows
    Matrix coupling_;                    ///< inner x loop
    std::shared_ptr<const Eigen::SimplicialLDLT<Matrix>> factor_;
};

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/sweep/harmonic_error-inl.hpp>
#endif
