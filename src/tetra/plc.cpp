#include "plc.hpp"

#include <pavior/mesh/near_nodes.hpp>
#include <pavior/mesh/span_mesh.hpp>

#include <algorithm>
#include <cmath>

namespace pavior::detail {

Vec3 Frame::inside(const Vec3& x) const {
    const double scale = std::ldexp(1.0, -(exponent / 2));
    const double rest = std::ldexp(1.0, -(exponent - exponent / 2));  // in two steps: 2^-exponent may overflow
    return ((x * scale - origin * scale) * rest).eval();
}

Vec3 Frame::outside(const Vec3& y) const {
    const double scale = std::ldexp(1.0, exponent / 2);
    const double rest = std::ldexp(1.0, exponent - exponent / 2);
    return (y * scale * rest + origin).eval();
}

Frame frame_of(std::span<const Vec3> nodes) {
    const Box<Vec3> box = bounds(nodes);
    Frame frame;
    if (nodes.empty() || !(box.low.x() <= box.high.x())) {
        return frame;
    }
    const double half = (box.high / 2.0 - box.low / 2.0).maxCoeff();
    frame.exponent = half > 0.0 ? std::ilogb(half) : 0;
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
        // Far from zero all coordinates lie within a factor of two of each other: their differences are exact.
        const double farthest = std::max(std::abs(box.low[axis]), std::abs(box.high[axis]));
        frame.origin[axis] = farthest / 8.0 > half ? nodes.front()[axis] : 0.0;
    }
    return frame;
}

}  // namespace pavior::detail
