#include "affine.hpp"

namespace pavior {

PAVIOR_AFFINE_INSTANCES(double, 3)
PAVIOR_PSEUDO_AREA(, double, 3)

}  // namespace pavior
