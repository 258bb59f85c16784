// expect: (no match|invalid operands).*EdgeTag
#include <pavior/core/index.hpp>

using EdgeId = pavior::Id<struct EdgeTag>;
using FaceId = pavior::Id<struct FaceTag>;

bool same(EdgeId edge, FaceId face) {
#ifdef MISUSE
    return edge == face;
#else
    return edge.value == face.value;
#endif
}
