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
    /// Marking of layers. Its `quality`, if unset, is the smallest scaled Jacobian that place_blocks() reaches; its
    /// `execution` keeps its threads and gets the token of the one below.
    MarkingOptions marking = {};
    /// False: the layers that the reference mesh comes with are all there are.
    bool mark = true;
    /// Where nodes and hexahedra of the blocks come from, those that `quality` looks at included. The cell complex is
    /// made in any case: the verdict on the dual and the shapes of chains and patches (block_geometry()) are its own.
    Dualization dualization = Dualization::complex;
    /// Its `execution` is the one below.
    PlaceOptions place = {};
    /// Refinement, with the execution below; unset (default): blocks only.
    std::optional<RefineOptions> refine = {};
    /// Threads, and the token that ends the call.
    Execution execution = sequential;
    /// Stages "marking", "dual", "blocks", "refinement", the stages of those between: from 0 to 1, never backwards.
    /// Where marking or refinement have a sink of their own, that one gets their stages, from 0 to 1 too.
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
PAVIOR_INLINE void analyse(SolidBlocks& solid, const Execution& execution);

/// Blocks and their places, the dual being valid.
PAVIOR_INLINE void make_blocks(SolidBlocks& solid, const BlockOptions& options);

/// The options of marking with what they take from those of block_solid(), which must outlive them.
[[nodiscard]] PAVIOR_INLINE MarkingOptions marking_options(const BlockOptions& options);

/// All that comes after the marking.
PAVIOR_INLINE void block_marked(SolidBlocks& solid, const BlockOptions& options);

}  // namespace detail

/// The smallest scaled Jacobian of the blocks that the layers of \p mesh make; -1 if these are not valid. Options used:
/// dualization, place, execution. \throws Stopped
[[nodiscard]] PAVIOR_INLINE double block_quality(const ReferenceMesh& mesh, const BlockOptions& options = {});

/// Decomposes the solid of \p reference into blocks (Algorithm 5.1 \cite roca2009): marks layers, analyses the dual,
/// dualizes, places the block nodes and, if asked for, refines. Geometric outcomes are in the report, not thrown.
/// The same bytes for any number of threads.
/// \throws InputError for meshes and options that make no sense; Stopped
template <classified_tet_mesh M>
[[nodiscard]] SolidBlocks block_solid(const M& reference, const BlockOptions& options = {}) {
    SolidBlocks solid;
    const Stopwatch watch;
    if (options.mark) {
        report(options.progress, "marking", 0.0);
        const MarkingOptions marking = detail::marking_options(options);
        MarkedMesh marked =
            marking.marking == Marking::sheets ? mark_sheets(reference, marking) : mark_published(reference, marking);
        solid.reference = std::move(marked.reference);
        solid.report.marking = std::move(marked.report);
    } else {
        solid.reference = detail::copy_reference(reference);
    }
    solid.report.marking_seconds = watch.total();
    detail::block_marked(solid, options);
    return solid;
}

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/block/block_solid-inl.hpp>
#endif
