#include "box_tree.hpp"

#include <algorithm>

namespace pavior::detail {

BoxTree::BoxTree(std::span<const Box<Vec3>> boxes) : boxes_(boxes.begin(), boxes.end()), order_(boxes.size()) {
    for (std::size_t i = 0; i < order_.size(); ++i) {
        order_[i] = i;
    }
    if (!order_.empty()) {
        build(0, order_.size());
    }
}

void BoxTree::build(std::size_t first, std::size_t last) {
    const std::size_t self = nodes_.size();
    nodes_.push_back({{}, first, last, 0});
    Box<Vec3> centres;
    for (std::size_t i = first; i < last; ++i) {
        const Box<Vec3>& box = boxes_[order_[i]];
        nodes_[self].box.add(box);
        centres.add(box.centre());
    }
    if (last - first <= leaf_size) {
        return;
    }
    Eigen::Index axis = 0;
    (centres.high - centres.low).maxCoeff(&axis);
    const std::size_t middle = first + (last - first) / 2;
    const auto at = [&](std::size_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(at(first), at(middle), at(last), [&](std::size_t a, std::size_t b) {
        const double x = boxes_[a].low[axis] + boxes_[a].high[axis];
        const double y = boxes_[b].low[axis] + boxes_[b].high[axis];
        return x != y ? x < y : a < b;
    });
    build(first, middle);
    nodes_[self].right = nodes_.size();
    build(middle, last);
}

/// Separating axes: the three coordinate axes and their products with the segment; rounding counts as meeting.
bool BoxTree::may_meet(const Box<Vec3>& box, const Vec3& p, const Vec3& q) {
    const Vec3 half = (box.high - box.low) / 2.0;
    const Vec3 middle = (p + q) / 2.0 - (box.low + box.high) / 2.0;
    const Vec3 d = (q - p) / 2.0;
    const double slack = 1e-14 * (half.cwiseAbs().sum() + middle.cwiseAbs().sum() + d.cwiseAbs().sum());
    for (Eigen::Index a = 0; a < 3; ++a) {
        const Eigen::Index b = (a + 1) % 3;
        const Eigen::Index c = (a + 2) % 3;
        if (std::abs(middle[a]) > half[a] + std::abs(d[a]) + slack) {
            return false;
        }
        const double reach = half[b] * std::abs(d[c]) + half[c] * std::abs(d[b]);
        if (std::abs(middle[b] * d[c] - middle[c] * d[b]) > reach + slack * (std::abs(d[b]) + std::abs(d[c]) + slack)) {
            return false;
        }
    }
    return true;
}

}  // namespace pavior::detail
