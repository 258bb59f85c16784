#pragma once

#include <pavior/marking/cell_snapshot.hpp>
#include <pavior/marking/stop_sheet.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace pavior {

PAVIOR_INLINE std::vector<std::array<Index, 2>> stack_edges(const ReferenceMesh& mesh, const Execution& execution) {
    const TetTopology topology = tet_topology(mesh, execution);
    const EntityClasses classes = classify(mesh, topology, execution);
    std::vector<std::array<Index, 2>> edges;
    for (const Index e : IndexRange(topology.edges.size())) {
        if (classes.edge[e] == EntityClass::stack) {
            edges.push_back(topology.edges[e]);
        }
    }
    std::sort(edges.begin(), edges.end());
    return edges;
}

namespace detail {

[[nodiscard]] inline std::size_t count_violations(const CutMesh& cut) {
    return cell_snapshot(cut.mesh, cut.execution).report.violations.size();
}

/// Layers of the stopped sheet; those of the whole one where the stopped one leaves more violations than that, and no
/// fewer than there were without either.
inline std::size_t add_layers_stopping(CutMesh& cut, SheetCut& sheet, const std::vector<SheetFace>& faces, Index id) {
    sheet.barriers.clear();
    const std::vector<SheetFace> whole = keep_started(cut, sheet, faces);
    sheet.barriers = stack_edges(cut.mesh, cut.execution);
    const std::vector<SheetFace> stopped = keep_started(cut, sheet, faces);
    if (stopped.size() == whole.size()) {
        return add_layers(cut, whole, id);
    }
    const std::size_t before = count_violations(cut);
    const std::size_t added = add_layers(cut, stopped, id);
    const std::size_t with_stopped = count_violations(cut);
    if (added > 0 && (with_stopped == 0 || with_stopped < before)) {
        return added;
    }
    const std::size_t kept = cut.mesh.layers.size();
    const std::size_t rest = add_layers(cut, whole, id);
    if (added > 0 && with_stopped <= count_violations(cut)) {
        cut.mesh.layers.resize(kept);
        cut.layer_sheets.resize(kept);
        return added;
    }
    return added + rest;
}

}  // namespace detail

PAVIOR_INLINE std::size_t cut_sheet(CutMesh& cut, SheetCut& sheet, Index id, Propagation propagation) {
    if (propagation == Propagation::full) {
        return cut_sheet(cut, sheet, id);
    }
    const std::vector<SheetFace> faces = detail::bisect_along(cut, sheet);
    return detail::add_layers_stopping(cut, sheet, faces, id);
}

}  // namespace pavior
