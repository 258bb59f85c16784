#pragma once
/// \file
/// The boundary loops of the patches of a cell complex.

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

/// Runs round the patches, along stack edges and dangling layer edges.
template <tet_mesh M, class Complex>
class LoopTracer {
public:
    LoopTracer(const M& mesh, const TetTopology& topology, const EntityClasses& classes, Complex& out)
        : mesh_(mesh),
          topology_(topology),
          classes_(classes),
          out_(out),
          partner_(topology.edges.size(), 0),
          seen_(topology.faces.size(), 0) {}

    void run(const std::stop_token& stop = {}) {
        std::vector<std::pair<Index, std::size_t>> rim;  // patch, 3 * face + local edge
        for (const Index f : stoppable(IndexRange(topology_.faces.size()), stop)) {
            for (const Index e : topology_.face_edges[f]) {
                partner_[e] ^= classes_.face[f] == EntityClass::layer ? f + 1 : 0;
            }
        }
        for (const Index f : stoppable(IndexRange(topology_.faces.size()), stop)) {
            for (std::size_t k = 0; k < 3; ++k) {
                if (classes_.face[f] == EntityClass::layer && on_rim(f, topology_.face_edges[f][k])) {
                    rim.emplace_back(out_.face_patch[f], 3 * std::size_t{f} + k);
                }
            }
        }
        std::sort(rim.begin(), rim.end());
        std::size_t at = 0;
        for (const Index p : stoppable(IndexRange(out_.patches.size()), stop)) {
            for (; at < rim.size() && rim[at].first == p; ++at) {
                start(static_cast<Index>(rim[at].second / 3), rim[at].second % 3);
            }
            out_.patch_loops.push_back(static_cast<Index>(out_.loop_begin.size() - 1));
        }
    }

private:
    struct Step {
        Index from = 0;
        Index to = 0;
        Index chain = no_index;
    };

    [[nodiscard]] bool on_rim(Index f, Index e) const {
        return classes_.edge[e] == EntityClass::stack || partner_[e] == f + 1;
    }

    void start(Index f, std::size_t k) {
        if ((seen_[f] >> k & 1) != 0) {
            return;
        }
        const Index t = topology_.face_tets[f][0];
        const TriCorners c = tet_face(tet(mesh_, t), local_face(topology_, t, f));
        const Index opposite = topology_.faces[f][k];
        const std::size_t at = c[0] == opposite ? 0 : c[1] == opposite ? 1 : 2;
        steps_.clear();
        walk(f, k, c[(at + 2) % 3]);
        emit();
    }

    /// From edge \p k of face \p f towards node \p to and on, back to where it started.
    void walk(Index f, std::size_t k, Index to) {
        do {
            seen_[f] = static_cast<std::uint8_t>(seen_[f] | 1U << k);
            const Index e = topology_.face_edges[f][k];
            const auto [a, b] = topology_.edges[e];
            steps_.push_back({a == to ? b : a, to, out_.edge_chain[e]});
            k = other_edge(f, k, to);
            while (!on_rim(f, topology_.face_edges[f][k])) {
                const Index across = topology_.face_edges[f][k];
                f = (partner_[across] ^ (f + 1)) - 1;
                const auto& edges = topology_.face_edges[f];
                k = other_edge(f, edges[0] == across ? 0 : edges[1] == across ? 1 : 2, to);
            }
            const auto [c, d] = topology_.edges[topology_.face_edges[f][k]];
            to = c == to ? d : c;
        } while ((seen_[f] >> k & 1) == 0);
    }

    /// The edge of face f at \p node that is not edge k.
    [[nodiscard]] std::size_t other_edge(Index f, std::size_t k, Index node) const {
        const std::size_t a = (k + 1) % 3;
        return topology_.faces[f][a] == node ? (k + 2) % 3 : a;
    }

    void emit() {
        const auto breaks = [&](std::size_t i) {
            const Step& before = steps_[(i + steps_.size() - 1) % steps_.size()];
            return out_.node_vertex[steps_[i].from] != no_index || before.chain != steps_[i].chain;
        };
        std::size_t first = 0;
        while (first < steps_.size() && !breaks(first)) {
            ++first;
        }
        first %= steps_.size();
        for (std::size_t n = 0; n < steps_.size(); ++n) {
            const std::size_t i = (first + n) % steps_.size();
            if (n == 0 || breaks(i)) {
                out_.patch_sides.push_back({out_.node_vertex[steps_[i].from], steps_[i].chain, against(steps_[i])});
            }
        }
        out_.loop_begin.push_back(static_cast<Index>(out_.patch_sides.size()));
    }

    [[nodiscard]] bool against(const Step& step) const {
        if (step.chain == no_index) {
            return false;
        }
        const std::span<const Index> path = out_.chain_path(step.chain);
        for (std::size_t i = 0; i + 1 < path.size(); ++i) {
            if (path[i] == step.from && path[i + 1] == step.to) {
                return false;
            }
            if (path[i] == step.to && path[i + 1] == step.from) {
                return true;
            }
        }
        return false;
    }

    const M& mesh_;
    const TetTopology& topology_;
    const EntityClasses& classes_;
    Complex& out_;
    std::vector<Index> partner_;      ///< of the layer faces f of an edge: exclusive or of f + 1
    std::vector<std::uint8_t> seen_;  ///< bit k: edge k of the face has been run along
    std::vector<Step> steps_;
};

}  // namespace pavior::detail
