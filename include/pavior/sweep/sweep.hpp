#pragma once
/// \file
/// One-to-one sweeping: inner nodes and hexahedra between two caps; Section 4.3 \cite roca2009.

#include <pavior/affine/method.hpp>
#include <pavior/core/compiled.hpp>
#include <pavior/core/execution.hpp>
#include <pavior/core/large_array.hpp>
#include <pavior/core/progress.hpp>
#include <pavior/mesh/builders.hpp>
#include <pavior/sweep/boundary_error.hpp>
#include <pavior/sweep/inner_layers.hpp>
#include <pavior/sweep/level_map.hpp>
#include <pavior/sweep/problem.hpp>
#include <pavior/sweep/report.hpp>
#include <pavior/sweep/sweep_mesh.hpp>
#include <pavior/sweep/verify_problem.hpp>

#include <cstddef>
#include <span>
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

/// Verifies \p problem, fits the maps of all levels and makes the correction operators; computes no node. From here
/// nodes can be had level by level (InnerLayers::level), streamed (InnerLayers::for_each_level) or all at once.
/// \throws InputError as verify_problem() and make_level_maps(): the first finding, with its ids
/// O(n + quads + m r) time and memory, plus the factorisation if `harmonic`.
[[nodiscard]] PAVIOR_INLINE PreparedSweep prepare_sweep(SweepProblem problem, const SweepOptions& options = {});

/// Sweeps: verifies \p problem, computes the inner nodes of all levels and returns the mesh with its report. Nodes of
/// both caps and of the loops are those of \p problem, bit for bit; r = 1 leaves nothing to compute. The bits of the
/// result do not depend on options.execution.
/// \throws InputError as prepare_sweep(); overflow if 32 bits cannot number nodes and hexahedra
/// Cost as prepare_sweep() plus O(n r), with inverse-distance correction O(n m r) unless the loops are affine images.
[[nodiscard]] PAVIOR_INLINE SweepResult sweep(SweepProblem problem, const SweepOptions& options = {});

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

#ifndef PAVIOR_COMPILED
#include <pavior/sweep/sweep-inl.hpp>
#endif
