#pragma once

#include <pavior/marking/cell_snapshot.hpp>
#include <pavior/marking/field.hpp>
#include <pavior/marking/repair_sheet.hpp>
#include <pavior/marking/stop_sheet.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace pavior {

namespace detail {

/// Curve id of the edges that wait for their sheets; they are no features.
constexpr std::int32_t waiting_curve = -7;

/// Marks the tetrahedra in which the sheet meets the edges of a waiting curve.
inline void mark_waiting(CutMesh& cut, const SheetCut& sheet, std::int32_t id) {
    std::vector<std::array<Index, 2>> crossed;
    std::vector<char> touched(cut.mesh.nodes.size(), 0);
    for (const FeatureEdge& edge : cut.mesh.curves) {
        const double a = sheet.values[edge.nodes[0]];
        const double b = sheet.values[edge.nodes[1]];
        if (edge.curve == id && a != 0 && b != 0 && (a < 0) != (b < 0)) {
            crossed.push_back(ascending(edge.nodes[0], edge.nodes[1]));
        }
        for (const Index i : edge.nodes) {
            touched[i] = edge.curve == id && sheet.values[i] == 0 ? 1 : touched[i];
        }
    }
    std::sort(crossed.begin(), crossed.end());
    cut.marks.assign(cut.mesh.tets.size(), 0);
    for (const Index t : IndexRange(cut.mesh.tets.size())) {
        const TetCorners& tet = cut.mesh.tets[t];
        const bool node = std::any_of(tet.begin(), tet.end(), [&](Index i) { return touched[i] != 0; });
        const bool edge = std::any_of(tet_edges.begin(), tet_edges.end(), [&](const std::array<int, 2>& e) {
            return std::binary_search(
                crossed.begin(), crossed.end(),
                ascending(tet[static_cast<std::size_t>(e[0])], tet[static_cast<std::size_t>(e[1])]));
        });
        cut.marks[t] = node || edge ? 1 : 0;
    }
}

[[nodiscard]] inline SheetCut repair_field(const ReferenceMesh& mesh, const RepairSheet& repair, double tolerance) {
    const SheetGroup group{repair.kind, {SheetMember{repair.surface, 1.0, {}}}};
    SheetCut sheet = sheet_field(mesh, group, {}, FrontBoundary{}, tolerance);
    for (const auto& edge : repair.contained) {
        for (const Index i : edge) {
            sheet.fixed[i] = 1;
            sheet.values[i] = 0;
        }
    }
    return sheet;
}

}  // namespace detail

PAVIOR_INLINE std::vector<std::size_t> cut_repairs(CutMesh& cut, const std::vector<RepairSheet>& repairs,
                                                   Propagation propagation, double tolerance, Index first_id) {
    for (std::size_t r = 0; r < repairs.size(); ++r) {
        const auto id = detail::waiting_curve - static_cast<std::int32_t>(r);
        for (const auto& edge : repairs[r].edges) {
            cut.mesh.curves.push_back({edge, id, CurveKind::smooth});
        }
    }
    std::vector<std::size_t> added;
    for (std::size_t r = 0; r < repairs.size(); ++r) {
        const RepairSheet& repair = repairs[r];
        SheetCut sheet = detail::repair_field(cut.mesh, repair, tolerance);
        if (repair.edges.empty()) {
            cut.marks.assign(cut.mesh.tets.size(), 0);
            for (const Index t : repair.tets) {
                cut.marks[t] = 1;
            }
            sheet.start_node = repair.node;
        } else {
            detail::mark_waiting(cut, sheet, detail::waiting_curve - static_cast<std::int32_t>(r));
        }
        sheet.start_marks = true;
        added.push_back(cut_sheet(cut, sheet, first_id + static_cast<Index>(r), propagation));
        cut.marks.clear();
    }
    std::erase_if(cut.mesh.curves, [](const FeatureEdge& edge) { return edge.curve <= detail::waiting_curve; });
    return added;
}

}  // namespace pavior
