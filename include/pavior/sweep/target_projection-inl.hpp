#pragma once

#include <pavior/affine/fit.hpp>
#include <pavior/core/error.hpp>
#include <pavior/math/quadrilateral.hpp>
#include <pavior/smooth/surface_quads.hpp>
#include <pavior/sweep/detail/cap_data.hpp>
#include <pavior/sweep/folded_quads.hpp>
#include <pavior/sweep/target_projection.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace pavior {

PAVIOR_INLINE std::vector<Vec2> plane_coordinates(std::span<const Vec3> nodes, std::span<const QuadCorners> quads) {
    Vec3 centre = Vec3::Zero();
    for (const Vec3& x : nodes) {
        centre += x / static_cast<double>(nodes.size());
    }
    Vec3 area = Vec3::Zero();
    double total = 0.0;
    for (const QuadCorners& q : quads) {
        const Vec3 a = quad_vector_area(detail::gather(nodes, q));
        area += a;
        total += a.norm();
    }
    if (!(area.norm() > 1e-10 * total)) {
        throw InputError(ErrorCode::null_pseudo_area, "the quads of the cap enclose no area: it has no normal");
    }
    const Vec3 normal = area.normalized();
    const Vec3 e1 = normal.unitOrthogonal();
    const Vec3 e2 = normal.cross(e1);
    std::vector<Vec2> uv;
    uv.reserve(nodes.size());
    for (const Vec3& x : nodes) {
        uv.emplace_back((x - centre).dot(e1), (x - centre).dot(e2));
    }
    return uv;
}

namespace detail {

/// The stages of project_target(); one object lives as long as one call.
class TargetProjector {
public:
    TargetProjector(const AnySurface& surface, const SourceCap& source, std::span<const Vec2> loop_uv,
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
        if (options.by != BoundaryCorrection::none && (options.correction == TargetCorrection::always || repair)) {
            correct(target, options);
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

    void correct(TargetMesh& target, const TargetOptions& options) const {
        std::vector<Vec2> residuals(loop_uv_.size());
        for (std::size_t i = 0; i < residuals.size(); ++i) {
            residuals[i] = loop_uv_[i] - target.map(source_.uv[source_.loops.nodes[i]]);
        }
        TargetMesh other = target;
        spread_residuals(options.by, source_.nodes, source_.quads, std::span<const std::uint8_t>(boundary_),
                         std::span<const Index>(source_.loops.nodes), std::span<const Vec2>(residuals),
                         std::span<Vec2>(other.uv));
        evaluate(other);
        other.folded = folded(other);
        other.corrected = true;
        if (options.correction == TargetCorrection::always || other.folded.size() <= target.folded.size()) {
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

    const AnySurface& surface_;
    const SourceCap& source_;
    std::span<const Vec2> loop_uv_;
    std::span<const Vec3> loop_nodes_;
    std::vector<std::uint8_t> boundary_;
};

}  // namespace detail

PAVIOR_INLINE TargetMesh project_target(const AnySurface& target, const SourceCap& source,
                                        std::span<const Vec2> loop_uv, std::span<const Vec3> loop_nodes,
                                        const TargetOptions& options) {
    return detail::TargetProjector(target, source, loop_uv, loop_nodes).run(options);
}

}  // namespace pavior
