#pragma once

#include <pavior/core/stop.hpp>
#include <pavior/marking/cut.hpp>
#include <pavior/marking/field.hpp>
#include <pavior/marking/judge_marking.hpp>
#include <pavior/marking/mark_sheets.hpp>
#include <pavior/marking/repair_axis.hpp>
#include <pavior/marking/repair_corner.hpp>
#include <pavior/marking/stop_sheet.hpp>
#include <pavior/math/box.hpp>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

namespace pavior {

namespace detail {

/// The curves at which the fronts of a group lie.
[[nodiscard]] inline std::vector<std::int32_t> curves_of(const SheetGroup& group, std::span<const Front> fronts) {
    std::vector<std::int32_t> curves;
    for (const SheetMember& member : group.members) {
        for (const Index f : member.fronts) {
            curves.push_back(fronts[f].curve);
        }
    }
    std::sort(curves.begin(), curves.end());
    curves.erase(std::unique(curves.begin(), curves.end()), curves.end());
    return curves;
}

/// How much longer than at a plane a sheet looks at a tetrahedron: surfaces made of facets look at each of these.
[[nodiscard]] inline double work_of(const SheetGroup& group) {
    std::size_t facets = 0;
    for (const SheetMember& member : group.members) {
        facets += member.surface.facets.size();
    }
    return 1 + static_cast<double>(facets) / 30;
}

/// The tolerance as a length. Where the boundary has shorter edges than some of these it is less, else the walls of a
/// thin slot would be one surface.
[[nodiscard]] inline double marking_tolerance(const ReferenceMesh& mesh, double relative, double size) {
    double shortest = size;
    for (const TaggedTriangle& triangle : mesh.patches) {
        for (std::size_t k = 0; k < 3; ++k) {
            shortest =
                std::min(shortest, (mesh.nodes[triangle.nodes[(k + 1) % 3]] - mesh.nodes[triangle.nodes[k]]).norm());
        }
    }
    const double tolerance = relative * size;
    return std::min(tolerance, std::max(0.05 * shortest, 1e-4 * tolerance));
}

PAVIOR_INLINE SheetMarker::SheetMarker(const ReferenceMesh& mesh, const MarkingOptions& options)
    : mesh_(mesh),
      options_(options),
      size_(box_round(std::span<const Vec3>(mesh.nodes)).extent().norm()),
      tolerance_(marking_tolerance(mesh, options.tolerance, size_)),
      topology_(tet_topology(mesh, options.execution)),
      boundary_(front_boundary(mesh, topology_)),
      fronts_(sheet_fronts(mesh, topology_, boundary_, tolerance_)) {}

PAVIOR_INLINE MarkedMesh SheetMarker::mark(Grouping grouping, const std::vector<SheetGroup>& groups,
                                           Propagation propagation, const Progress& progress) const {
    CutMesh cut{mesh_, {}, {}, options_.execution};
    SheetReport report;
    report.grouping = grouping;
    report.propagation = propagation;
    if (!mesh_.layers.empty()) {
        report.sheets.push_back({SheetKind::given, {}, 0});
        cut.layer_sheets.assign(mesh_.layers.size(), 0);
    }
    for (const SheetGroup& group : groups) {
        check_stop(options_.execution.stop);
        if (tired()) {
            break;
        }
        work_ += work_of(group) * static_cast<double>(cut.mesh.tets.size());
        SheetCut sheet = sheet_field(cut.mesh, group, fronts_, boundary_, tolerance_);
        cut_sheet(cut, sheet, static_cast<Index>(report.sheets.size()), propagation);
        report.sheets.push_back({group.kind, curves_of(group, fronts_), 0});
        pavior::report(progress, "sheets",
                       0.5 * static_cast<double>(report.sheets.size()) / static_cast<double>(groups.size() + 1));
    }
    repair(cut, report, propagation, stage_of(progress, 0.5, 1.0));
    return {std::move(cut.mesh), std::move(report)};
}

PAVIOR_INLINE void SheetMarker::repair(CutMesh& cut, SheetReport& report, Propagation propagation,
                                       const Progress& progress) const {
    CellSnapshot now = cell_snapshot(cut.mesh, cut.execution);
    const double limit =
        options_.max_growth * static_cast<double>(std::max<std::size_t>(now.complex.corners.size(), 16));
    const std::size_t most = 16 * (now.report.violations.size() + 4);
    while (!now.report.valid() && now.report.violations.size() <= most && report.rounds < options_.max_rounds &&
           static_cast<double>(now.complex.corners.size()) <= limit && !tired()) {
        std::vector<RepairSheet> repairs = repair_axes(cut.mesh, now, size_);
        if (repairs.empty()) {
            if (auto corner = repair_corner(cut.mesh, now, tolerance_, size_)) {
                repairs.push_back(std::move(*corner));
            }
        }
        const std::size_t before = cut.mesh.layers.size();
        cut_repairs(cut, repairs, propagation, tolerance_, static_cast<Index>(report.sheets.size()));
        work_ += static_cast<double>((1 + repairs.size()) * cut.mesh.tets.size());
        for (const RepairSheet& r : repairs) {
            report.sheets.push_back({r.kind, {}, 0});
        }
        ++report.rounds;
        pavior::report(progress, "repair", static_cast<double>(report.rounds) / options_.max_rounds);
        if (cut.mesh.layers.size() == before) {
            break;
        }
        now = cell_snapshot(cut.mesh, cut.execution);
    }
    report.layer_sheets = cut.layer_sheets;
    judge_marking(cut.mesh, now, options_, report);
}

PAVIOR_INLINE MarkedMesh mark_best(const SheetMarker& marker, Propagation propagation, const Progress& progress) {
    const std::vector<SheetGroup> exact = marker.groups(Grouping::exact);
    MarkedMesh best = marker.mark(Grouping::exact, exact, propagation, stage_of(progress, 0.0, 0.5));
    best.report.tries = 1;
    const std::vector<SheetGroup> blended = marker.groups(Grouping::blended);
    if (blended.size() != exact.size() && !marker.tired()) {
        MarkedMesh other = marker.mark(Grouping::blended, blended, propagation, stage_of(progress, 0.5, 1.0));
        if (better_marking(other.report, best.report)) {
            best = std::move(other);
        }
        best.report.tries = 2;
    }
    return best;
}

inline void mark_inner_faces(ReferenceMesh& mesh, const Execution& execution) {
    const TetTopology topology = tet_topology(mesh, execution);
    mesh.layers.clear();
    for (const Index f : IndexRange(topology.faces.size())) {
        if (!topology.boundary(f)) {
            mesh.layers.push_back(topology.faces[f]);
        }
    }
}

/// Parts the tetrahedra with an edge that is no stack at their centroids; true if there were any.
inline bool part_flat_tets(ReferenceMesh& mesh, const Execution& execution) {
    const TetTopology topology = tet_topology(mesh, execution);
    const EntityClasses classes = classify(mesh, topology, execution);
    std::vector<TetCorners> tets;
    for (const Index t : IndexRange(mesh.tets.size())) {
        const TetCorners c = mesh.tets[t];
        const auto& edges = topology.tet_edges[t];
        if (std::all_of(edges.begin(), edges.end(), [&](Index e) { return classes.edge[e] == EntityClass::stack; })) {
            tets.push_back(c);
            continue;
        }
        const auto centre = static_cast<Index>(mesh.nodes.size());
        mesh.nodes.emplace_back(0.25 * (mesh.nodes[c[0]] + mesh.nodes[c[1]] + mesh.nodes[c[2]] + mesh.nodes[c[3]]));
        for (std::size_t k = 0; k < 4; ++k) {
            tets.push_back(c);
            tets.back()[k] = centre;
        }
    }
    const bool parted = tets.size() > mesh.tets.size();
    mesh.tets = std::move(tets);
    return parted;
}

PAVIOR_INLINE MarkedMesh mark_everything(const ReferenceMesh& mesh, const MarkingOptions& options) {
    MarkedMesh out{mesh, {}};
    mark_inner_faces(out.reference, options.execution);
    if (part_flat_tets(out.reference, options.execution)) {
        mark_inner_faces(out.reference, options.execution);
    }
    out.report.sheets = {{SheetKind::everything, {}, 0}};
    out.report.layer_sheets.assign(out.reference.layers.size(), 0);
    judge_marking(out.reference, cell_snapshot(out.reference, options.execution), options, out.report);
    return out;
}

}  // namespace detail

}  // namespace pavior
