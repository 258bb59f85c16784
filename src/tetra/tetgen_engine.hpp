#pragma once
// TetGen behind plain arrays. Internal to the tetra component.

#include "plc.hpp"

#include <string>

namespace pavior::detail {

/// Loads the library, once for the process and its children. Thread-safe.
/// \throws Error(tetrahedra_failed) if there is none
void prepare_tetgen();

/// Runs TetGen on \p plc with \p switches (those of its command line). Call it in a child: it may do whatever TetGen
/// does, and leaves memory behind.
/// \throws Error(tetrahedra_failed) with the reason
[[nodiscard]] RawTets run_tetgen(const Plc& plc, const std::string& switches);

}  // namespace pavior::detail
