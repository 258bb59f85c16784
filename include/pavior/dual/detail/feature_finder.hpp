#pragma once
/// \file
/// The search for feature edges behind make_reference_mesh().

#include <pavior/core/disjoint_sets.hpp>
#include <pavior/dual/boundary_surface.hpp>
#include <pavior/dual/reference_mesh.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace pavior::detail {

/// The features of a boundary surface while they are being found. Edges are places in surface.edges.
template <class Options>
class FeatureFinder {
    using TagUse = decltype(Options::tagged_edges);
    using Override = typename decltype(Options::overrides)::value_type;

public:
    FeatureFinder(const TetTopology& topology, const BoundarySurface& surface, std::vector<double> angles,
                  std::vector<double> lengths, const Options& options)
        : topology_(topology),
          surface_(surface),
          angles_(std::move(angles)),
          lengths_(std::move(lengths)),
          options_(options),
          kinds_(surface.edges.size(), CurveKind::smooth),
          place_(topology.edges.size(), no_index) {
        for (const Index s : IndexRange(surface.edges.size())) {
            place_[surface.edges[s]] = s;
        }
    }

    [[nodiscard]] const std::vector<CurveKind>& kinds() const { return kinds_; }
    [[nodiscard]] const std::vector<char>& forced_vertices() const { return forced_; }

    void find(const std::vector<TaggedEdge>& tagged, const std::vector<TaggedNode>& vertices) {
        forced_.assign(topology_.node_count(), 0);
        if (options_.force_tagged_vertices) {
            for (const TaggedNode& vertex : vertices) {
                forced_[vertex.node] = 1;
            }
        }
        place_tagged(tagged);
        const bool candidates = !tagged.empty() && options_.tagged_edges != TagUse::ignored;
        for (std::size_t s = 0; s < kinds_.size(); ++s) {
            kinds_[s] = candidates ? CurveKind::smooth : curve_kind(angles_[s], options_);
        }
        if (candidates) {
            kinds_of_tagged_curves();
        } else {
            even_out(curves());
        }
        for (const Override& wish : options_.overrides) {
            apply(wish);
        }
    }

    /// The sets of feature edges that form one curve: chains between feature vertices.
    [[nodiscard]] DisjointSets<> curves() const {
        return chains([](Index, Index) { return true; });
    }

    /// Feature edges at each node.
    [[nodiscard]] std::vector<Index> valences() const {
        std::vector<Index> valence(topology_.node_count(), 0);
        for (std::size_t s = 0; s < kinds_.size(); ++s) {
            for (const Index i : topology_.edges[surface_.edges[s]]) {
                valence[i] += kinds_[s] != CurveKind::smooth ? 1U : 0U;
            }
        }
        return valence;
    }

private:
    void place_tagged(const std::vector<TaggedEdge>& tagged) {
        for (const TaggedEdge& edge : tagged) {
            const Index e = topology_.edge(edge.nodes[0], edge.nodes[1]);
            if (e == no_index) {
                throw InputError(ErrorCode::bad_index,
                                 "the tetrahedra have no edge between the tagged nodes " +
                                     std::to_string(edge.nodes[0]) + " and " + std::to_string(edge.nodes[1]),
                                 {edge.nodes[0], edge.nodes[1]});
            }
            if (place_[e] != no_index) {
                tagged_.push_back({edge.tag, static_cast<std::int32_t>(place_[e])});
            }
        }
        std::sort(tagged_.begin(), tagged_.end());
    }

    /// Mean angle of a set of edges, weighted with their lengths.
    template <class Edges>
    [[nodiscard]] CurveKind mean_kind(const Edges& edges, bool smooth_allowed) const {
        double angle = 0.0;
        double length = 0.0;
        std::array<double, 4> share{};
        for (const auto s : edges) {
            angle += lengths_[s] * angles_[s];
            length += lengths_[s];
            share[static_cast<std::size_t>(curve_kind(angles_[s], options_))] += lengths_[s];
        }
        const CurveKind kind = length > 0.0 ? curve_kind(angle / length, options_) : CurveKind::smooth;
        if (kind != CurveKind::smooth || smooth_allowed) {
            return kind;
        }
        return static_cast<CurveKind>(std::max_element(share.begin() + 1, share.end()) - share.begin());
    }

    /// The sets of feature edges that follow each other where no others end and joined(edge, edge) allows.
    template <class Joined>
    [[nodiscard]] DisjointSets<> chains(const Joined& joined) const {
        const std::vector<Index> valence = valences();
        std::vector<Index> first(valence.size(), no_index);
        DisjointSets sets(kinds_.size());
        for (const Index s : IndexRange(kinds_.size())) {
            if (kinds_[s] == CurveKind::smooth) {
                continue;
            }
            for (const Index i : topology_.edges[surface_.edges[s]]) {
                if (valence[i] == 2 && forced_[i] == 0) {
                    const Index other = std::exchange(first[i], s);
                    if (other != no_index && joined(s, other)) {
                        sets.unite(s, other);
                    }
                }
            }
        }
        return sets;
    }

    /// A chain of edges with one tag is a feature as a whole or not at all; a tag may cover several chains.
    void kinds_of_tagged_curves() {
        std::vector<std::int32_t> tag(kinds_.size(), 0);
        for (const TagOf& edge : tagged_) {
            const auto s = static_cast<std::size_t>(edge.tag);
            tag[s] = edge.id;
            kinds_[s] = CurveKind::end;
        }
        for (const std::vector<Index>&chain : members(chains([&](Index a, Index b) { return tag[a] == tag[b]; }))) {
            const CurveKind kind = mean_kind(chain, options_.tagged_edges == TagUse::candidates);
            for (const Index s : chain) {
                kinds_[s] = kind;
            }
        }
    }

    /// Members of each set of feature edges, one set after the other.
    [[nodiscard]] std::vector<std::vector<Index>> members(DisjointSets<> sets) const {
        std::vector<Index> id;
        const Index count = number_sets(sets, id, [&](Index s) { return kinds_[s] != CurveKind::smooth; });
        std::vector<std::vector<Index>> result(count);
        for (const Index s : IndexRange(id.size())) {
            if (id[s] != no_index) {
                result[id[s]].push_back(s);
            }
        }
        return result;
    }

    /// One kind for each curve, unless it turns from convex to re-entrant on its way.
    void even_out(const DisjointSets<>& sets) {
        for (const std::vector<Index>& curve : members(sets)) {
            const auto convex =
                std::count_if(curve.begin(), curve.end(), [&](Index s) { return kinds_[s] == CurveKind::end; });
            if (convex != 0 && static_cast<std::size_t>(convex) != curve.size()) {
                continue;
            }
            const CurveKind kind = mean_kind(curve, false);
            for (const Index s : curve) {
                kinds_[s] = kind;
            }
        }
    }

    void apply(const Override& wish) {
        if (wish.nodes[0] != no_index) {
            apply_to_edge(wish);
            return;
        }
        const auto [first, last] = std::equal_range(tagged_.begin(), tagged_.end(), TagOf{wish.tag, 0},
                                                    [](const TagOf& a, const TagOf& b) { return a.id < b.id; });
        if (first == last) {
            throw InputError(ErrorCode::bad_option,
                             "no edge of the boundary carries the tag " + std::to_string(wish.tag), {wish.tag});
        }
        std::for_each(first, last, [&](const TagOf& edge) { kinds_[static_cast<std::size_t>(edge.tag)] = wish.kind; });
    }

    void apply_to_edge(const Override& wish) {
        const Index e = topology_.edge(wish.nodes[0], wish.nodes[1]);
        if (e == no_index || place_[e] == no_index) {
            throw InputError(ErrorCode::bad_option,
                             "no edge of the boundary runs between the nodes " + std::to_string(wish.nodes[0]) +
                                 " and " + std::to_string(wish.nodes[1]),
                             {wish.nodes[0], wish.nodes[1]});
        }
        const Index at = place_[e];
        if (kinds_[at] == CurveKind::smooth) {
            kinds_[at] = wish.kind;
            return;
        }
        DisjointSets<> sets = curves();
        const Index root = sets.root(at);
        for (const Index s : IndexRange(kinds_.size())) {
            if (kinds_[s] != CurveKind::smooth && sets.root(s) == root) {
                kinds_[s] = wish.kind;
            }
        }
    }

    const TetTopology& topology_;
    const BoundarySurface& surface_;
    std::vector<double> angles_;
    std::vector<double> lengths_;
    const Options& options_;
    std::vector<CurveKind> kinds_;
    std::vector<Index> place_;   ///< of a topology edge in surface.edges
    std::vector<TagOf> tagged_;  ///< (tag, place), ascending
    std::vector<char> forced_;
};

}  // namespace pavior::detail
