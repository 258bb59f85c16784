#pragma once
/// \file
/// One-to-one sweeping: inner nodes and hexahedra between two caps; Section 4.3 \cite roca2009.

#include <pavior/affine/method.hpp>
#include <pavior/core/execution.hpp>
#include <pavior/core/large_array.hpp>
#include <pavior/core/progress.hpp>
#include <pavior/core/stopwatch.hpp>
#include <pavior/mesh/builders.hpp>
#include <pavior/mesh/verify_quads.hpp>
#include <pavior/sweep/boundary_error.hpp>
#include <pavior/sweep/inner_layers.hpp>
#include <pavior/sweep/level_map.hpp>
#include <pavior/sweep/problem.hpp>
#include <pavior/sweep/report.hpp>
#include <pavior/sweep/sweep_mesh.hpp>
#include <pavior/sweep/verify_problem.hpp>

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace pavior {

/// Options of a sweep.
struct SweepOptions {
    AffineMethod method = AffineMethod::constrained;
    SweepStrategy strategy = SweepStrategy::direct;
    BoundaryCorrection correction = BoundaryCorrection::idw;
    /// t_0 .. t_r, weights of the target side at each level, from 0 to 1, not decreasing. Empty: k / r. Give relative
    /// positions along the path for layers of uneven thickness.
    std::vector<double> blending{};
    Execution execution{};  ///< the result does not depend on it
    Progress progress{};    ///< stages "verify", "fit", "prepare", "nodes"
    VerifyProblemOptions verify{};
};

/// Nodes and hexahedra with their report.
struct SweepResult {
    SweepMesh mesh;
    SweepReport report;
};

/// A sweep that is ready to give its nodes in any way.
struct PreparedSweep {
    InnerLayers layers;
    SweepReport report;  ///< complete but for nodes_seconds
};

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

/// Verifies \p problem, fits the maps of all levels and makes the correction operators; computes no node. From here
/// nodes can be had level by level (InnerLayers::level), streamed (InnerLayers::for_each_level) or all at once.
/// \throws InputError as verify_problem() and make_level_maps(): the first finding, with its ids
/// O(n + quads + m r) time and memory, plus the factorisation if `harmonic`.
[[nodiscard]] inline PreparedSweep prepare_sweep(SweepProblem problem, const SweepOptions& options = {}) {
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

/// Sweeps: verifies \p problem, computes the inner nodes of all levels and returns the mesh with its report. Nodes of
/// both caps and of the loops are those of \p problem, bit for bit; r = 1 leaves nothing to compute. The bits of the
/// result do not depend on options.execution.
/// \throws InputError as prepare_sweep(); overflow if 32 bits cannot number nodes and hexahedra
/// Cost as prepare_sweep() plus O(n r), with inverse-distance correction O(n m r) unless the loops are affine images.
[[nodiscard]] inline SweepResult sweep(SweepProblem problem, const SweepOptions& options = {}) {
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

/// Streams the mesh into \p builder: nodes level by level, then hexahedra layer by layer, numbered as SweepMesh. Memory
/// for at most 16 levels. \throws InputError overflow if 32 bits cannot number nodes and hexahedra
template <hex_builder B>
void write(const InnerLayers& layers, B& builder, Execution execution = {}, const Progress& progress = {}) {
    const SweepProblem& problem = layers.problem();
    const SweepNumbering numbering{problem.level_size(), problem.layers};
    numbering.check(problem.quads.size());
    reserve(builder, layers.level_size() * layers.level_count(), problem.layers * problem.quads.size());
    const auto add_nodes = [&](std::size_t, std::span<const Vec3> nodes) {
        for (const Vec3& x : nodes) {
            builder.add_node(x);
        }
    };
    layers.for_each_level(add_nodes, execution, progress);
    for (std::size_t k = 0; k < problem.layers; ++k) {
        for (const QuadCorners& quad : problem.quads) {
            builder.add_hex(numbering.hex(k, quad));
        }
    }
}

/// Sweeps any source mesh, target nodes and levels; see make_sweep_problem().
template <quad_mesh Source, vertex_mesh Target, level_points Levels>
[[nodiscard]] SweepResult sweep(const Source& source, const Target& target, const Loops& loops, const Levels& levels,
                                const SweepOptions& options = {}) {
    return sweep(make_sweep_problem(source, target, loops, levels), options);
}

}  // namespace pavior
