#pragma once
/// \file
/// What the checks of meshes report: kinds of faults, exact counts, and some of the offenders.

#include <pavior/core/compiled.hpp>
#include <pavior/core/error.hpp>

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

namespace pavior {

/// Kinds of faults of a mesh, in the order in which they are reported.
enum class MeshFault : std::uint8_t {
    empty,             ///< no cell
    not_finite,        ///< node with a NaN or infinite coordinate (node)
    id_out_of_range,   ///< cell with a node id that does not exist (cell)
    repeated_node,     ///< cell that names a node twice (cell)
    duplicate_cell,    ///< cell on the same nodes as an earlier one (cell)
    overused,          ///< edge of more than two quads, quad of more than two hexahedra (nodes of edge or quad)
    same_sense,        ///< edge or quad that its two cells see with the same orientation (nodes of edge or quad)
    touching_sheets,   ///< node where two sheets of quads meet that share no edge there (node)
    unused_node,       ///< node of no cell (node)
    duplicate_node,    ///< node in the place of an earlier one (node, earlier node)
    inverted,          ///< hexahedron with a determinant that is not positive (cell)
    open_boundary,     ///< edge with an odd number of boundary quads (two nodes)
    boundary_missing,  ///< quad of the given boundary that is not on that of the mesh (four nodes)
    boundary_extra,    ///< boundary quad of the mesh that was not given (four nodes)
    volume_mismatch,   ///< sum of the volumes differs from the flux through the boundary (no ids)
    disconnected,      ///< more components than wanted (one cell of each)
};

/// One phrase about \p fault.
[[nodiscard]] constexpr std::string_view to_string(MeshFault fault) noexcept {
    switch (fault) {
        case MeshFault::empty: return "mesh without cells";
        case MeshFault::not_finite: return "nodes not finite";
        case MeshFault::id_out_of_range: return "cells with node ids out of range";
        case MeshFault::repeated_node: return "cells that repeat a node";
        case MeshFault::duplicate_cell: return "duplicate cells";
        case MeshFault::overused: return "edges or faces used more than twice";
        case MeshFault::same_sense: return "edges or faces used twice in the same sense";
        case MeshFault::touching_sheets: return "nodes where two sheets touch";
        case MeshFault::unused_node: return "nodes of no cell";
        case MeshFault::duplicate_node: return "nodes in the place of an earlier one";
        case MeshFault::inverted: return "inverted cells";
        case MeshFault::open_boundary: return "edges where the boundary is open";
        case MeshFault::boundary_missing: return "given boundary quads missing";
        case MeshFault::boundary_extra: return "boundary quads that were not given";
        case MeshFault::volume_mismatch: return "volume differs from the flux through the boundary";
        case MeshFault::disconnected: return "components";
    }
    return "unknown";
}

/// The error that throw_if_bad() throws for \p fault.
[[nodiscard]] constexpr ErrorCode error_code(MeshFault fault) noexcept {
    switch (fault) {
        case MeshFault::empty: return ErrorCode::empty_input;
        case MeshFault::not_finite: return ErrorCode::not_finite;
        case MeshFault::id_out_of_range:
        case MeshFault::repeated_node: return ErrorCode::bad_index;
        case MeshFault::duplicate_cell:
        case MeshFault::same_sense: return ErrorCode::bad_orientation;
        case MeshFault::unused_node: return ErrorCode::unused_node;
        case MeshFault::duplicate_node: return ErrorCode::duplicate_node;
        case MeshFault::inverted: return ErrorCode::inverted_cell;
        case MeshFault::boundary_missing:
        case MeshFault::boundary_extra: return ErrorCode::inconsistent_boundary;
        case MeshFault::volume_mismatch: return ErrorCode::volume_mismatch;
        case MeshFault::overused:
        case MeshFault::touching_sheets:
        case MeshFault::open_boundary:
        case MeshFault::disconnected: return ErrorCode::non_manifold;
    }
    return ErrorCode::non_manifold;
}

/// All faults of one kind: how many, and the ids of the first ones.
struct Finding {
    MeshFault fault = MeshFault::empty;
    std::size_t count = 0;         ///< exact
    std::size_t ids_per_item = 1;  ///< 1 node or cell, 2 nodes of an edge, 4 of a quad
    Error::Ids ids;                ///< ids_per_item for each of the first min(count, cap) offenders

    friend bool operator==(const Finding&, const Finding&) = default;
};

/// Findings of a check, at most one of a kind, in the order of MeshFault. Empty: the mesh is sound.
class VerifyReport {
public:
    /// \p cap: offenders of a kind whose ids are kept. Counts are always exact.
    explicit VerifyReport(std::size_t cap) : cap_(cap) {}
    /// 16 of a kind.
    VerifyReport() = default;

    [[nodiscard]] bool ok() const { return findings_.empty(); }
    [[nodiscard]] const std::vector<Finding>& findings() const { return findings_; }
    /// The first finding, null if there is none.
    [[nodiscard]] const Finding* first() const { return ok() ? nullptr : findings_.data(); }
    /// The finding of this kind, null if there is none.
    [[nodiscard]] const Finding* find(MeshFault fault) const {
        const std::size_t at = position(fault);
        return at < findings_.size() && findings_[at].fault == fault ? &findings_[at] : nullptr;
    }
    /// Number of faults of this kind, 0 if there is none.
    [[nodiscard]] std::size_t count(MeshFault fault) const {
        const Finding* found = find(fault);
        return found != nullptr ? found->count : 0;
    }

    /// One line a finding: "3 inverted cells: 4, 8, 15"; empty if there is none.
    [[nodiscard]] std::string text() const;

    /// Throws InputError with the code and ids of the first finding and the text of all; nothing if there is none.
    void throw_if_bad() const {
        if (!ok()) {
            throw InputError(error_code(findings_.front().fault), text(), findings_.front().ids);
        }
    }

    /// Records one offender; all of one kind have the same number of ids.
    void add(MeshFault fault, std::initializer_list<std::int64_t> ids);
    /// Records the offenders of \p other after those of this.
    void append(const VerifyReport& other);

private:
    /// Where findings of this kind are or belong.
    [[nodiscard]] std::size_t position(MeshFault fault) const;
    Finding& slot(MeshFault fault, std::size_t ids_per_item);

    std::size_t cap_ = 16;
    std::vector<Finding> findings_;
};

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/mesh/verify_report-inl.hpp>
#endif
