#pragma once
/// \file
/// The typed errors of pavior: what a caller did wrong, and to which entities.

#include <pavior/core/compiled.hpp>

#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
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
[[nodiscard]] std::string_view to_string(ErrorCode code) noexcept;

/// Base of all exceptions thrown by pavior. `what()` reads "<code>: <message>".
/// `ids()` holds the offending entities, in the numbering that the message names (nodes, quads, levels, faces ...).
class Error : public std::runtime_error {
public:
    using Ids = std::vector<std::int64_t>;

    Error(ErrorCode code, const std::string& message, Ids ids = {});

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
    FileError(const std::string& file, const std::string& message, Ids ids = {});

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

#ifndef PAVIOR_COMPILED
#include <pavior/core/error-inl.hpp>
#endif
