#pragma once
/// \file
/// The corners of the cells of a cell complex.

#include <pavior/core/disjoint_sets.hpp>
#include <pavior/core/stop.hpp>
#include <pavior/dual/classify.hpp>

#include <algorithm>
#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <span>
#include <stop_token>
#include <tuple>
#include <utility>
#include <vector>

namespace pavior::detail {

/// Floods the tetrahedra round the vertices.
template <tet_mesh M, class Complex>
class CornerFinder {
public:
    CornerFinder(const M& mesh, const TetTopology& topology, const EntityClasses& classes, Complex& out)
        : mesh_(mesh), topology_(topology), classes_(classes), out_(out), seen_(topology.tet_faces.size(), 0) {}

    void run(const std::stop_token& stop = {}) {
        for (const Index t : stoppable(IndexRange(seen_.size()), stop)) {
            const TetCorners c = tet(mesh_, t);
            for (std::size_t k = 0; k < 4; ++k) {
                if (classes_.node[c[k]] == EntityClass::hexahedron && (seen_[t] >> k & 1) == 0) {
                    flood(t, k, c[k]);
                    close(t, c[k]);
                }
            }
        }
        std::stable_sort(out_.corners.begin(), out_.corners.end(),
                         [](const Corner& a, const Corner& b) { return a.vertex < b.vertex; });
    }

private:
    using Corner = typename decltype(Complex::corners)::value_type;

    /// A layer face of a tetrahedron at the vertex at work.
    struct Side {
        Index tet = 0;
        std::size_t face = 0;
        friend auto operator<=>(const Side&, const Side&) = default;
    };

    void flood(Index t, std::size_t k, Index node) {
        stack_.assign(1, t);
        sides_.clear();
        seen_[t] = static_cast<std::uint8_t>(seen_[t] | 1U << k);
        while (!stack_.empty()) {
            const Index at = stack_.back();
            stack_.pop_back();
            const std::size_t apex = local_node(tet(mesh_, at), node);
            for (std::size_t f = 0; f < 4; ++f) {
                const Index face = topology_.tet_faces[at][f];
                if (f == apex) {
                    continue;
                }
                if (classes_.face[face] == EntityClass::layer) {
                    sides_.push_back({at, f});
                    continue;
                }
                const Index next = topology_.across(face, at);
                const auto bit = static_cast<std::uint8_t>(1U << local_node(tet(mesh_, next), node));
                if ((seen_[next] & bit) == 0) {
                    seen_[next] |= bit;
                    stack_.push_back(next);
                }
            }
        }
        std::sort(sides_.begin(), sides_.end());
    }

    /// Runs along the rings of layer faces and notes the chains met.
    void close(Index t, Index node) {
        Corner corner{out_.node_vertex[node], out_.tet_cell[t], {}, {}, 0, 0, t};
        corner.chains.fill(no_index);
        corner.patches.fill(no_index);
        done_.assign(sides_.size(), 0);
        for (std::size_t i = 0; i < sides_.size(); ++i) {
            if (done_[i] == 0) {
                ++corner.rings;
                ring(i, node, corner);
            }
        }
        if (corner.regular()) {
            const auto first = std::min_element(corner.chains.begin(), corner.chains.end()) - corner.chains.begin();
            std::rotate(corner.chains.begin(), corner.chains.begin() + first, corner.chains.end());
            std::rotate(corner.patches.begin(), corner.patches.begin() + first, corner.patches.end());
        }
        out_.corners.push_back(corner);
    }

    void ring(std::size_t i, Index node, Corner& corner) {
        while (done_[i] == 0) {
            done_[i] = 1;
            const auto [next, edge] = turn(sides_[i], node);
            i = static_cast<std::size_t>(std::lower_bound(sides_.begin(), sides_.end(), next) - sides_.begin());
            const Index chain = out_.edge_chain[edge];
            if (chain != no_index) {
                if (corner.valence < 3) {
                    corner.chains[corner.valence] = chain;
                    corner.patches[corner.valence] = out_.face_patch[topology_.tet_faces[next.tet][next.face]];
                }
                ++corner.valence;
            }
        }
    }

    /// The next layer face about \p node in positive order, and the edge passed on the way.
    [[nodiscard]] std::pair<Side, Index> turn(const Side& side, Index node) const {
        Index t = side.tet;
        TetCorners c = tet(mesh_, t);
        const TriCorners outward = tet_face(c, side.face);
        const std::size_t at = outward[0] == node ? 0 : outward[1] == node ? 1 : 2;
        const Index pivot = outward[(at + 1) % 3];
        Index behind = outward[(at + 2) % 3];
        const auto local = tet_edge_between[local_node(c, node)][local_node(c, pivot)];
        const Index edge = topology_.tet_edges[t][static_cast<std::size_t>(local)];
        while (true) {
            const std::size_t f = local_node(c, behind);
            const Index face = topology_.tet_faces[t][f];
            if (classes_.face[face] == EntityClass::layer) {
                return {{t, f}, edge};
            }
            for (const Index i : topology_.faces[face]) {
                behind = i != node && i != pivot ? i : behind;
            }
            t = topology_.across(face, t);
            c = tet(mesh_, t);
        }
    }

    const M& mesh_;
    const TetTopology& topology_;
    const EntityClasses& classes_;
    Complex& out_;
    std::vector<std::uint8_t> seen_;  ///< bit k: the corner of the tetrahedron at its node k is done
    std::vector<Index> stack_;
    std::vector<Side> sides_;
    std::vector<char> done_;
};

}  // namespace pavior::detail
