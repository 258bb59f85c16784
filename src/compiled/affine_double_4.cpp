#include "affine.hpp"

namespace pavior {

PAVIOR_AFFINE_INSTANCES(double, 4)

}  // namespace pavior
