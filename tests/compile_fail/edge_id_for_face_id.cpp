// expect: conver.*EdgeTag.*FaceTag
#include <pavior/core/index.hpp>

using EdgeId = pavior::Id<struct EdgeTag>;
using FaceId = pavior::Id<struct FaceTag>;

std::size_t slot(FaceId face) { return face.index(); }

std::size_t first() {
#ifdef MISUSE
    return slot(EdgeId{0});
#else
    return slot(FaceId{0});
#endif
}
