#pragma once
/// \file
/// From a reference mesh to blocks and their refinement in one call.

#include <pavior/block/block_geometry.hpp>
#include <pavior/block/block_mesh.hpp>
#include <pavior/block/refine_blocks.hpp>
#include <pavior/block/verify_blocks.hpp>
#include <pavior/core/compiled.hpp>
#include <pavior/core/execution.hpp>
#include <pavior/core/progress.hpp>
#include <pavior/core/stopwatch.hpp>
#include <pavior/dual/cell_complex.hpp>
#include <pavior/dual/classify.hpp>
#include <pavior/dual/copy_reference.hpp>
#include <pavior/dual/reference_mesh.hpp>
#include <pavior/dual/tet_topology.hpp>
#include <pavior/marking/mark_published.hpp>
#include <pavior/marking/mark_sheets.hpp>
#include <pavior/marking/marking.hpp>

#include <cstdint>
#include <optional>
#include <string_view>
#include <utility>

namespace pavior {

/// Options of block_solid().
struct BlockOptions {
    /// Marking of layers. Its `quality`, if unset, is the smallest scaled Jacobian that place_blocks() reaches.
    MarkingOptions marking = {};
    /// False: the layers that the reference mesh comes with are all there are.
    bool mark = true;
    PlaceOptions place = {};
    /// Refinement, with the threads below; unset (default): blocks only.
    std::optional<RefineOptions> refine = {};
    Execution execution = sequential;
    Progress progress = {};
};

/// How far block_solid() came.
enum class BlockStatus : std::uint8_t {
    valid,            ///< everything asked for is there and valid
    invalid_dual,     ///< the layers make no valid blocks: there are none; see BlockSolidReport::dual
    inverted_blocks,  ///< the blocks are valid topologically, but some are inverted; no refinement was asked for
    inverted_mesh,    ///< the refinement is conforming, but some hexahedra are inverted
};

/// The stable name of \p status.
[[nodiscard]] constexpr std::string_view to_string(BlockStatus status) noexcept {
    switch (status) {
        case BlockStatus::valid: return "valid";
        case BlockStatus::invalid_dual: return "invalid_dual";
        case BlockStatus::inverted_blocks: return "inverted_blocks";
        case BlockStatus::inverted_mesh: return "inverted_mesh";
    }
    return "unknown";
}

/// What block_solid() did.
struct BlockSolidReport {
    BlockStatus status = BlockStatus::invalid_dual;
    SheetReport marking;
    DualReport dual;
    BlockReport blocks;  ///< empty if the dual is not valid
    double marking_seconds = 0.0, dual_seconds = 0.0, dualize_seconds = 0.0, place_seconds = 0.0, refine_seconds = 0.0;
};

/// Blocks of a solid and all that led to them.
struct SolidBlocks {
    ReferenceMesh reference;  ///< cut by the sheets, with its layers
    TetTopology topology;
    EntityClasses classes;
    CellComplex complex;
    BlockMesh blocks;  ///< this and what follows is empty if the dual is not valid
    BlockGeometry geometry;
    BlockPlacement placement;
    std::optional<RefinedBlocks> fine;
    BlockSolidReport report;
};

namespace detail {

/// Topology, classes, cell complex and its verdict.
PAVIOR_INLINE void analyse(SolidBlocks& solid, Execution execution);

/// Blocks and their places, the dual being valid.
PAVIOR_INLINE void make_blocks(SolidBlocks& solid, const PlaceOptions& place, Execution execution);

}  // namespace detail

/// The smallest scaled Jacobian of the blocks that the layers of \p mesh make; -1 if these are not valid.
[[nodiscard]] PAVIOR_INLINE double block_quality(const ReferenceMesh& mesh, const PlaceOptions& place = {},
                                                 Execution execution = sequential);

/// Decomposes the solid of \p reference into blocks (Algorithm 5.1 \cite roca2009): marks layers, analyses the dual,
/// dualizes, places the block nodes and, if asked for, refines. Geometric outcomes are in the report, not thrown.
/// The same bytes for any number of threads.
/// \throws InputError for meshes and options that make no sense
template <classified_tet_mesh M>
[[nodiscard]] SolidBlocks block_solid(const M& reference, const BlockOptions& options = {}) {
    SolidBlocks solid;
    BlockSolidReport& report = solid.report;
    Stopwatch watch;
    if (options.mark) {
        MarkingOptions marking = options.marking;
        if (!marking.quality) {
            marking.quality = [&](const ReferenceMesh& mesh) {
                return block_quality(mesh, options.place, options.execution);
            };
        }
        if (!marking.progress) {
            marking.progress = options.progress;
        }
        pavior::report(options.progress, "marking", 0.0);
        MarkedMesh marked =
            marking.marking == Marking::sheets ? mark_sheets(reference, marking) : mark_published(reference, marking);
        solid.reference = std::move(marked.reference);
        report.marking = std::move(marked.report);
    } else {
        solid.reference = detail::copy_reference(reference);
    }
    report.marking_seconds = watch.lap();
    pavior::report(options.progress, "dual", 0.5);
    detail::analyse(solid, options.execution);
    report.dual_seconds = watch.lap();
    if (!report.dual.valid()) {
        return solid;
    }
    pavior::report(options.progress, "blocks", 0.6);
    detail::make_blocks(solid, options.place, options.execution);
    report.status = report.blocks.ok() ? BlockStatus::valid : BlockStatus::inverted_blocks;
    if (options.refine) {
        pavior::report(options.progress, "refinement", 0.7);
        static_cast<void>(watch.lap());
        RefineOptions refine = *options.refine;
        refine.execution = options.execution;
        if (!refine.progress) {
            refine.progress = options.progress;
        }
        solid.fine = refine_blocks(solid.blocks, solid.geometry, solid.placement, refine);
        report.refine_seconds = watch.lap();
        const bool good = report.blocks.conforming() && solid.fine->untangling.inverted_after == 0;
        report.status = good ? BlockStatus::valid : BlockStatus::inverted_mesh;
    }
    return solid;
}

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/block/block_solid-inl.hpp>
#endif
