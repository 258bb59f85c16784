#pragma once
/// \file
/// The typed errors of pavior: what a caller did wrong, and to which entities.

#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace pavior {

/// What went wrong. The names are stable: they appear in reports and are what the command line prints.
enum class ErrorCode : std::uint8_t {
    not_finite,               ///< a coordinate is NaN or infinite
    empty_input,              ///< nothing to work on
    size_mismatch,            ///< two arrays that must agree in length do not
    bad_index,                ///< an id lies outside its range, or one cell names a node twice
    bad_orientation,          ///< two cells run along one edge in the same sense
    non_manifold,             ///< an edge with more than two cells, or a vertex where two sheets touch
    loops_do_not_match_mesh,  ///< the loops given are not the boundary of the mesh
    inconsistent_boundary,    ///< a boundary node and its point of the first or last level differ
    unused_node,              ///< a node that no cell uses
    null_pseudo_area,         ///< a loop encloses no area, so that it has no normal
    source_degenerate,        ///< the source loop spans less than a plane
    target_degenerate,        ///< the target loop spans less than a plane
    unrelated_loops,          ///< the two loops are not correlated
    orientation_reversed,     ///< consecutive loops have opposite normals
    overflow,                 ///< coordinates too large for the arithmetic
    bad_option,               ///< an option out of its range
    unreadable_file,          ///< a file that cannot be opened, parsed or written
    cad_failure,              ///< the CAD kernel or surface mesher refused
    infeasible_intervals,     ///< no assignment of edge divisions satisfies all faces
    inverted_cell,            ///< a quad or hexahedron that is folded somewhere
    duplicate_node,           ///< two nodes in one place
    volume_mismatch,          ///< the cells and their boundary enclose different volumes
    not_sweepable,            ///< the solid breaks a condition of section 2.1 \cite roca2009
    open_surface,             ///< a surface that must be closed has an edge with one triangle
    self_intersection,        ///< two triangles of a surface cross or overlap
    degenerate_triangle,      ///< a triangle without area
    tetrahedra_failed,        ///< the tetrahedralizer gave up
    invalid_dual,             ///< the dual surfaces break a condition for hexahedral blocks
    not_submappable,          ///< a face or solid is no union of logical rectangles or boxes
};

/// The stable name of \p code, e.g. "null_pseudo_area".
[[nodiscard]] constexpr std::string_view to_string(ErrorCode code) noexcept {
    switch (code) {
        case ErrorCode::not_finite: return "not_finite";
        case ErrorCode::empty_input: return "empty_input";
        case ErrorCode::size_mismatch: return "size_mismatch";
        case ErrorCode::bad_index: return "bad_index";
        case ErrorCode::bad_orientation: return "bad_orientation";
        case ErrorCode::non_manifold: return "non_manifold";
        case ErrorCode::loops_do_not_match_mesh: return "loops_do_not_match_mesh";
        case ErrorCode::inconsistent_boundary: return "inconsistent_boundary";
        case ErrorCode::unused_node: return "unused_node";
        case ErrorCode::null_pseudo_area: return "null_pseudo_area";
        case ErrorCode::source_degenerate: return "source_degenerate";
        case ErrorCode::target_degenerate: return "target_degenerate";
        case ErrorCode::unrelated_loops: return "unrelated_loops";
        case ErrorCode::orientation_reversed: return "orientation_reversed";
        case ErrorCode::overflow: return "overflow";
        case ErrorCode::bad_option: return "bad_option";
        case ErrorCode::unreadable_file: return "unreadable_file";
        case ErrorCode::cad_failure: return "cad_failure";
        case ErrorCode::infeasible_intervals: return "infeasible_intervals";
        case ErrorCode::inverted_cell: return "inverted_cell";
        case ErrorCode::duplicate_node: return "duplicate_node";
        case ErrorCode::volume_mismatch: return "volume_mismatch";
        case ErrorCode::not_sweepable: return "not_sweepable";
        case ErrorCode::open_surface: return "open_surface";
        case ErrorCode::self_intersection: return "self_intersection";
        case ErrorCode::degenerate_triangle: return "degenerate_triangle";
        case ErrorCode::tetrahedra_failed: return "tetrahedra_failed";
        case ErrorCode::invalid_dual: return "invalid_dual";
        case ErrorCode::not_submappable: return "not_submappable";
    }
    return "unknown";
}

/// Base of all exceptions thrown by pavior. `what()` reads "<code>: <message>".
/// `ids()` holds the offending entities, in the numbering that the message names (nodes, quads, levels, faces ...).
class Error : public std::runtime_error {
public:
    using Ids = std::vector<std::int64_t>;

    Error(ErrorCode code, const std::string& message, Ids ids = {})
        : std::runtime_error(std::string(to_string(code)) + ": " + message), code_(code), ids_(std::move(ids)) {}

    [[nodiscard]] ErrorCode code() const noexcept { return code_; }
    [[nodiscard]] const Ids& ids() const noexcept { return ids_; }

private:
    ErrorCode code_;
    Ids ids_;
};

/// The data handed in is wrong (arrays, meshes, loops, options).
class InputError : public Error {
public:
    using Error::Error;
};

/// A file cannot be read or written; `file()` names it.
class FileError : public Error {
public:
    FileError(const std::string& file, const std::string& message, Ids ids = {})
        : Error(ErrorCode::unreadable_file, file + ": " + message, std::move(ids)), file_(file) {}

    [[nodiscard]] const std::string& file() const noexcept { return file_; }

private:
    std::string file_;
};

/// The input is sound but this method cannot mesh it; `ids()` names the entities that stand in the way.
class UnmeshableError : public Error {
public:
    using Error::Error;
};

}  // namespace pavior
