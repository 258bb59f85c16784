#pragma once
/// \file
/// Marking that does not depend on the reference mesh: implicit sheets cut it.

#include <pavior/core/compiled.hpp>
#include <pavior/dual/copy_reference.hpp>
#include <pavior/dual/tet_topology.hpp>
#include <pavior/marking/cut_tets.hpp>
#include <pavior/marking/fronts.hpp>
#include <pavior/marking/groups.hpp>

#include <utility>
#include <vector>

namespace pavior {

namespace detail {

/// One reference mesh and what all tries to mark it share.
class SheetMarker {
public:
    SheetMarker(const ReferenceMesh& mesh, const MarkingOptions& options);

    [[nodiscard]] std::vector<SheetGroup> groups(Grouping grouping) const {
        return sheet_groups(fronts_, boundary_, mesh_.nodes, grouping, tolerance_, options_.blend_angle);
    }

    [[nodiscard]] MarkedMesh mark(Grouping grouping, const std::vector<SheetGroup>& groups, Propagation propagation,
                                  const Progress& progress) const;

    /// Whether MarkingOptions::max_work is spent.
    [[nodiscard]] bool tired() const { return options_.max_work > 0 && work_ > options_.max_work; }

private:
    /// Adds sheets until nothing is violated, there is nothing to add or blocks or violations get out of hand.
    void repair(CutMesh& cut, SheetReport& report, Propagation propagation, const Progress& progress) const;

    const ReferenceMesh& mesh_;
    const MarkingOptions& options_;
    double size_;
    double tolerance_;
    TetTopology topology_;
    FrontBoundary boundary_;
    std::vector<Front> fronts_;
    mutable double work_ = 0;  ///< tetrahedra that sheets and rounds of all tries have seen
};

/// The better of the two groupings.
[[nodiscard]] PAVIOR_INLINE MarkedMesh mark_best(const SheetMarker& marker, Propagation propagation,
                                                 const Progress& progress);

/// True if stopped sheets are no worse than whole ones but for their Jacobians, which stay positive, and make fewer
/// blocks.
[[nodiscard]] inline bool stop_pays(const SheetReport& stopped, const SheetReport& whole) {
    return stopped.valid &&
           (!whole.valid || (stopped.blocks < whole.blocks && (stopped.quality > 0 || !(whole.quality > 0))));
}

/// True if whole sheets failed without making so many blocks that nothing better can be hoped for.
[[nodiscard]] inline bool worth_stopping(const SheetReport& whole) { return !whole.valid && whole.blocks <= 4096; }

/// Every inner face becomes a layer: midpoint subdivision of the tetrahedra. Those with an edge that only they have and
/// that is no feature, which would be no corner of a block, are parted at their centroids before.
[[nodiscard]] PAVIOR_INLINE MarkedMesh mark_everything(const ReferenceMesh& mesh, const MarkingOptions& options);

}  // namespace detail

/// Marks layers with implicit sheets: each front (a re-entrant curve and a patch beside it) is continued into the solid
/// along the surface that fits the patch; fronts on one surface share a sheet, and the sheet is cut into the
/// tetrahedra wherever it passes, so that the result does not depend on \p mesh. Extra sheets then repair what is
/// not valid: planes through the axes of closed curves and round patches, planes through two curves of corners with
/// more than three. Fronts that face each other on slightly tilted surfaces are tried as one bent sheet too; the better
/// result (better_marking()) is kept. What is left invalid is in the report.
/// With Propagation::stop, or where whole sheets find no valid marking (of some thousand blocks at most), each sheet
/// ends at chains that exist already, unless that leaves more to repair than the whole sheet does; the result of
/// Propagation::full is kept if that is valid and has no more blocks.
/// The mesh must be a reference mesh of the solid: patches, curves, vertices (make_reference_mesh()). Its layers stay.
/// O(n) a sheet; tetrahedra grow by 1.5 to 3 times. Deterministic. \throws what tet_topology() and classify() throw;
/// Stopped
template <classified_tet_mesh M>
[[nodiscard]] MarkedMesh mark_sheets(const M& mesh, const MarkingOptions& options = {}) {
    const ReferenceMesh reference = detail::copy_reference(mesh);
    if (reference.tets.empty()) {
        throw InputError(ErrorCode::empty_input, "a reference mesh without tetrahedra");
    }
    report(options.progress, "sheets", 0.0);
    const detail::SheetMarker marker(reference, options);
    MarkedMesh best = detail::mark_best(marker, Propagation::full, stage_of(options.progress, 0.0, 0.5));
    if (options.propagation == Propagation::stop || (detail::worth_stopping(best.report) && !marker.tired())) {
        MarkedMesh stopped = detail::mark_best(marker, Propagation::stop, stage_of(options.progress, 0.5, 1.0));
        stopped.report.tries += best.report.tries;
        if (detail::stop_pays(stopped.report, best.report)) {
            best = std::move(stopped);
        }
    }
    if (!best.report.valid && options.split_everything) {
        const int tries = best.report.tries;
        best = detail::mark_everything(reference, options);
        best.report.tries = tries + 1;
    }
    report(options.progress, "sheets", 1.0);
    return best;
}

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/marking/mark_sheets-inl.hpp>
#endif
