#pragma once
/// \file
/// The layer faces round edges and nodes, for verify_dual().

#include <pavior/core/disjoint_sets.hpp>
#include <pavior/core/stop.hpp>
#include <pavior/dual/classify.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <stop_token>
#include <vector>

namespace pavior::detail {

/// The layer faces of a mesh, and their corners at nodes.
class LayerFans {
public:
    LayerFans(const TetTopology& topology, const EntityClasses& classes, const std::stop_token& stop = {})
        : topology_(topology),
          classes_(classes),
          stop_(stop),
          uses_(topology.edges.size(), 0),
          first_(topology.edges.size(), no_index) {
        for (const Index f : stoppable(IndexRange(topology.faces.size()), stop_)) {
            if (classes.face[f] == EntityClass::layer) {
                faces_.push_back(f);
                for (const Index e : topology.face_edges[f]) {
                    uses_[e] = static_cast<std::uint8_t>(std::min(3, uses_[e] + 1));
                }
            }
        }
    }

    [[nodiscard]] std::span<const Index> faces() const { return faces_; }
    /// True at a layer edge with one layer face.
    [[nodiscard]] bool dangling(Index edge) const {
        return classes_.edge[edge] == EntityClass::layer && uses_[edge] == 1;
    }

    /// Nodes of class layer with not one fan of layer faces, nodes of class stack with a fan that does not lead from
    /// one stack edge to the other. Nodes where layers or chains dangle are left out.
    [[nodiscard]] std::vector<Index> pinched_nodes() {
        if (faces_.empty()) {
            return {};  // and g++ 12 does not warn of an array without bytes
        }
        DisjointSets fans(3 * faces_.size());
        for (const Index l : stoppable(IndexRange(faces_.size()), stop_)) {
            for (const Index e : topology_.face_edges[faces_[l]]) {
                if (classes_.edge[e] == EntityClass::layer && first_[e] == no_index) {
                    first_[e] = l;
                } else if (classes_.edge[e] == EntityClass::layer) {
                    for (const Index i : topology_.edges[e]) {
                        fans.unite(corner(first_[e], i), corner(l, i));
                    }
                }
            }
        }
        const std::vector<char> loose = loose_nodes();
        const std::vector<std::array<Index, 2>> ends = fan_ends(fans);
        std::vector<Index> count(topology_.node_count(), 0);
        std::vector<Index> pinched;
        for (const Index c : stoppable(IndexRange(fans.size()), stop_)) {
            const Index i = topology_.faces[faces_[c / 3]][c % 3];
            if (fans.root(c) != c || loose[i] != 0 || classes_.node[i] == EntityClass::hexahedron) {
                continue;
            }
            const bool bad = classes_.node[i] == EntityClass::layer
                                 ? ++count[i] > 1
                                 : ends[c][1] == no_index || ends[c][0] == ends[c][1];
            if (bad) {
                pinched.push_back(i);
            }
        }
        return pinched;
    }

private:
    [[nodiscard]] Index corner(Index l, Index node) const {
        const TriCorners& c = topology_.faces[faces_[l]];
        return 3 * l + (c[0] == node ? 0U : c[1] == node ? 1U : 2U);
    }

    [[nodiscard]] std::vector<char> loose_nodes() const {
        std::vector<char> loose(topology_.node_count(), 0);
        std::vector<std::uint8_t> stacks(topology_.node_count(), 0);
        for (const Index e : stoppable(IndexRange(topology_.edges.size()), stop_)) {
            for (const Index i : topology_.edges[e]) {
                loose[i] = dangling(e) ? 1 : loose[i];
                stacks[i] = static_cast<std::uint8_t>(
                    std::min(3, stacks[i] + (classes_.edge[e] == EntityClass::stack ? 1 : 0)));
            }
        }
        for (std::size_t i = 0; i < loose.size(); ++i) {
            loose[i] = stacks[i] == 1 ? 1 : loose[i];
        }
        return loose;
    }

    /// The stack edges at which each fan ends.
    [[nodiscard]] std::vector<std::array<Index, 2>> fan_ends(DisjointSets<>& fans) const {
        std::vector<std::array<Index, 2>> ends(fans.size(), {no_index, no_index});
        for (const Index l : stoppable(IndexRange(faces_.size()), stop_)) {
            for (const Index e : topology_.face_edges[faces_[l]]) {
                if (classes_.edge[e] == EntityClass::stack) {
                    for (const Index i : topology_.edges[e]) {
                        auto& fan = ends[fans.root(corner(l, i))];
                        fan[fan[0] == no_index ? 0 : 1] = e;
                    }
                }
            }
        }
        return ends;
    }

    const TetTopology& topology_;
    const EntityClasses& classes_;
    std::stop_token stop_;
    std::vector<Index> faces_;
    std::vector<std::uint8_t> uses_;  ///< layer faces of each edge, 3: or more
    std::vector<Index> first_;
};

}  // namespace pavior::detail
