#pragma once
/// \file
/// The solver of integer programs of the compiled part pavior::glpk.

#include <pavior/intervals/integer_program.hpp>

namespace pavior {

/// Solves by branch and bound (GLPK). Silent; never ends the process. Deterministic unless the time limit strikes.
/// Not to be called from several threads at once unless GLPK is built with thread-local storage (Debian's is).
/// \throws InputError bad_index for a term that names no variable or names one twice in a row, not_finite for NaN or
/// infinite costs or coefficients, bad_option for options that are not positive (relative_gap may be 0).
[[nodiscard]] IntegerSolution solve(const IntegerProgram& program, const IntegerProgramOptions& options = {});

/// solve() with its options: an integer_solver.
struct GlpkSolver {
    IntegerProgramOptions options;

    [[nodiscard]] IntegerSolution operator()(const IntegerProgram& program) const { return solve(program, options); }
};

}  // namespace pavior
