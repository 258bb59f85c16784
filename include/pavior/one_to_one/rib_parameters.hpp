#pragma once
/// \file
/// Where the nodes of ribs go on CAD models whose sides bend so much that equal spacing folds quads.

#include <pavior/brep/brep.hpp>
#include <pavior/one_to_one/sweep_topology.hpp>
#include <pavior/sweep/ribs.hpp>
#include <pavior/sweep/spacing.hpp>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace pavior {

namespace detail {

/// A rib that is one edge, as a rib_curve.
template <brep B>
struct EdgeRib {
    const B* model;
    OrientedEdge use;

    [[nodiscard]] double parameter(double t) const {
        const auto range = model->edge_range(use.edge);
        return range[0] + (use.forward ? t : 1.0 - t) * (range[1] - range[0]);
    }
    [[nodiscard]] Vec3 operator()(double t) const { return model->edge_point(use.edge, parameter(t)); }
};

/// The ribs of a sweep, loop by loop.
template <brep B>
struct SweepRibs {
    std::vector<EdgeRib<B>> ribs;
    std::vector<std::size_t> offsets{0};
};

/// The ribs of \p sweep if each is one edge and at least one is bent; side faces above each other have no such ribs.
template <brep B>
[[nodiscard]] std::optional<SweepRibs<B>> single_edge_ribs(const B& b, const SweepTopology& sweep) {
    SweepRibs<B> result;
    bool bent = false;
    for (const std::vector<LinkingSide>& sides : sweep.loops) {
        for (const LinkingSide& side : sides) {
            if (side.left.size() != 1) {
                return std::nullopt;
            }
            result.ribs.push_back({&b, side.left.front()});
            const EdgeRib<B>& rib = result.ribs.back();
            const Vec3 chord = rib(1) - rib(0);
            const Vec3 sag = rib(0.5) - 0.5 * (rib(0) + rib(1));
            bent = bent || sag.norm() > 1e-3 * chord.norm() || chord.norm() < 0.9 * b.edge_length(rib.use.edge);
        }
        result.offsets.push_back(result.ribs.size());
    }
    return bent && !sweep.stacked ? std::optional(std::move(result)) : std::nullopt;
}

}  // namespace detail

/// Parameters of the nodes of edges that should not be spaced equally, by edge id; empty for all other edges. For each
/// sweep with bent ribs, each of one edge, whose ruled patches equal spacing folds or nearly folds, the ribs follow
/// each
/// other (rib_positions(), section 4.2.3 \cite roca2009). \p intervals by edge id. An edge that is a rib of two sweeps
/// gets the positions of the first. O(ribs x samples^2) for bent ribs, nothing for straight ones.
template <brep B>
[[nodiscard]] std::vector<std::vector<double>> rib_parameters(const B& b, std::span<const SweepTopology> sweeps,
                                                              std::span<const int> intervals) {
    std::vector<std::vector<double>> result(b.edge_count());
    for (const SweepTopology& sweep : sweeps) {
        const auto found = detail::single_edge_ribs(b, sweep);
        if (!found) {
            continue;
        }
        const auto layers = static_cast<std::size_t>(intervals[found->ribs.front().use.edge.index()]);
        const RibPositions positions =
            rib_positions(std::span<const detail::EdgeRib<B>>(found->ribs), found->offsets, Spacing::uniform(layers));
        for (std::size_t r = 0; !positions.equal_spacing && r < found->ribs.size(); ++r) {
            const detail::EdgeRib<B>& rib = found->ribs[r];
            std::vector<double>& parameters = result[rib.use.edge.index()];
            if (parameters.empty()) {
                for (const double t : positions.parameters[r]) {
                    parameters.push_back(rib.parameter(t));
                }
                if (!rib.use.forward) {
                    std::reverse(parameters.begin(), parameters.end());
                }
            }
        }
    }
    return result;
}

}  // namespace pavior
