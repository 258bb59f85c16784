#pragma once
/// \file
/// The cells that the layers of a reference mesh cut out, what is wrong with them, and how good blocks they make.

#include <pavior/core/compiled.hpp>
#include <pavior/dual/cell_complex.hpp>
#include <pavior/dual/classify.hpp>
#include <pavior/dual/dual_report.hpp>

namespace pavior {

/// Everything that the marking asks about one state of a mesh.
struct CellSnapshot {
    TetTopology topology;
    EntityClasses classes;
    CellComplex complex;
    DualReport report;
};

/// O(n). \throws Stopped
[[nodiscard]] PAVIOR_INLINE CellSnapshot cell_snapshot(const ReferenceMesh& mesh,
                                                       const Execution& execution = sequential);

/// How good the blocks are that the corners make.
struct CellQuality {
    double jacobian = -1.0;  ///< smallest scaled Jacobian
    double aspect = 0.0;     ///< smallest ratio of the shortest to the longest edge of a block
};

/// The quality when vertices stay, chains are put at half their length, patches and cells at their centroids; -1 and 0
/// if a corner is not regular. O(n).
[[nodiscard]] PAVIOR_INLINE CellQuality simple_quality(const ReferenceMesh& mesh, const CellSnapshot& s);

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/marking/cell_snapshot-inl.hpp>
#endif
