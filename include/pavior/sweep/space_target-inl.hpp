#pragma once

#include <pavior/affine/fit.hpp>
#include <pavior/core/error.hpp>
#include <pavior/math/quadrilateral.hpp>
#include <pavior/smooth/quads.hpp>
#include <pavior/sweep/detail/cap_data.hpp>
#include <pavior/sweep/folded_quads.hpp>
#include <pavior/sweep/space_target.hpp>

#include <Eigen/Geometry>

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace pavior {

namespace detail {

/// The stages of project_target_in_space(); place moves a point to the surface, if there is one.
class SpaceProjector {
public:
    SpaceProjector(const SourceCap& source, std::span<const Vec3> loop_nodes,
                   const std::function<Vec3(const Vec3&)>& place)
        : source_(source),
          loop_nodes_(loop_nodes),
          place_(place),
          boundary_(mark_boundary(source.nodes.size(), source.quads, source.loops)) {
        require_size(loop_nodes.size(), source.loops.nodes.size(), "target positions of the loop nodes");
        require_finite(source.nodes, "a source node");
        require_finite(loop_nodes, "a target node");
    }

    [[nodiscard]] SpaceTargetMesh run(const TargetOptions& options) {
        SpaceTargetMesh target = map_constrained();
        target.folded_by_map = folded(target);
        target.folded = target.folded_by_map;
        const bool repair = options.correction == TargetCorrection::when_folded && !target.folded.empty();
        if (options.by != BoundaryCorrection::none && (options.correction == TargetCorrection::always || repair)) {
            correct(target, options);
        }
        if (options.untangle && !target.folded.empty()) {
            untangle(target, options.untangling);
        }
        return target;
    }

private:
    [[nodiscard]] SpaceTargetMesh map_constrained() {
        const std::vector<Vec3> source_loop = pick(source_.nodes, source_.loops.nodes);
        const auto fit = fit_affine(AffineMethod::constrained, columns(std::span<const Vec3>(source_loop)),
                                    columns(loop_nodes_), source_.loops.offsets);
        if (fit.status != FitStatus::ok) {
            throw InputError(to_error_code(fit.status), "the loops of the caps determine no affine map");
        }
        find_normals(fit.map.A, fit.uX, fit.uY);
        SpaceTargetMesh target;
        target.map = fit.map;
        target.residual = fit.residual;
        for (const Vec3& x : source_.nodes) {
            target.nodes.push_back(fit.map(x));
        }
        place_nodes(target.nodes);
        return target;
    }

    /// The normals that the affine map gives to the quads (cofactors of A), and that of the target cap as a whole.
    void find_normals(const Eigen::Matrix3d& A, const Vec3& source_normal, const Vec3& target_normal) {
        Eigen::Matrix3d cofactors;
        cofactors << A.col(1).cross(A.col(2)), A.col(2).cross(A.col(0)), A.col(0).cross(A.col(1));
        Vec3 area = Vec3::Zero();
        for (const QuadCorners& q : source_.quads) {
            const Vec3 own = quad_vector_area(gather(source_.nodes, q));
            area += own;
            normals_.push_back((cofactors * own).normalized());
        }
        normal_ = area.dot(source_normal) < 0.0 ? Vec3(-target_normal) : target_normal;
    }

    /// Moves the inner nodes to the surface, the loop nodes to their own places.
    void place_nodes(std::vector<Vec3>& nodes) const {
        for (std::size_t j = 0; j < nodes.size(); ++j) {
            if (boundary_[j] == 0 && place_) {
                nodes[j] = place_(nodes[j]);
            }
        }
        for (std::size_t i = 0; i < loop_nodes_.size(); ++i) {
            nodes[source_.loops.nodes[i]] = loop_nodes_[i];
        }
    }

    [[nodiscard]] std::vector<Index> folded(const SpaceTargetMesh& target) const {
        std::vector<Index> ids;
        for (std::size_t q = 0; q < source_.quads.size(); ++q) {
            const QuadPoints x = gather(std::span<const Vec3>(target.nodes), source_.quads[q]);
            if (detail::folded(x, quad_corner_areas(x, normals_[q]))) {
                ids.push_back(static_cast<Index>(q));
            }
        }
        return ids;
    }

    void correct(SpaceTargetMesh& target, const TargetOptions& options) const {
        std::vector<Vec3> residuals(loop_nodes_.size());
        for (std::size_t i = 0; i < residuals.size(); ++i) {
            residuals[i] = loop_nodes_[i] - target.map(source_.nodes[source_.loops.nodes[i]]);
        }
        SpaceTargetMesh other = target;
        for (std::size_t j = 0; j < other.nodes.size(); ++j) {
            other.nodes[j] = target.map(source_.nodes[j]);
        }
        spread_residuals(options.by, source_.nodes, source_.quads, std::span<const std::uint8_t>(boundary_),
                         std::span<const Index>(source_.loops.nodes), std::span<const Vec3>(residuals),
                         std::span<Vec3>(other.nodes));
        place_nodes(other.nodes);
        other.folded = folded(other);
        other.corrected = true;
        if (options.correction == TargetCorrection::always || other.folded.size() <= target.folded.size()) {
            target = std::move(other);
        }
    }

    /// Untangles the projection along the cap's normal; the heights above that plane stay.
    void untangle(SpaceTargetMesh& target, const UntangleOptions& options) const {
        const Vec3 e1 = normal_.unitOrthogonal();
        const Vec3 e2 = normal_.cross(e1);
        const Vec3 origin = target.map.cy;
        std::vector<Vec2> plane;
        for (const Vec3& x : target.nodes) {
            plane.emplace_back((x - origin).dot(e1), (x - origin).dot(e2));
        }
        const std::vector<Vec2> shapes = plane_coordinates(source_.nodes, source_.quads);
        SpaceTargetMesh other = target;
        other.smooth = untangle_quads(std::span<Vec2>(plane), source_.quads, std::span<const std::uint8_t>(boundary_),
                                      options, std::span<const Vec2>(shapes));
        for (std::size_t j = 0; j < plane.size(); ++j) {
            const double height = (target.nodes[j] - origin).dot(normal_);
            other.nodes[j] = origin + plane[j].x() * e1 + plane[j].y() * e2 + height * normal_;
        }
        place_nodes(other.nodes);
        other.folded = folded(other);
        if (other.folded.size() < target.folded.size()) {
            target = std::move(other);
        } else {
            target.smooth = std::move(other.smooth);
        }
    }

    const SourceCap& source_;
    std::span<const Vec3> loop_nodes_;
    const std::function<Vec3(const Vec3&)>& place_;
    std::vector<std::uint8_t> boundary_;
    std::vector<Vec3> normals_;
    Vec3 normal_ = Vec3::Zero();
};

}  // namespace detail

PAVIOR_INLINE SpaceTargetMesh project_target_in_space(const SourceCap& source, std::span<const Vec3> loop_nodes,
                                                      const TargetOptions& options) {
    return detail::SpaceProjector(source, loop_nodes, {}).run(options);
}

PAVIOR_INLINE SpaceTargetMesh project_target_in_space(const std::function<Vec3(const Vec3&)>& place,
                                                      const SourceCap& source, std::span<const Vec3> loop_nodes,
                                                      const TargetOptions& options) {
    return detail::SpaceProjector(source, loop_nodes, place).run(options);
}

}  // namespace pavior
