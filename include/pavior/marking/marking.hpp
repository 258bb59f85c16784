#pragma once
/// \file
/// What the marking of layer faces takes and reports: options, sheets, outcome.

#include <pavior/core/execution.hpp>
#include <pavior/core/progress.hpp>
#include <pavior/dual/dual_report.hpp>
#include <pavior/dual/reference_mesh.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string_view>
#include <vector>

namespace pavior {

/// How inner faces of the reference mesh become layers.
enum class Marking : std::uint8_t {
    sheets,     ///< implicit sheets: zero sets that cut the reference mesh (mark_sheets.hpp)
    published,  ///< faces that exist, by their normals: Algorithm 5.12 \cite roca2009 (mark_published.hpp)
};

/// How far a sheet runs on.
enum class Propagation : std::uint8_t {
    full,  ///< to the boundary of the solid
    stop,  ///< to the boundary, or to a chain that exists already where that is valid: fewer blocks
};

/// Which fronts share one sheet.
enum class Grouping : std::uint8_t {
    exact,    ///< those on one surface
    blended,  ///< also those on nearly one surface that face each other: the sheet bends from one to the other
};

/// How layers are marked, by mark_sheets() or mark_published(). The latter uses `quality`, `execution` and `progress`
/// only.
struct MarkingOptions {
    /// Which of the two block_solid() takes; they do not look at it themselves.
    Marking marking = Marking::sheets;
    /// How far sheets run on. mark_sheets() tries `stop` by itself where `full` finds nothing valid.
    Propagation propagation = Propagation::full;
    /// Points closer than this to a surface lie on it; relative to the diagonal of the bounding box. Above 0; what the
    /// coordinates of the boundary are exact to.
    double tolerance = 1e-6;
    /// Fronts that face each other may share a blended sheet if each sees the other within this angle, in degrees, of
    /// its surface, and the surfaces turn by no more than twice this. 0: only those on one surface do.
    double blend_angle = 15.0;
    /// Rounds of repair a try, each of which adds sheets; 0: none.
    int max_rounds = 24;
    /// Repair gives up when there are more blocks than this times those of the first round (taken as 16 at least), or
    /// when violations have multiplied by 16.
    double max_growth = 64.0;
    /// Sheets and rounds are given up when those of all tries together have seen so many tetrahedra; 0: no limit. A
    /// second sees some 300000. The best of the tries made by then counts.
    double max_work = 0.0;
    /// What to do when repair gives up: true marks every face of the reference mesh as a layer, which makes four
    /// blocks of each tetrahedron and is always valid (tetrahedra with two faces on one smooth patch are parted at
    /// their centroids before); false leaves the violations in the report.
    bool split_everything = false;
    /// Smallest scaled Jacobian of the blocks of a valid marking, 1 for cubes, by which tries are compared; unset: that
    /// of a simple placement. Called from the calling thread, once for each valid try.
    std::function<double(const ReferenceMesh&)> quality;
    /// Threads of topology and cells, and the token that ends the call.
    Execution execution = sequential;
    /// Stages "sheets" and "repair" of each try, or "fronts": from 0 to 1, never backwards.
    Progress progress;
};

/// Why a sheet is there.
enum class SheetKind : std::uint8_t {
    given,       ///< layers that the reference mesh came with
    front,       ///< continues a patch past a corner or reversal curve
    reversal,    ///< stands on a reversal curve
    axis,        ///< repair: plane through the axis of closed curves or round patches
    corner,      ///< repair: splits a corner with more than three curves
    centre,      ///< repair: plane through the centre of something without an axis
    published,   ///< marked by Algorithm 5.12
    everything,  ///< every face of the reference mesh
};

/// The stable name of \p kind.
[[nodiscard]] constexpr std::string_view to_string(SheetKind kind) noexcept {
    switch (kind) {
        case SheetKind::given: return "given";
        case SheetKind::front: return "front";
        case SheetKind::reversal: return "reversal";
        case SheetKind::axis: return "axis";
        case SheetKind::corner: return "corner";
        case SheetKind::centre: return "centre";
        case SheetKind::published: return "published";
        case SheetKind::everything: return "everything";
    }
    return "unknown";
}

/// One sheet: a set of layer faces that one field has cut.
struct Sheet {
    SheetKind kind = SheetKind::front;
    std::vector<std::int32_t> curves;  ///< feature curves it starts at; empty for repairs
    std::size_t faces = 0;             ///< layer faces it has in the end

    friend bool operator==(const Sheet&, const Sheet&) = default;
};

/// How the marking went.
struct SheetReport {
    bool valid = false;                     ///< no violation is left
    std::vector<DualViolation> violations;  ///< that are left; ids of the cell complex of the result
    std::size_t blocks = 0;                 ///< corners of cells: the hexahedra if valid
    std::size_t nodes = 0;                  ///< cells of all dimensions: the block nodes if valid
    double quality = -1.0;                  ///< smallest scaled Jacobian (MarkingOptions::quality); -1 if not valid
    double aspect = 0.0;  ///< smallest ratio of edges of a block, simply placed (simple_quality()); 0 if not valid
    std::vector<Sheet> sheets;
    std::vector<Index> layer_sheets;              ///< per layer of the reference mesh, its sheet
    Grouping grouping = Grouping::exact;          ///< of the result
    Propagation propagation = Propagation::full;  ///< of the result, which may differ from what was asked for
    int rounds = 0;                               ///< of repair in the result
    int tries = 0;                                ///< groupings that were tried
};

/// The reference mesh, cut by the sheets and with its layers, and how it came about.
struct MarkedMesh {
    ReferenceMesh reference;
    SheetReport report;
};

}  // namespace pavior
