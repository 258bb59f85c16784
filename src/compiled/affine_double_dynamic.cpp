#include "affine.hpp"

namespace pavior {

PAVIOR_AFFINE_INSTANCES(double, Eigen::Dynamic)
PAVIOR_PSEUDO_AREA(, double, Eigen::Dynamic)

}  // namespace pavior
