#include <pavior/math/small_svd.hpp>

namespace pavior {

#define PAVIOR_INSTANTIATE_SVD(Scalar, R, C) \
    template SmallSvd<Scalar, R, C> small_svd<Scalar, R, C>(const Eigen::Matrix<Scalar, R, C>&);
PAVIOR_SMALL_SVD_SIZES(PAVIOR_INSTANTIATE_SVD, double)

}  // namespace pavior
