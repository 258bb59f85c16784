#pragma once
// Boxes round triangles in a tree. Internal to the tetra component.

#include <pavior/math/box.hpp>
#include <pavior/mesh/near_nodes.hpp>
#include <pavior/mesh/span_mesh.hpp>

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace pavior::detail {

/// A balanced tree of axis-parallel boxes. Queries visit ids in an order that depends on the input alone.
class BoxTree {
public:
    /// O(n log n).
    explicit BoxTree(std::span<const Box<Vec3>> boxes);

    /// Calls visit(i, j), i < j, for all pairs of boxes that meet (touching included), until it returns false.
    template <class Visit>
    void for_each_pair(Visit&& visit) const {
        for (std::size_t i = 0; i < boxes_.size(); ++i) {
            bool go_on = true;
            query([&](const Box<Vec3>& box) { return meet(box, boxes_[i]); },
                  [&](std::size_t j) { go_on = go_on && (j <= i || visit(i, j)); });
            if (!go_on) {
                return;
            }
        }
    }

    /// Calls visit(i) for all boxes that the segment from \p p to \p q may meet.
    template <class Visit>
    void for_each_on_segment(const Vec3& p, const Vec3& q, Visit&& visit) const {
        query([&](const Box<Vec3>& box) { return may_meet(box, p, q); }, visit);
    }

private:
    struct Node {
        Box<Vec3> box;
        std::size_t first = 0;  ///< into order_
        std::size_t last = 0;
        std::size_t right = 0;  ///< the left child follows its parent; 0: leaf
    };
    static constexpr std::size_t leaf_size = 8;

    template <class Wanted, class Visit>
    void query(const Wanted& wanted, Visit&& visit) const {
        std::array<std::size_t, 128> todo{};  // the tree is balanced: two entries a level suffice
        std::size_t count = nodes_.empty() ? 0 : 1;
        while (count > 0) {
            const std::size_t at = todo[--count];
            const Node& node = nodes_[at];
            if (!wanted(node.box)) {
                continue;
            }
            if (node.right != 0) {
                todo[count++] = node.right;
                todo[count++] = at + 1;
                continue;
            }
            for (std::size_t i = node.first; i < node.last; ++i) {
                if (wanted(boxes_[order_[i]])) {
                    visit(order_[i]);
                }
            }
        }
    }

    static bool meet(const Box<Vec3>& a, const Box<Vec3>& b) {
        return (a.low.array() <= b.high.array()).all() && (b.low.array() <= a.high.array()).all();
    }
    static bool may_meet(const Box<Vec3>& box, const Vec3& p, const Vec3& q);
    void build(std::size_t first, std::size_t last);

    std::vector<Box<Vec3>> boxes_;
    std::vector<std::size_t> order_;
    std::vector<Node> nodes_;
};

}  // namespace pavior::detail
