#include "affine.hpp"

namespace pavior {

PAVIOR_AFFINE_INSTANCES(double, 2)
PAVIOR_PSEUDO_AREA(, double, 2)

}  // namespace pavior
