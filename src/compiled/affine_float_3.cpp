#include "affine.hpp"

namespace pavior {

PAVIOR_AFFINE_INSTANCES(float, 3)
PAVIOR_PSEUDO_AREA(, float, 3)

}  // namespace pavior
