#pragma once

#include <pavior/affine/pseudo_area.hpp>
#include <pavior/mesh/boundary_loops.hpp>
#include <pavior/mesh/verify_quads.hpp>
#include <pavior/sweep/detail/verify_loops.hpp>
#include <pavior/sweep/verify_problem.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace pavior {

namespace detail {

PAVIOR_INLINE std::vector<ProblemFinding> ProblemChecks::run() {
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

PAVIOR_INLINE void ProblemChecks::presence() {
    if (problem_.source_nodes.empty()) {
        add(ErrorCode::empty_input, "no source nodes");
    } else if (problem_.loops.nodes.empty()) {
        add(ErrorCode::empty_input, "no boundary loops");
    } else if (problem_.layers == 0) {
        add(ErrorCode::empty_input, "no layers: at least two boundary levels are needed");
    }
}

PAVIOR_INLINE void ProblemChecks::sizes() {
    const std::size_t n = problem_.source_nodes.size();
    const std::size_t m = problem_.loops.nodes.size();
    if (problem_.target_nodes.size() != n) {
        add(ErrorCode::size_mismatch,
            std::to_string(n) + " source nodes, but " + std::to_string(problem_.target_nodes.size()) + " target nodes");
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

PAVIOR_INLINE void ProblemChecks::finiteness() {
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
    const bool finite = not_finite(problem_.source_nodes, "source nodes with NaN or infinite coordinates:", 1) &&
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

PAVIOR_INLINE void ProblemChecks::quads() {
    if (problem_.quads.empty()) {
        return;
    }
    const QuadReport report = verify_quads(mesh());
    for (const Finding& finding : report.findings()) {
        add(error_code(finding.fault), "source mesh: " + report.text(), finding.ids);
    }
}

PAVIOR_INLINE void ProblemChecks::loops() {
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
    } else if (const auto lost = unreached_node(problem_.source_nodes.size(), problem_.quads, problem_.loops.nodes)) {
        add(ErrorCode::loops_do_not_match_mesh,
            "the sheet of quads with node " + std::to_string(*lost) + " has no boundary", {*lost});
    }
}

PAVIOR_INLINE void ProblemChecks::cap_boundary(const std::vector<Vec3>& cap, std::size_t k, const std::string& name) {
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

PAVIOR_INLINE void ProblemChecks::levels() {
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

PAVIOR_INLINE void ProblemChecks::consecutive() {
    for (std::size_t k = 1; k <= problem_.layers; ++k) {
        if (normals_[k].dot(normals_[k - 1]) < 0) {
            add(ErrorCode::orientation_reversed,
                "the normals of levels " + std::to_string(k - 1) + " and " + std::to_string(k) +
                    " are more than 90 degrees apart",
                {static_cast<std::int64_t>(k - 1), static_cast<std::int64_t>(k)});
        }
    }
}

PAVIOR_INLINE std::string ProblemChecks::list(const Error::Ids& ids) {
    std::string text;
    for (std::size_t i = 0; i < std::min<std::size_t>(ids.size(), 16); ++i) {
        text += " " + std::to_string(ids[i]);
    }
    return text + (ids.size() > 16 ? " ..." : "");
}

}  // namespace detail

PAVIOR_INLINE void require_valid(const SweepProblem& problem, const VerifyProblemOptions& options) {
    const std::vector<ProblemFinding> findings = verify_problem(problem, options);
    if (!findings.empty()) {
        throw InputError(findings.front().code, findings.front().message, findings.front().ids);
    }
}

}  // namespace pavior
