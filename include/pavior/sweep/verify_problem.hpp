#pragma once
/// \file
/// Checks of a sweep problem: everything that must hold before its inner layers can be computed.

#include <pavior/affine/fit.hpp>
#include <pavior/core/compiled.hpp>
#include <pavior/core/error.hpp>
#include <pavior/mesh/span_mesh.hpp>
#include <pavior/sweep/problem.hpp>

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace pavior {

/// One kind of mistake and its offenders.
struct ProblemFinding {
    ErrorCode code = ErrorCode::empty_input;
    std::string message;  ///< names the offenders
    Error::Ids ids;       ///< nodes, quads, loops or levels, as the message says; at most 16
};

/// Tolerances of verify_problem().
struct VerifyProblemOptions {
    /// A boundary node of a cap and its point of the first or last level may differ by this times the size of the
    /// loops (plus 16 rounding errors of the coordinates).
    double boundary_tolerance = 1e-8;
    /// Ranks, pseudo-areas and correlations of loops.
    FitOptions fit{};
};

namespace detail {

/// Collects findings; ids are capped.
class ProblemChecks {
public:
    ProblemChecks(const SweepProblem& problem, const VerifyProblemOptions& options)
        : problem_(problem), options_(options) {}

    [[nodiscard]] std::vector<ProblemFinding> run();

private:
    void add(ErrorCode code, std::string message, Error::Ids ids = {}) {
        ids.resize(std::min<std::size_t>(ids.size(), 16));
        findings_.push_back({code, std::move(message), std::move(ids)});
    }

    void presence();

    void sizes();

    void finiteness();

    /// Skipped without quads: nodes alone can be swept.
    void quads();

    void loops();

    void boundaries() {
        cap_boundary(problem_.source_nodes, 0, "source");
        cap_boundary(problem_.target_nodes, problem_.layers, "target");
    }

    void cap_boundary(const std::vector<Vec3>& cap, std::size_t k, const std::string& name);

    /// Every loop by itself: it must span a plane and enclose an area.
    void levels();

    void consecutive();

    [[nodiscard]] QuadMeshView<> mesh() const { return {problem_.source_nodes, problem_.quads}; }
    [[nodiscard]] Eigen::Map<const Eigen::Matrix<double, 3, Eigen::Dynamic>> points(std::size_t k) const {
        return {problem_.level(k).data()->data(), 3, static_cast<Eigen::Index>(problem_.loops.nodes.size())};
    }
    [[nodiscard]] static std::string list(const Error::Ids& ids);

    const SweepProblem& problem_;
    VerifyProblemOptions options_;
    std::vector<ProblemFinding> findings_;
    std::vector<Vec3> normals_;
};

}  // namespace detail

/// Checks \p problem in stages and returns the findings of the first stage that has any; empty: it can be swept.
/// 1. empty_input: no nodes, loops or layers; 2. size_mismatch between the arrays; 3. not_finite, overflow (beyond
/// 1e300); 4. the quads: bad_index, bad_orientation, non_manifold, unused_node (as verify_quads; without quads there is
/// nothing to check); 5. the loops: bad_index, loops_do_not_match_mesh (a loop too many or too few, a node missing or
/// twice, some loops reversed, a closed sheet of quads; all loops reversed is no fault); 6. inconsistent_boundary;
/// 7. for each level source_degenerate (level 0), target_degenerate (others), null_pseudo_area; 8. orientation_reversed
/// between neighbouring levels. Pairs of loops without correlation (unrelated_loops) show when the maps are fitted.
/// O(n + quads + m r), with sorts; read-only, thread-safe.
[[nodiscard]] inline std::vector<ProblemFinding> verify_problem(const SweepProblem& problem,
                                                                const VerifyProblemOptions& options = {}) {
    return detail::ProblemChecks(problem, options).run();
}

/// Throws InputError with the first finding of verify_problem(), if there is one.
PAVIOR_INLINE void require_valid(const SweepProblem& problem, const VerifyProblemOptions& options = {});

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/sweep/verify_problem-inl.hpp>
#endif
