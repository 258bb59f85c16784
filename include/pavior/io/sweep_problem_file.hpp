#pragma once
/// \file
/// Sweep problems as JSON files.

#include <pavior/sweep/problem.hpp>

#include <string>

namespace pavior {

/// Reads a sweep problem. The file is one JSON object with the keys
///   source_nodes, target_nodes  [[x, y, z], ...], numbered alike
///   quads                       [[a, b, c, d], ...]
///   loops                       [[a, b, ...], ...]; optional: found in the quads if absent
///   boundary_levels             [level 0, ..., level r], each [[x, y, z], ...]: the points of the loops in their order
///   layers                      r; optional
/// Other keys are ignored. The strings "nan", "inf" and "-inf" stand for the numbers that JSON lacks. Ids that are
/// negative or beyond 32 bits become 4294967295, which no mesh has.
/// \throws FileError (missing file, no JSON, key missing or of the wrong form, naming the key), InputError
/// size_mismatch (a level that has not one point for each loop node, layers that are not the levels less one). All
/// else is left to verify_problem().
[[nodiscard]] SweepProblem read_sweep_problem(const std::string& file);

}  // namespace pavior
