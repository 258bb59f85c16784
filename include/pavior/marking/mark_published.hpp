#pragma once
/// \file
/// The published marking of layer faces (Algorithm 5.12 \cite roca2009): faces that the reference mesh happens to have.

#include <pavior/core/compiled.hpp>
#include <pavior/dual/copy_reference.hpp>
#include <pavior/marking/judge_marking.hpp>
#include <pavior/marking/marking.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <cstddef>
#include <stop_token>
#include <utility>
#include <vector>

namespace pavior {

namespace detail {

/// Algorithm 5.12 on the faces and edges of a topology.
class PublishedMarker {
public:
    /// An edge of a front and the face from which the front reached it.
    using FrontEdge = std::pair<Index, Index>;

    PublishedMarker(const ReferenceMesh& mesh, const TetTopology& topology);

    /// \return the marked faces, ascending
    [[nodiscard]] std::vector<Index> mark(const std::stop_token& stop = {});

private:
    /// Lines 4 to 6: re-entrant edges and edges at vertices of valence 4 and more, with their boundary faces.
    [[nodiscard]] std::vector<FrontEdge> first_front() const;

    [[nodiscard]] Vec3 normal(Index face) const {
        const auto& [a, b, c] = topology_.faces[face];
        return (mesh_.nodes[b] - mesh_.nodes[a]).cross(mesh_.nodes[c] - mesh_.nodes[a]).stableNormalized();
    }

    /// Lines 13 to 15; the first of equals, no_index if the edge has no other inner face.
    [[nodiscard]] Index most_parallel(Index edge, Index from) const;

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
/// Options used: quality, execution, progress. O(n) a step of the fronts. \throws Stopped
template <classified_tet_mesh M>
[[nodiscard]] MarkedMesh mark_published(const M& mesh, const MarkingOptions& options = {}) {
    MarkedMesh out{detail::copy_reference(mesh), {}};
    report(options.progress, "fronts", 0.0);
    const TetTopology topology = tet_topology(out.reference, options.execution);
    out.report.sheets = {{SheetKind::given, {}, out.reference.layers.size()}, {SheetKind::published, {}, 0}};
    out.report.layer_sheets.assign(out.reference.layers.size(), 0);
    std::vector<Index> given;
    for (const TriCorners& layer : out.reference.layers) {
        given.push_back(topology.face(layer));
    }
    std::sort(given.begin(), given.end());
    for (const Index f : detail::PublishedMarker(out.reference, topology).mark(options.execution.stop)) {
        if (!std::binary_search(given.begin(), given.end(), f)) {
            out.reference.layers.push_back(topology.faces[f]);
            out.report.layer_sheets.push_back(1);
            ++out.report.sheets[1].faces;
        }
    }
    judge_marking(out.reference, cell_snapshot(out.reference, options.execution), options, out.report);
    out.report.tries = 1;
    report(options.progress, "fronts", 1.0);
    return out;
}

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/marking/mark_published-inl.hpp>
#endif
