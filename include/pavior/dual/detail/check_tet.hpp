#pragma once
/// \file
/// Checks the corners of one tetrahedron.

#include <pavior/core/error.hpp>
#include <pavior/mesh/cells.hpp>

#include <cstddef>
#include <string>

namespace pavior::detail {

/// Throws InputError (bad_index) unless the corners are four different nodes below \p nodes.
inline void check_tet(const TetCorners& c, Index t, std::size_t nodes) {
    const bool known = c[0] < nodes && c[1] < nodes && c[2] < nodes && c[3] < nodes;
    if (!known || c[0] == c[1] || c[0] == c[2] || c[0] == c[3] || c[1] == c[2] || c[1] == c[3] || c[2] == c[3]) {
        throw InputError(
            ErrorCode::bad_index,
            "tetrahedron " + std::to_string(t) + (known ? " names a node twice" : " names a node that does not exist"),
            {t});
    }
}

}  // namespace pavior::detail
