#pragma once
/// \file
/// Checks of a sweep problem: everything that must hold before its inner layers can be computed.

#include <pavior/affine/fit.hpp>
#include <pavior/affine/pseudo_area.hpp>
#include <pavior/core/error.hpp>
#include <pavior/mesh/boundary_loops.hpp>
#include <pavior/mesh/span_mesh.hpp>
#include <pavior/mesh/verify_quads.hpp>
#include <pavior/sweep/detail/verify_loops.hpp>
#include <pavior/sweep/problem.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
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

    [[nodiscard]] std::vector<ProblemFinding> run() {
        // A failed stage makes the next ones meaningless.
        const auto stages = {&ProblemChecks::presence, &ProblemChecks::sizes,      &ProblemChecks::finiteness,
                             &ProblemChecks::quads,    &ProblemChecks::loops,      &ProblemChecks::boundaries,
                             &ProblemChecks::levels,   &ProblemChecks::consecutive};
        for (const auto stage : stages) {
            (this->*stage)();
            if (!findings_.empty()) {
                break;
            }
        }
        return std::move(findings_);
    }

private:
    void add(ErrorCode code, std::string message, Error::Ids ids = {}) {
        ids.resize(std::min<std::size_t>(ids.size(), 16));
        findings_.push_back({code, std::move(message), std::move(ids)});
    }

    void presence() {
        if (problem_.source_nodes.empty()) {
            add(ErrorCode::empty_input, "no source nodes");
        } else if (problem_.loops.nodes.empty()) {
            add(ErrorCode::empty_input, "no boundary loops");
        } else if (problem_.layers == 0) {
            add(ErrorCode::empty_input, "no layers: at least two boundary levels are needed");
        }
    }

    void sizes() {
        const std::size_t n = problem_.source_nodes.size();
        const std::size_t m = problem_.loops.nodes.size();
        if (problem_.target_nodes.size() != n) {
            add(ErrorCode::size_mismatch, std::to_string(n) + " source nodes, but " +
                                              std::to_string(problem_.target_nodes.size()) + " target nodes");
        }
        if (problem_.boundary_levels.size() != (problem_.layers + 1) * m) {
            add(ErrorCode::size_mismatch, std::to_string(problem_.boundary_levels.size()) + " boundary points, but " +
                                              std::to_string(problem_.layers + 1) + " levels of " + std::to_string(m) +
                                              " loop nodes");
        }
        const auto& offsets = problem_.loops.offsets;
        if (offsets.size() < 2 || offsets.front() != 0 || offsets.back() != m ||
            !std::is_sorted(offsets.begin(), offsets.end())) {
            add(ErrorCode::size_mismatch, "loop offsets do not run from 0 to the number of loop nodes");
        }
    }

    void finiteness() {
        const auto not_finite = [&](const std::vector<Vec3>& points, const std::string& what, std::size_t divisor) {
            Error::Ids ids;
            for (std::size_t i = 0; i < points.size(); ++i) {
                const auto id = static_cast<std::int64_t>(i / divisor);
                if (!points[i].allFinite() && (ids.empty() || ids.back() != id)) {
                    ids.push_back(id);
                }
            }
            if (!ids.empty()) {
                add(ErrorCode::not_finite, what + list(ids), ids);
            }
            return ids.empty();
        };
        const bool finite =
            not_finite(problem_.source_nodes, "source nodes with NaN or infinite coordinates:", 1) &&
            not_finite(problem_.target_nodes, "target nodes with NaN or infinite coordinates:", 1) &&
            not_finite(problem_.boundary_levels,
                       "boundary levels with NaN or infinite coordinates:", problem_.loops.nodes.size());
        const auto huge = [](const Vec3& x) { return x.cwiseAbs().maxCoeff() > 1e300; };
        if (finite && (std::any_of(problem_.source_nodes.begin(), problem_.source_nodes.end(), huge) ||
                       std::any_of(problem_.target_nodes.begin(), problem_.target_nodes.end(), huge) ||
                       std::any_of(problem_.boundary_levels.begin(), problem_.boundary_levels.end(), huge))) {
            add(ErrorCode::overflow, "coordinates beyond 1e300");
        }
    }

    /// Skipped without quads: nodes alone can be swept.
    void quads() {
        if (problem_.quads.empty()) {
            return;
        }
        const QuadReport report = verify_quads(mesh());
        for (const Finding& finding : report.findings()) {
            add(error_code(finding.fault), "source mesh: " + report.text(), finding.ids);
        }
    }

    void loops() {
        Error::Ids outside;
        for (const Index i : problem_.loops.nodes) {
            if (i >= problem_.source_nodes.size()) {
                outside.push_back(i);
            }
        }
        if (!outside.empty()) {
            add(ErrorCode::bad_index, "the loops name nodes that do not exist:" + list(outside), outside);
            return;
        }
        const LoopMatch match = problem_.quads.empty()
                                    ? match_loops_alone(problem_.loops)
                                    : match_loops(problem_.loops, boundary_loops(mesh()), problem_.source_nodes.size());
        if (!match.message.empty()) {
            add(ErrorCode::loops_do_not_match_mesh, match.message, match.ids);
        } else if (const auto lost =
                       unreached_node(problem_.source_nodes.size(), problem_.quads, problem_.loops.nodes)) {
            add(ErrorCode::loops_do_not_match_mesh,
                "the sheet of quads with node " + std::to_string(*lost) + " has no boundary", {*lost});
        }
    }

    void boundaries() {
        cap_boundary(problem_.source_nodes, 0, "source");
        cap_boundary(problem_.target_nodes, problem_.layers, "target");
    }

    void cap_boundary(const std::vector<Vec3>& cap, std::size_t k, const std::string& name) {
        const auto local = centring(points(k));
        const double rounding = 16 * std::numeric_limits<double>::epsilon() * local.extent;
        const double tolerance = options_.boundary_tolerance * local.scale + rounding;
        Error::Ids ids;
        for (std::size_t i = 0; i < problem_.loops.nodes.size(); ++i) {
            const Index at = problem_.loops.nodes[i];
            if (!((cap[at] - problem_.level(k)[i]).cwiseAbs().maxCoeff() <= tolerance)) {
                ids.push_back(at);
            }
        }
        if (!ids.empty()) {
            add(ErrorCode::inconsistent_boundary,
                std::to_string(ids.size()) + " boundary nodes of the " + name + " are not where level " +
                    std::to_string(k) + " puts them:" + list(ids),
                ids);
        }
    }

    /// Every loop by itself: it must span a plane and enclose an area.
    void levels() {
        for (std::size_t k = 0; k <= problem_.layers; ++k) {
            const auto fit =
                fit_affine(AffineMethod::constrained, points(k), points(k), problem_.loops.offsets, options_.fit);
            const std::string level = "level " + std::to_string(k);
            const Error::Ids ids{static_cast<std::int64_t>(k)};
            if (fit.status == FitStatus::source_degenerate || fit.status == FitStatus::target_degenerate) {
                add(k == 0 ? ErrorCode::source_degenerate : ErrorCode::target_degenerate,
                    "the loops of " + level + " lie on a line or in a point", ids);
            } else if (fit.status != FitStatus::ok) {
                add(to_error_code(fit.status),
                    fit.status == FitStatus::null_pseudo_area
                        ? "the loops of " + level + " enclose no area, they have no normal"
                        : level + ": " + std::string(to_string(fit.status)),
                    ids);
            } else {
                normals_.push_back(fit.uX);
            }
        }
    }

    void consecutive() {
        for (std::size_t k = 1; k <= problem_.layers; ++k) {
            if (normals_[k].dot(normals_[k - 1]) < 0) {
                add(ErrorCode::orientation_reversed,
                    "the normals of levels " + std::to_string(k - 1) + " and " + std::to_string(k) +
                        " are more than 90 degrees apart",
                    {static_cast<std::int64_t>(k - 1), static_cast<std::int64_t>(k)});
            }
        }
    }

    [[nodiscard]] QuadMeshView<> mesh() const { return {problem_.source_nodes, problem_.quads}; }
    [[nodiscard]] Eigen::Map<const Eigen::Matrix<double, 3, Eigen::Dynamic>> points(std::size_t k) const {
        return {problem_.level(k).data()->data(), 3, static_cast<Eigen::Index>(problem_.loops.nodes.size())};
    }
    [[nodiscard]] static std::string list(const Error::Ids& ids) {
        std::string text;
        for (std::size_t i = 0; i < std::min<std::size_t>(ids.size(), 16); ++i) {
            text += " " + std::to_string(ids[i]);
        }
        return text + (ids.size() > 16 ? " ..." : "");
    }

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
inline void require_valid(const SweepProblem& problem, const VerifyProblemOptions& options = {}) {
    const std::vector<ProblemFinding> findings = verify_problem(problem, options);
    if (!findings.empty()) {
        throw InputError(findings.front().code, findings.front().message, findings.front().ids);
    }
}

}  // namespace pavior
