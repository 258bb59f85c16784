#pragma once
/// \file
/// The published marking of layer faces (Algorithm 5.12 \cite roca2009): faces that the reference mesh happens to have.

#include <pavior/dual/boundary_surface.hpp>
#include <pavior/dual/copy_reference.hpp>
#include <pavior/dual/features.hpp>
#include <pavior/marking/judge_marking.hpp>
#include <pavior/marking/marking.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace pavior {

namespace detail {

/// Algorithm 5.12 on the faces and edges of a topology.
class PublishedMarker {
public:
    /// An edge of a front and the face from which the front reached it.
    using FrontEdge = std::pair<Index, Index>;

    PublishedMarker(const ReferenceMesh& mesh, const TetTopology& topology)
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

    /// \return the marked faces, ascending
    [[nodiscard]] std::vector<Index> mark() {
        std::vector<FrontEdge> front = first_front();
        for (bool grown = true; grown;) {
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

private:
    /// Lines 4 to 6: re-entrant edges and edges at vertices of valence 4 and more, with their boundary faces.
    [[nodiscard]] std::vector<FrontEdge> first_front() const {
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

    [[nodiscard]] Vec3 normal(Index face) const {
        const auto& [a, b, c] = topology_.faces[face];
        return (mesh_.nodes[b] - mesh_.nodes[a]).cross(mesh_.nodes[c] - mesh_.nodes[a]).stableNormalized();
    }

    /// Lines 13 to 15; the first of equals, no_index if the edge has no other inner face.
    [[nodiscard]] Index most_parallel(Index edge, Index from) const {
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

    const ReferenceMesh& mesh_;
    const TetTopology& topology_;
    std::vector<std::size_t> begin_;  ///< inner faces of each edge
    std::vector<Index> faces_;
    std::vector<char> inner_edge_;
    std::vector<char> layer_;
};

}  // namespace detail

/// Marks faces of \p mesh as Algorithm 5.12 \cite roca2009 does: from re-entrant curves, and curves at vertices with
/// more than three, fronts advance across edges to the inner face that is most parallel to the last, until they bring
/// nothing new. Reversal curves are treated as corners. Layers that the mesh has already stay. Where the mesh has no
/// faces along the continued patches the fronts zigzag and the result is not valid: see MarkedMesh::report.
/// Options used: quality, progress. O(n) a step of the fronts.
template <classified_tet_mesh M>
[[nodiscard]] MarkedMesh mark_published(const M& mesh, const MarkingOptions& options = {}) {
    MarkedMesh out{detail::copy_reference(mesh), {}};
    const TetTopology topology = tet_topology(out.reference);
    report(options.progress, "fronts", 0.0);
    out.report.sheets = {{SheetKind::given, {}, out.reference.layers.size()}, {SheetKind::published, {}, 0}};
    out.report.layer_sheets.assign(out.reference.layers.size(), 0);
    std::vector<Index> given;
    for (const TriCorners& layer : out.reference.layers) {
        given.push_back(topology.face(layer));
    }
    std::sort(given.begin(), given.end());
    for (const Index f : detail::PublishedMarker(out.reference, topology).mark()) {
        if (!std::binary_search(given.begin(), given.end(), f)) {
            out.reference.layers.push_back(topology.faces[f]);
            out.report.layer_sheets.push_back(1);
            ++out.report.sheets[1].faces;
        }
    }
    judge_marking(out.reference, cell_snapshot(out.reference), options, out.report);
    out.report.tries = 1;
    report(options.progress, "fronts", 1.0);
    return out;
}

}  // namespace pavior
