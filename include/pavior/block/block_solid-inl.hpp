#pragma once

#include <pavior/block/block_solid.hpp>
#include <pavior/block/dualize.hpp>
#include <pavior/block/place_blocks.hpp>
#include <pavior/core/stop.hpp>
#include <pavior/dual/verify_dual.hpp>

#include <cstddef>
#include <limits>

namespace pavior {

namespace detail {

PAVIOR_INLINE void analyse(SolidBlocks& solid, const Execution& execution) {
    solid.topology = tet_topology(solid.reference, execution);
    solid.classes = classify(solid.reference, solid.topology, execution);
    solid.complex = cell_complex(solid.reference, solid.topology, solid.classes, execution);
    solid.report.dual = verify_dual(solid.reference, solid.topology, solid.classes, solid.complex, execution);
}

PAVIOR_INLINE void make_blocks(SolidBlocks& solid, const BlockOptions& options) {
    check_stop(options.execution.stop);
    Stopwatch watch;
    solid.blocks = options.dualization == Dualization::contributions
                       ? dualize_contributions(solid.reference, solid.topology, solid.classes, options.execution)
                       : dualize(solid.reference, solid.topology, solid.classes, solid.complex);
    solid.report.dualize_seconds = watch.lap();
    solid.geometry = block_geometry(solid.reference, solid.topology, solid.complex, options.execution);
    PlaceOptions place = options.place;
    place.execution = options.execution;
    solid.placement = place_blocks(solid.blocks, solid.geometry, place);
    solid.report.place_seconds = watch.lap();
    solid.report.blocks = verify_blocks(solid.blocks, solid.placement.positions);
}

PAVIOR_INLINE MarkingOptions marking_options(const BlockOptions& options) {
    MarkingOptions marking = options.marking;
    if (!marking.quality) {
        marking.quality = [&options](const ReferenceMesh& mesh) { return block_quality(mesh, options); };
    }
    if (!marking.progress) {
        marking.progress = stage_of(options.progress, 0.0, 0.5);
    }
    marking.execution.stop = options.execution.stop;
    return marking;
}

PAVIOR_INLINE void block_marked(SolidBlocks& solid, const BlockOptions& options) {
    BlockSolidReport& report = solid.report;
    Stopwatch watch;
    pavior::report(options.progress, "dual", options.mark ? 0.5 : 0.0);
    analyse(solid, options.execution);
    report.dual_seconds = watch.lap();
    if (report.dual.valid()) {
        pavior::report(options.progress, "blocks", 0.6);
        make_blocks(solid, options);
        report.status = report.blocks.ok() ? BlockStatus::valid : BlockStatus::inverted_blocks;
        if (options.refine) {
            pavior::report(options.progress, "refinement", 0.7);
            static_cast<void>(watch.lap());
            RefineOptions refine = *options.refine;
            refine.execution = options.execution;
            if (!refine.progress) {
                refine.progress = stage_of(options.progress, 0.7, 1.0);
            }
            solid.fine = refine_blocks(solid.blocks, solid.geometry, solid.placement, refine);
            report.refine_seconds = watch.lap();
            const bool good = report.blocks.conforming() && solid.fine->untangling.inverted_after == 0;
            report.status = good ? BlockStatus::valid : BlockStatus::inverted_mesh;
        }
    }
    pavior::report(options.progress, "done", 1.0);
}

}  // namespace detail

PAVIOR_INLINE double block_quality(const ReferenceMesh& mesh, const BlockOptions& options) {
    SolidBlocks solid;
    solid.reference = mesh;
    detail::analyse(solid, options.execution);
    if (!solid.report.dual.valid()) {
        return -1.0;
    }
    detail::make_blocks(solid, options);
    return solid.placement.min_jacobian;
}

}  // namespace pavior
