#pragma once

#include <pavior/core/error.hpp>

#include <utility>

namespace pavior {

PAVIOR_INLINE std::string_view to_string(ErrorCode code) noexcept {
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

PAVIOR_INLINE Error::Error(ErrorCode code, const std::string& message, Ids ids)
    : std::runtime_error(std::string(to_string(code)) + ": " + message), code_(code), ids_(std::move(ids)) {}

PAVIOR_INLINE FileError::FileError(const std::string& file, const std::string& message, Ids ids)
    : Error(ErrorCode::unreadable_file, file + ": " + message, std::move(ids)), file_(file) {}

}  // namespace pavior
