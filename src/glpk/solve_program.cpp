#include <pavior/core/error.hpp>
#include <pavior/glpk/solve_program.hpp>

#include <glpk.h>

#include <algorithm>
#include <cmath>
#include <csetjmp>
#include <memory>

namespace pavior {

namespace {

struct ProblemDeleter {
    void operator()(glp_prob* problem) const { glp_delete_prob(problem); }
};
using Problem = std::unique_ptr<glp_prob, ProblemDeleter>;

/// GLPK's environment of this thread, given back at the end unless it was there before.
class Environment {
public:
    Environment() : own_(glp_init_env() == 0) {}
    ~Environment() {
        if (own_) {
            glp_free_env();
        }
    }
    Environment(const Environment&) = delete;
    Environment& operator=(const Environment&) = delete;

private:
    bool own_;
};

/// Keeps GLPK quiet while it lives.
class Silence {
public:
    Silence() : before_(glp_term_out(GLP_OFF)) {}
    ~Silence() { glp_term_out(before_); }
    Silence(const Silence&) = delete;
    Silence& operator=(const Silence&) = delete;

private:
    int before_;
};

void check(const IntegerProgram& program, const IntegerProgramOptions& options) {
    if (!(options.seconds > 0.0) || !(options.relative_gap.value_or(program.relative_gap) >= 0.0)) {
        throw InputError(ErrorCode::bad_option, "integer program: the time limit must be positive, the gap >= 0");
    }
    for (std::size_t j = 0; j < program.variables.size(); ++j) {
        const IntegerProgram::Variable& v = program.variables[j];
        if (!std::isfinite(v.cost) || std::isnan(v.lower) || std::isnan(v.upper)) {
            throw InputError(ErrorCode::not_finite, "integer program: variable " + std::to_string(j) + " " + v.name,
                             {static_cast<std::int64_t>(j)});
        }
    }
    std::vector<std::size_t> last_row(program.variables.size(), program.rows.size());
    for (std::size_t i = 0; i < program.rows.size(); ++i) {
        const IntegerProgram::Row& row = program.rows[i];
        const std::string name = "integer program: row " + std::to_string(i) + " " + row.name;
        if (std::isnan(row.lower) || std::isnan(row.upper)) {
            throw InputError(ErrorCode::not_finite, name, {static_cast<std::int64_t>(i)});
        }
        for (const auto& [variable, coefficient] : row.terms) {
            if (variable >= program.variables.size() || last_row[variable] == i) {
                throw InputError(ErrorCode::bad_index, name, {static_cast<std::int64_t>(i)});
            }
            if (!std::isfinite(coefficient)) {
                throw InputError(ErrorCode::not_finite, name, {static_cast<std::int64_t>(i)});
            }
            last_row[variable] = i;
        }
    }
}

/// Bounds that contradict each other; GLPK calls them an error rather than infeasible.
bool contradictory(const IntegerProgram& program) {
    const auto empty = [](double lower, double upper) {
        return lower > upper || lower == no_bound || upper == -no_bound;
    };
    return std::any_of(program.variables.begin(), program.variables.end(),
                       [&](const IntegerProgram::Variable& v) {
                           return v.integer ? empty(std::ceil(v.lower), std::floor(v.upper)) : empty(v.lower, v.upper);
                       }) ||
           std::any_of(program.rows.begin(), program.rows.end(),
                       [&](const IntegerProgram::Row& row) { return empty(row.lower, row.upper); });
}

int bound_type(double lower, double upper) {
    if (std::isfinite(lower)) {
        return !std::isfinite(upper) ? GLP_LO : lower == upper ? GLP_FX : GLP_DB;
    }
    return std::isfinite(upper) ? GLP_UP : GLP_FR;
}

void load(glp_prob* problem, const IntegerProgram& program) {
    glp_set_obj_dir(problem, GLP_MIN);
    if (!program.variables.empty()) {
        glp_add_cols(problem, static_cast<int>(program.variables.size()));
    }
    for (std::size_t j = 0; j < program.variables.size(); ++j) {
        const IntegerProgram::Variable& v = program.variables[j];
        const int column = static_cast<int>(j) + 1;
        const double lower = v.integer ? std::ceil(v.lower) : v.lower;
        const double upper = v.integer ? std::floor(v.upper) : v.upper;
        glp_set_col_kind(problem, column, v.integer ? GLP_IV : GLP_CV);
        glp_set_col_bnds(problem, column, bound_type(lower, upper), lower, upper);
        glp_set_obj_coef(problem, column, v.cost);
    }
    if (!program.rows.empty()) {
        glp_add_rows(problem, static_cast<int>(program.rows.size()));
    }
    std::vector<int> columns;
    std::vector<double> coefficients;
    for (std::size_t i = 0; i < program.rows.size(); ++i) {
        const IntegerProgram::Row& row = program.rows[i];
        columns.assign(1, 0);
        coefficients.assign(1, 0.0);
        for (const auto& [variable, coefficient] : row.terms) {
            columns.push_back(static_cast<int>(variable) + 1);
            coefficients.push_back(coefficient);
        }
        const int index = static_cast<int>(i) + 1;
        glp_set_row_bnds(problem, index, bound_type(row.lower, row.upper), row.lower, row.upper);
        glp_set_mat_row(problem, index, static_cast<int>(row.terms.size()), columns.data(), coefficients.data());
    }
}

/// Runs the simplex method, then branch and bound. Returns GLPK's status of the integer solution, or GLP_UNDEF;
/// `unbounded_relaxation` tells that the relaxation has no finite optimum.
int run(glp_prob* problem, double seconds, double gap, bool& unbounded_relaxation) {
    const auto milliseconds = static_cast<int>(std::min(seconds * 1000.0, 2e9));
    glp_smcp simplex;
    glp_init_smcp(&simplex);
    simplex.msg_lev = GLP_MSG_OFF;
    simplex.tm_lim = milliseconds;
    if (glp_simplex(problem, &simplex) != 0) {
        return GLP_UNDEF;
    }
    unbounded_relaxation = glp_get_status(problem) == GLP_UNBND;
    if (glp_get_status(problem) == GLP_NOFEAS) {
        return GLP_NOFEAS;
    }
    if (glp_get_status(problem) != GLP_OPT) {
        return GLP_UNDEF;
    }
    glp_iocp integer;
    glp_init_iocp(&integer);
    integer.msg_lev = GLP_MSG_OFF;
    integer.tm_lim = milliseconds;
    integer.mip_gap = gap;
    integer.gmi_cuts = GLP_ON;
    integer.mir_cuts = GLP_ON;
    const int failure = glp_intopt(problem, &integer);
    const int status = glp_mip_status(problem);
    // Stopped early: an incumbent is called feasible; "no solution" would be a proof only after a full search.
    if (failure == GLP_EMIPGAP) {
        return GLP_OPT;
    }
    return failure == 0 || status == GLP_FEAS ? status : GLP_UNDEF;
}

struct Rescue {
    std::jmp_buf point;
};

/// Comes back to guarded_run instead of ending the process.
void leave(void* info) { std::longjmp(static_cast<Rescue*>(info)->point, 1); }

/// `run`, or -1 after an internal error of GLPK (then its environment and all its problems are gone).
int guarded_run(glp_prob* problem, double seconds, double gap, bool& unbounded_relaxation) {
    Rescue rescue;
    if (setjmp(rescue.point) != 0) {
        glp_error_hook(nullptr, nullptr);
        glp_free_env();
        return -1;
    }
    glp_error_hook(leave, &rescue);
    const int status = run(problem, seconds, gap, unbounded_relaxation);
    glp_error_hook(nullptr, nullptr);
    return status;
}

IntegerSolution read(glp_prob* problem, const IntegerProgram& program, int status, bool unbounded_relaxation) {
    IntegerSolution solution;
    switch (status) {
        case GLP_OPT: solution.status = ProgramStatus::optimal; break;
        case GLP_FEAS: solution.status = ProgramStatus::feasible; break;
        case GLP_NOFEAS: solution.status = ProgramStatus::infeasible; break;
        default: solution.status = unbounded_relaxation ? ProgramStatus::unbounded : ProgramStatus::unsolved; break;
    }
    if (solution.found()) {
        for (std::size_t j = 0; j < program.variables.size(); ++j) {
            const double value = glp_mip_col_val(problem, static_cast<int>(j) + 1);
            solution.values.push_back(program.variables[j].integer ? std::round(value) : value);
            solution.objective += program.variables[j].cost * solution.values.back();
        }
    }
    return solution;
}

}  // namespace

IntegerSolution solve(const IntegerProgram& program, const IntegerProgramOptions& options) {
    check(program, options);
    if (contradictory(program)) {
        return {ProgramStatus::infeasible, 0.0, {}};
    }
    const Environment environment;
    const Silence silence;
    Problem problem(glp_create_prob());
    load(problem.get(), program);
    bool unbounded_relaxation = false;
    const int status = guarded_run(problem.get(), options.seconds, options.relative_gap.value_or(program.relative_gap),
                                   unbounded_relaxation);
    if (status == -1) {
        (void)problem.release();  // freed with GLPK's environment
        return {};
    }
    return read(problem.get(), program, status, unbounded_relaxation);
}

}  // namespace pavior
