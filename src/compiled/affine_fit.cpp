#include <pavior/affine/fit.hpp>

namespace pavior {

PAVIOR_FIT_AFFINE(, float, 2)
PAVIOR_FIT_AFFINE(, float, 3)
PAVIOR_FIT_AFFINE(, double, 2)
PAVIOR_FIT_AFFINE(, double, 3)
PAVIOR_FIT_AFFINE(, double, Eigen::Dynamic)

}  // namespace pavior
