#pragma once

#include <pavior/brep/neighbour_boundary.hpp>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <span>
#include <utility>
#include <vector>

namespace pavior {

namespace detail {

PAVIOR_INLINE FaceGraph::FaceGraph(std::span<const Vec3> nodes, std::vector<QuadCorners> quads)
    : nodes_(nodes), quads_(std::move(quads)) {
    double shortest = std::numeric_limits<double>::infinity();
    for (const QuadCorners& q : quads_) {
        for (std::size_t k = 0; k < 4; ++k) {
            const Index a = q[k], c = q[(k + 1) % 4];
            links_.emplace_back(a, c);
            links_.emplace_back(c, a);
            ids_.push_back(a);
            shortest = std::min(shortest, (nodes[a] - nodes[c]).norm());
        }
    }
    tolerance_ = 1e-3 * shortest;
    sort_once(ids_);
    sort_once(links_);
}

PAVIOR_INLINE Index FaceGraph::at(const Vec3& x) const {
    for (const Index id : ids_) {
        if ((nodes_[id] - x).norm() <= tolerance_) {
            return id;
        }
    }
    return no_index;
}

}  // namespace detail

}  // namespace pavior
