#pragma once
/// \file
/// Hexahedra whose nodes are fixed, slide on curves and surfaces, or move freely.

#include <pavior/smooth/detail/cartesian_model.hpp>
#include <pavior/smooth/detail/guide_view.hpp>
#include <pavior/smooth/detail/scaled_barrier.hpp>
#include <pavior/smooth/node_guide.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace pavior::detail {

/// An energy whose nodes stay in the tangent spaces of their curves and surfaces; settle() brings them back to these
/// and takes the tangent spaces anew. Minimisers whose preconditioner treats the coordinates of a node alike never
/// leave the tangent spaces between two calls.
/// Frame: a point of the mesh is origin + size * coordinates.
template <class Energy, class Frame>
class GuidedEnergy : public Energy {
public:
    GuidedEnergy(Energy energy, const GuideView& guide, std::span<const Freedom> freedoms, const Patch<3>& patch,
                 const Frame& frame)
        : Energy(std::move(energy)), guide_(guide), patch_(patch), frame_(frame) {
        for (std::size_t k = 0; k < patch.free_count; ++k) {
            const Freedom freedom = freedoms[patch.nodes[k]];
            if (slides(freedom)) {
                sliding_.push_back({static_cast<Eigen::Index>(k), freedom, Vec3::Zero()});
            }
        }
    }

    template <class Mode>
    auto evaluate(const Eigen::VectorXd& x, const Mode& mode, Eigen::VectorXd& gradient) {
        const auto value = Energy::evaluate(x, mode, gradient);
        for (const Sliding& node : sliding_) {
            auto slope = gradient.template segment<3>(3 * node.at);
            const Vec3 along = node.direction.dot(slope) * node.direction;
            const bool rests = node.direction.isZero(0.0);
            slope = rests ? Vec3(Vec3::Zero()) : node.freedom == Freedom::curve ? along : Vec3(slope - along);
        }
        return value;
    }

    void refresh(Eigen::VectorXd& x) { settle(x); }
    void settle(Eigen::VectorXd& x) {
        for (Sliding& node : sliding_) {
            const Index id = patch_.nodes[static_cast<std::size_t>(node.at)];
            auto local = x.template segment<3>(3 * node.at);
            const Vec3 before = frame_.origin + frame_.size * local;
            const Vec3 point = guide_.point(id, before, before);
            local = (point - frame_.origin) / frame_.size;
            node.direction = guide_.direction(node.freedom, id, point, 1e-4 * frame_.size);
        }
    }

private:
    struct Sliding {
        Eigen::Index at;
        Freedom freedom;
        Vec3 direction;  ///< unit tangent of the curve, normal of the surface; null: rests
    };

    const GuideView& guide_;
    const Patch<3>& patch_;
    const Frame& frame_;
    std::vector<Sliding> sliding_;
};

/// The smoothing_model of hexahedra with a node_guide. Nodes that slide are on their curve or surface once they have
/// been moved.
class GuidedModel : public CartesianModel<3> {
    [[nodiscard]] bool sliding(const Patch<3>& patch) const {
        return std::any_of(patch.nodes.begin(), patch.nodes.begin() + static_cast<std::ptrdiff_t>(patch.free_count),
                           [&](Index i) { return slides(freedoms_[i]); });
    }

    template <class Energy, class Solve>
    auto move(const Patch<3>& patch, const Frame& frame, Energy energy, const Solve& solve) {
        if (!sliding(patch)) {
            return solve(energy, [&](const Eigen::VectorXd& x) { write(patch, frame, x); });
        }
        GuidedEnergy<Energy, Frame> guided(std::move(energy), guide_, freedoms_, patch, frame);
        return solve(guided, [&](const Eigen::VectorXd& x) {
            const std::vector<Vec3> saved = save(patch);
            write(patch, frame, x);
            for (std::size_t k = 0; k < patch.free_count; ++k) {
                const Index i = patch.nodes[k];
                if (slides(freedoms_[i])) {
                    node(i) = guide_.point(i, node(i), saved[k]);
                }
            }
        });
    }

public:
    /// \param freedoms  what the guide says of each node, \p fixed the flags of those that are fixed.
    GuidedModel(std::span<Vec3> nodes, std::span<const HexCorners> cells, std::span<const std::uint8_t> fixed,
                const GuideView& guide, std::span<const Freedom> freedoms, std::span<const Vec3> reference,
                const UntangleOptions& options)
        : CartesianModel<3>(nodes, cells, fixed, reference, options), guide_(guide), freedoms_(freedoms) {}

    using CartesianModel<3>::concurrent;
    [[nodiscard]] bool concurrent(const Patch<3>& patch) const { return guide_.concurrent() || !sliding(patch); }

    int solve(const Patch<3>& patch, double wanted, const Execution& execution) {
        const Frame frame = frame_of(patch);
        return move(patch, frame, energy_of(patch, frame, execution),
                    [&](auto& energy, auto&& write) { return move_patch(energy, wanted, options(), write); });
    }

    /// Moves the free nodes so that the smallest scaled Jacobian of the patch grows, until it reaches \p wanted or does
    /// not grow any more.
    LbfgsResult raise(const Patch<3>& patch, double wanted, const Execution& execution) {
        const Frame frame = frame_of(patch);
        ScaledBarrier barrier(coordinates(patch, frame), patch.cells, patch.free_count, samples(), execution);
        leave_out(barrier, patch);
        return move(patch, frame, std::move(barrier), [&](auto& energy, auto&& write) {
            Eigen::VectorXd x = energy.free_nodes();
            Lbfgs lbfgs;
            const LbfgsResult done = raise_scaled(energy, x, wanted, lbfgs);
            write(x);
            return done;
        });
    }

private:
    GuideView guide_;
    std::span<const Freedom> freedoms_;
};

}  // namespace pavior::detail
