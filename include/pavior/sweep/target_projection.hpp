#pragma once
/// \file
/// The mesh of the target cap: the source mesh mapped by an affine map between the loops, on the target surface.

#include <pavior/core/compiled.hpp>
#include <pavior/math/affine_map.hpp>
#include <pavior/math/parametric_surface.hpp>
#include <pavior/mesh/cells.hpp>
#include <pavior/smooth/surface_quads.hpp>
#include <pavior/sweep/detail/cap_data.hpp>
#include <pavior/sweep/folded_quads.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace pavior {

/// When the inner nodes follow what the affine map leaves over at the boundary: plus sum_i w_i residual_i with weights
/// ~ 1 / (squared distance on the source cap), so that the map interpolates the loops.
enum class TargetCorrection : std::uint8_t {
    never,
    when_folded,  ///< if the map itself folds quads, and no more of them fold with the correction
    always,
};

struct TargetOptions {
    TargetCorrection correction = TargetCorrection::when_folded;
    /// Untangle quads that are still folded. With correction never and untangle false the result is the plain map.
    bool untangle = true;
    /// If the affine map folds quads, also smooth what the correction and the untangling have made of it: all inner
    /// nodes, the smallest determinant never gets worse. Nothing happens where the map alone folds nothing.
    bool smooth_repaired = false;
    /// How to untangle; `reversed` is set by the function.
    UntangleOptions untangling;
};

/// The source cap as arrays. Nodes are numbered alike on both caps.
struct SourceCap {
    std::span<const Vec3> nodes;         ///< positions in space
    std::span<const Vec2> uv;            ///< their parameters, continuous across a seam; or plane_coordinates()
    std::span<const QuadCorners> quads;  ///< one orientation for all; may be empty: then no quad can be seen to fold
    const Loops& loops;                  ///< the boundary of the quads
};

/// The target mesh and its report.
struct TargetMesh {
    std::vector<Vec3> nodes;           ///< in the order of the source nodes
    std::vector<Vec2> uv;              ///< parameters on the target surface
    AffineMap<double, 2> map;          ///< F of the loops in the parameter planes, eq. (4.5) \cite roca2009
    double residual = 0.0;             ///< max |u_T - map(u_S)| over the loop nodes, unit of the parameters
    bool reversed = false;             ///< quads run clockwise in the target's parameter plane
    bool corrected = false;            ///< the boundary correction is in
    std::vector<Index> folded_by_map;  ///< quads that the affine map alone folds, ascending
    SmoothReport smooth;               ///< of the untangling; iterations 0 if there was none to do
    std::vector<Index> folded;         ///< quads still folded, ascending
};

/// Coordinates of a cap in a plane, for a source without a surface: along two orthonormal axes perpendicular to the
/// vector area of the quads, about the mean of the nodes; quads of a nearly flat cap run counter-clockwise.
/// InputError (null_pseudo_area) if the quads enclose no area. O(n).
[[nodiscard]] PAVIOR_INLINE std::vector<Vec2> plane_coordinates(std::span<const Vec3> nodes,
                                                                std::span<const QuadCorners> quads);

namespace detail {

/// The stages of project_target(); one object lives as long as one call.
template <parametric_surface S>
class TargetProjector {
public:
    TargetProjector(const S& surface, const SourceCap& source, std::span<const Vec2> loop_uv,
                    std::span<const Vec3> loop_nodes)
        : surface_(surface),
          source_(source),
          loop_uv_(loop_uv),
          loop_nodes_(loop_nodes),
          boundary_(mark_boundary(source.nodes.size(), source.quads, source.loops)) {
        require_size(source.uv.size(), source.nodes.size(), "source parameters");
        require_size(loop_uv.size(), source.loops.nodes.size(), "target parameters of the loop nodes");
        require_size(loop_nodes.size(), source.loops.nodes.size(), "target positions of the loop nodes");
        require_finite(source.nodes, "a source node");
        require_finite(source.uv, "a source parameter");
        require_finite(loop_uv, "a target parameter");
        require_finite(loop_nodes, "a target node");
    }

    [[nodiscard]] TargetMesh run(const TargetOptions& options) {
        TargetMesh target = map_by_least_squares();
        target.folded_by_map = folded(target);
        target.folded = target.folded_by_map;
        const bool repair = options.correction == TargetCorrection::when_folded && !target.folded.empty();
        if (options.correction == TargetCorrection::always || repair) {
            correct(target, options.correction == TargetCorrection::always);
        }
        const bool smooth = options.smooth_repaired && !target.folded_by_map.empty();
        if (options.untangle && (smooth || !target.folded.empty())) {
            untangle(target, options.untangling, smooth);
        }
        return target;
    }

private:
    [[nodiscard]] TargetMesh map_by_least_squares() const {
        const std::vector<Vec2> source_loop = pick(source_.uv, source_.loops.nodes);
        const auto fit = fit_affine(AffineMethod::f, columns(std::span<const Vec2>(source_loop)), columns(loop_uv_),
                                    source_.loops.offsets);
        TargetMesh target;
        target.map = fit.map;
        target.residual = fit.residual;
        target.reversed = is_reversed(source_loop);
        target.uv.resize(source_.nodes.size());
        target.nodes.resize(source_.nodes.size());
        for (std::size_t j = 0; j < target.uv.size(); ++j) {
            target.uv[j] = fit.map(source_.uv[j]);
        }
        for (std::size_t i = 0; i < loop_uv_.size(); ++i) {
            target.uv[source_.loops.nodes[i]] = loop_uv_[i];
            target.nodes[source_.loops.nodes[i]] = loop_nodes_[i];
        }
        evaluate(target);
        return target;
    }

    /// Quads run clockwise in the target's plane if the target's loops do and the source's loops run with its quads, or
    /// neither.
    [[nodiscard]] bool is_reversed(std::span<const Vec2> source_loop) const {
        const bool target_clockwise = loops_area(loop_uv_, source_.loops.offsets) < 0.0;
        const double with_quads =
            loops_area(source_loop, source_.loops.offsets) * quads_area(source_.uv, source_.quads);
        return target_clockwise != (with_quads < 0.0);
    }

    void evaluate(TargetMesh& target) const {
        for (std::size_t j = 0; j < target.uv.size(); ++j) {
            if (boundary_[j] == 0) {
                target.nodes[j] = surface_.point(target.uv[j]);
            }
        }
    }

    [[nodiscard]] std::vector<Index> folded(const TargetMesh& target) const {
        return folded_surface_quads(surface_, std::span<const Vec3>(target.nodes), std::span<const Vec2>(target.uv),
                                    source_.quads, target.reversed);
    }

    void correct(TargetMesh& target, bool whatever_folds) const {
        std::vector<Vec2> residuals(loop_uv_.size());
        for (std::size_t i = 0; i < residuals.size(); ++i) {
            residuals[i] = loop_uv_[i] - target.map(source_.uv[source_.loops.nodes[i]]);
        }
        TargetMesh other = target;
        add_residuals(source_.nodes, std::span<const std::uint8_t>(boundary_),
                      std::span<const Index>(source_.loops.nodes), std::span<const Vec2>(residuals),
                      std::span<Vec2>(other.uv));
        evaluate(other);
        other.folded = folded(other);
        other.corrected = true;
        if (whatever_folds || other.folded.size() <= target.folded.size()) {
            target = std::move(other);
        }
    }

    void untangle(TargetMesh& target, UntangleOptions options, bool smooth) const {
        options.reversed = target.reversed;
        options.always = options.always || smooth;
        TargetMesh other = target;
        other.smooth = untangle_surface_quads(surface_, std::span<Vec2>(other.uv), source_.quads,
                                              std::span<const std::uint8_t>(boundary_), options, source_.nodes);
        evaluate(other);
        other.folded = folded(other);
        const bool better = other.smooth.min_det_after > other.smooth.min_det_before;
        if (other.folded.size() < target.folded.size() || (other.folded.size() == target.folded.size() && better)) {
            target = std::move(other);
        } else {
            target.smooth = std::move(other.smooth);
        }
    }

    const S& surface_;
    const SourceCap& source_;
    std::span<const Vec2> loop_uv_;
    std::span<const Vec3> loop_nodes_;
    std::vector<std::uint8_t> boundary_;
};

}  // namespace detail

/// Maps the source mesh to the target surface, section 4.2.2 \cite roca2009: the inner nodes go through the affine map
/// F
/// fitted to the loops in the two parameter planes (4.5), then through the target's parametrisation (4.6); nodes and
/// parameters of the loops are the given ones, bit by bit. F interpolates the loops only if they are affine to each
/// other. Where quads fold (folded_quads.hpp), the boundary residual is spread over the inner nodes and what is left is
/// untangled on the surface, the boundary fixed and the source quads as the wanted shapes; see TargetOptions. A node
/// outside the target cannot be there without a folded quad. The target's own normal may point either way.
/// \param target     the target surface (\ref parametric_surface)
/// \param loop_uv    target parameters of the nodes source.loops.nodes, in that order, continuous across a seam
///                   (unwrap.hpp)
/// \param loop_nodes their positions in space
/// InputError: size_mismatch, bad_index, not_finite, empty_input. Quads that stay folded are reported. O(n), with the
/// correction O(inner x loop nodes). As thread-safe as the surface.
template <parametric_surface S>
[[nodiscard]] TargetMesh project_target(const S& target, const SourceCap& source, std::span<const Vec2> loop_uv,
                                        std::span<const Vec3> loop_nodes, const TargetOptions& options = {}) {
    return detail::TargetProjector<S>(target, source, loop_uv, loop_nodes).run(options);
}

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/sweep/target_projection-inl.hpp>
#endif
