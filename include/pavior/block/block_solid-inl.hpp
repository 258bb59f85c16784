#pragma once

#include <pavior/block/block_solid.hpp>
#include <pavior/block/dualize.hpp>
#include <pavior/block/place_blocks.hpp>
#include <pavior/dual/verify_dual.hpp>

#include <cstddef>
#include <limits>

namespace pavior {

namespace detail {

PAVIOR_INLINE void analyse(SolidBlocks& solid, Execution execution) {
    solid.topology = tet_topology(solid.reference, execution);
    solid.classes = classify(solid.reference, solid.topology, execution);
    solid.complex = cell_complex(solid.reference, solid.topology, solid.classes, execution);
    solid.report.dual = verify_dual(solid.reference, solid.topology, solid.classes, solid.complex);
}

PAVIOR_INLINE void make_blocks(SolidBlocks& solid, const PlaceOptions& place, Execution execution) {
    Stopwatch watch;
    solid.blocks = dualize(solid.reference, solid.topology, solid.classes, solid.complex);
    solid.report.dualize_seconds = watch.lap();
    solid.geometry = block_geometry(solid.reference, solid.topology, solid.complex, execution);
    solid.placement = place_blocks(solid.blocks, solid.geometry, place);
    solid.report.place_seconds = watch.lap();
    solid.report.blocks = verify_blocks(solid.blocks, solid.placement.positions);
}

}  // namespace detail

PAVIOR_INLINE double block_quality(const ReferenceMesh& mesh, const PlaceOptions& place, Execution execution) {
    SolidBlocks solid;
    solid.reference = mesh;
    detail::analyse(solid, execution);
    if (!solid.report.dual.valid()) {
        return -1.0;
    }
    detail::make_blocks(solid, place, execution);
    return solid.placement.min_jacobian;
}

}  // namespace pavior
