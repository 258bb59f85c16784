#pragma once

#include <pavior/core/stopwatch.hpp>
#include <pavior/mesh/verify_quads.hpp>
#include <pavior/sweep/detail/verify_loops.hpp>
#include <pavior/sweep/sweep.hpp>

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace pavior {

namespace detail {

/// Notices about the problem itself.
inline void report_problem(const SweepProblem& problem, SweepReport& report) {
    report.layers = problem.layers;
    report.nodes = (problem.layers + 1) * problem.level_size();
    report.hexahedra = problem.layers * problem.quads.size();
    report.loops = problem.loops.size();
    report.loop_nodes = problem.loops.nodes.size();
    if (problem.quads.empty()) {
        return;
    }
    const QuadMeshView<> mesh{problem.source_nodes, problem.quads};
    const bool reversed = match_loops(problem.loops, boundary_loops(mesh), problem.level_size()).reversed;
    if (reversed) {
        report.warnings.push_back({SweepNotice::loops_reversed, {}});
    }
    if (const QuadReport sheets = verify_quads(mesh, {.max_components = 1}); sheets.components > 1) {
        report.warnings.push_back({SweepNotice::many_sheets, sheets.find(MeshFault::disconnected)->ids});
    }
    const auto first = centring(loop_points(problem, 0));
    const auto second = centring(loop_points(problem, 1));
    const auto normal = pseudo_normal(loop_points(problem, 0), problem.loops.offsets).normal;
    const Vec3 step = second.centre / first.scale - first.centre / first.scale;
    if (step.dot(normal) * (reversed ? -1.0 : 1.0) < -1e-12) {
        report.warnings.push_back({SweepNotice::against_front, {}});
    }
}

inline void report_maps(std::span<const LevelMap> maps, SweepReport& report) {
    Error::Ids ambiguous;
    for (std::size_t i = 0; i < maps.size(); ++i) {
        report.residuals.push_back({maps[i].residual_max, maps[i].residual_rms});
        if (maps[i].ambiguous_normal) {
            ambiguous.push_back(static_cast<std::int64_t>(i + 1));
        }
    }
    if (!ambiguous.empty()) {
        report.warnings.push_back({SweepNotice::ambiguous_normal, ambiguous});
    }
}

}  // namespace detail

PAVIOR_INLINE PreparedSweep prepare_sweep(SweepProblem problem, const SweepOptions& options) {
    SweepReport report;
    Stopwatch watch;
    pavior::report(options.progress, "verify", 0);
    require_valid(problem, options.verify);
    detail::report_problem(problem, report);
    report.verify_seconds = watch.lap();
    pavior::report(options.progress, "fit", 0);
    std::vector<LevelMap> maps = make_level_maps(
        problem, {options.method, options.strategy, options.blending, options.verify.fit, options.execution});
    detail::report_maps(maps, report);
    report.fit_seconds = watch.lap();
    pavior::report(options.progress, "prepare", 0);
    InnerLayers layers(std::move(problem), std::move(maps), options.correction);
    report.prepare_seconds = watch.lap();
    return {std::move(layers), std::move(report)};
}

PAVIOR_INLINE SweepResult sweep(SweepProblem problem, const SweepOptions& options) {
    SweepNumbering{problem.level_size(), problem.layers}.check(problem.quads.size());
    PreparedSweep prepared = prepare_sweep(std::move(problem), options);
    const SweepProblem& swept = prepared.layers.problem();
    Stopwatch watch;
    const std::size_t count = swept.level_size() * (swept.layers + 1);
    std::vector<Vec3> nodes = large_array<Vec3>(count);
    nodes.resize(count);
    prepared.layers.all_levels(nodes, options.execution, options.progress);
    prepared.report.nodes_seconds = watch.lap();
    return {SweepMesh(std::move(nodes), swept.quads, swept.layers), std::move(prepared.report)};
}

}  // namespace pavior
