#include "affine.hpp"

namespace pavior {

PAVIOR_AFFINE_INSTANCES(float, 2)
PAVIOR_PSEUDO_AREA(, float, 2)

}  // namespace pavior
