#pragma once
/// \file
/// The triangular factor of a tall matrix whose rows arrive one by one.

#include <Eigen/Core>
#include <Eigen/Householder>

namespace pavior {

/// R of the QR factorisation of all rows added so far, by Householder reflections on blocks of rows. R keeps the inner
/// products of the columns (R^T R = M^T M) without squaring the condition number, so that every least-squares problem
/// on the columns can be solved from it to full precision. K columns (may be Eigen::Dynamic); O(K^2) per row; memory
/// for K + 64 rows, no heap for fixed K. R depends on the order of the rows by rounding only.
template <class Scalar, int K>
class StreamedQr {
public:
    explicit StreamedQr(Eigen::Index columns = K) : rows_(Storage::Zero(columns + block, columns)), used_(columns) {}

    /// Adds one row (1 x K).
    template <class Derived>
    void add(const Eigen::MatrixBase<Derived>& row) {
        if (used_ == rows_.rows()) {
            reduce();
        }
        rows_.row(used_++) = row;
    }

    /// The K x K upper triangular factor; the signs of its rows are not normalised. Adding may go on.
    [[nodiscard]] Eigen::Matrix<Scalar, K, K> factor() {
        reduce();
        return rows_.topRows(rows_.cols()).template triangularView<Eigen::Upper>();
    }

private:
    static constexpr int block = 64;
    using Storage = Eigen::Matrix<Scalar, K == Eigen::Dynamic ? K : K + block, K>;

    void reduce();

    Storage rows_;
    Eigen::Index used_;
};

template <class Scalar, int K>
void StreamedQr<Scalar, K>::reduce() {
    for (Eigen::Index j = 0; j < rows_.cols(); ++j) {
        auto column = rows_.col(j).segment(j, used_ - j);
        Scalar tau = 0;
        Scalar beta = 0;
        column.makeHouseholderInPlace(tau, beta);
        column(0) = Scalar(1);
        for (Eigen::Index k = j + 1; k < rows_.cols(); ++k) {
            auto other = rows_.col(k).segment(j, used_ - j);
            const Scalar factor = tau * column.dot(other);
            other -= factor * column;
        }
        column.setZero();
        column(0) = beta;
    }
    used_ = rows_.cols();
}

#ifdef PAVIOR_COMPILED
extern template class StreamedQr<double, 4>;
extern template class StreamedQr<double, 6>;
extern template class StreamedQr<double, 8>;
extern template class StreamedQr<double, Eigen::Dynamic>;
#endif

}  // namespace pavior
