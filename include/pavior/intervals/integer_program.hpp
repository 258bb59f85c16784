#pragma once
/// \file
/// Small mixed-integer linear programs as plain data, and what solves them: any callable, e.g. that of pavior::glpk.

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace pavior {

/// No bound.
inline constexpr double no_bound = std::numeric_limits<double>::infinity();

/// minimise sum cost_j x_j subject to lower_j <= x_j <= upper_j, lower_i <= sum a_ij x_j <= upper_i, x_j integer where
/// asked for.
struct IntegerProgram {
    struct Variable {
        double lower = 0.0;
        double upper = no_bound;
        double cost = 0.0;
        bool integer = true;
        std::string name;  ///< for messages; may be empty
    };
    struct Row {
        double lower = -no_bound;
        double upper = no_bound;
        std::vector<std::pair<std::size_t, double>> terms;  ///< variable and coefficient, each variable at most once
        std::string name;
    };

    std::vector<Variable> variables;
    std::vector<Row> rows;
    double relative_gap = 1e-9;  ///< a solution this close to the bound is good enough, relative to the objective

    /// Appends a variable and returns its index.
    std::size_t add(Variable variable) {
        variables.push_back(std::move(variable));
        return variables.size() - 1;
    }
};

enum class ProgramStatus : std::uint8_t {
    optimal,     ///< proven within the gap asked for
    feasible,    ///< a solution, but the time or the solver's strength was used up before the proof
    infeasible,  ///< proven: there is none
    unbounded,   ///< the objective can be made as small as one likes
    unsolved     ///< neither a solution nor a proof
};

struct IntegerSolution {
    ProgramStatus status = ProgramStatus::unsolved;
    double objective = 0.0;
    std::vector<double> values;  ///< per variable, integers exact; empty unless optimal or feasible

    [[nodiscard]] bool found() const { return status == ProgramStatus::optimal || status == ProgramStatus::feasible; }
};

struct IntegerProgramOptions {
    double seconds = 60.0;               ///< limit of time; the result is deterministic as long as it is not reached
    std::optional<double> relative_gap;  ///< instead of the program's own
};

/// Solves integer programs: solver(program) is convertible to an IntegerSolution. `solve` of pavior::glpk is one.
template <class S>
concept integer_solver = requires(S& solver, const IntegerProgram& program) {
    { solver(program) } -> std::convertible_to<IntegerSolution>;
};

/// Any integer_solver that can be copied, behind one type; std::ref() of one that cannot.
using IntegerSolver = std::function<IntegerSolution(const IntegerProgram& program)>;

}  // namespace pavior
