#pragma once

#include <pavior/core/stop.hpp>
#include <pavior/dual/boundary_surface.hpp>
#include <pavior/dual/features.hpp>
#include <pavior/marking/mark_published.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace pavior {

namespace detail {

PAVIOR_INLINE PublishedMarker::PublishedMarker(const ReferenceMesh& mesh, const TetTopology& topology)
    : mesh_(mesh),
      topology_(topology),
      begin_(topology.edges.size() + 1, 0),
      inner_edge_(topology.edges.size(), 1),
      layer_(topology.faces.size(), 0) {
    const auto each_use = [&](auto&& visit) {
        for (const Index f : IndexRange(topology.faces.size())) {
            for (const Index e : topology.face_edges[f]) {
                if (topology.boundary(f)) {
                    inner_edge_[e] = 0;
                } else {
                    visit(e, f);
                }
            }
        }
    };
    each_use([&](Index e, Index) { ++begin_[e + std::size_t{1}]; });
    for (std::size_t e = 1; e < begin_.size(); ++e) {
        begin_[e] += begin_[e - 1];
    }
    faces_.resize(begin_.back());
    std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
    each_use([&](Index e, Index f) { faces_[next[e]++] = f; });
}

PAVIOR_INLINE std::vector<Index> PublishedMarker::mark(const std::stop_token& stop) {
    std::vector<FrontEdge> front = first_front();
    for (bool grown = true; grown;) {
        check_stop(stop);
        std::vector<FrontEdge> next;
        grown = false;
        for (const auto& [edge, from] : front) {
            const Index face = most_parallel(edge, from);
            if (face == no_index) {
                continue;
            }
            grown = grown || layer_[face] == 0;
            layer_[face] = 1;
            for (const Index e : topology_.face_edges[face]) {
                if (e != edge && inner_edge_[e] != 0) {
                    next.emplace_back(e, face);
                }
            }
        }
        std::sort(next.begin(), next.end());
        next.erase(std::unique(next.begin(), next.end()), next.end());
        front.swap(next);
    }
    std::vector<Index> marked;
    for (const Index f : IndexRange(layer_.size())) {
        if (layer_[f] != 0) {
            marked.push_back(f);
        }
    }
    return marked;
}

PAVIOR_INLINE std::vector<PublishedMarker::FrontEdge> PublishedMarker::first_front() const {
    std::vector<char> high(mesh_.nodes.size(), 0);
    const std::vector<Index> valences = feature_valences(mesh_);
    for (std::size_t v = 0; v < valences.size(); ++v) {
        high[mesh_.vertices[v].node] = valences[v] > 3 ? 1 : 0;
    }
    std::vector<char> starts(topology_.edges.size(), 0);
    for (const FeatureEdge& edge : mesh_.curves) {
        const bool reentrant = edge.kind == CurveKind::corner || edge.kind == CurveKind::reversal;
        if (edge.kind != CurveKind::smooth && (reentrant || high[edge.nodes[0]] != 0 || high[edge.nodes[1]] != 0)) {
            starts[topology_.edge(edge.nodes[0], edge.nodes[1])] = 1;
        }
    }
    std::vector<FrontEdge> front;
    for (const Index f : IndexRange(topology_.faces.size())) {
        for (const Index e : topology_.face_edges[f]) {
            if (topology_.boundary(f) && starts[e] != 0) {
                front.emplace_back(e, f);
            }
        }
    }
    std::sort(front.begin(), front.end());
    return front;
}

PAVIOR_INLINE Index PublishedMarker::most_parallel(Index edge, Index from) const {
    const Vec3 n = normal(from);
    Index best = no_index;
    double most = -1;
    for (std::size_t k = begin_[edge]; k < begin_[edge + std::size_t{1}]; ++k) {
        const double along = faces_[k] == from ? -1 : std::abs(n.dot(normal(faces_[k])));
        if (along > most) {
            most = along;
            best = faces_[k];
        }
    }
    return best;
}

}  // namespace detail

}  // namespace pavior
