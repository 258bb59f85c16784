#pragma once
/// \file
/// The edges and boundary quads of blocks as curves and patches of the geometry.

#include <pavior/block/block_geometry.hpp>
#include <pavior/block/block_mesh.hpp>
#include <pavior/block/place_blocks.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace pavior::detail {

template <class T>
[[nodiscard]] T bilinear(const std::array<T, 4>& x, double u, double v) {
    return (1.0 - v) * ((1.0 - u) * x[0] + u * x[1]) + v * ((1.0 - u) * x[3] + u * x[2]);
}

/// Where edges and quads of placed blocks run.
class BlockCurves {
public:
    BlockCurves(const BlockMesh& blocks, const BlockGeometry& geometry, const BlockPlacement& placement)
        : blocks_(blocks), geometry_(geometry), placement_(placement) {}

    /// A point of edge \p e at the fraction \p s of it, on the chain or patch that it lies in.
    [[nodiscard]] Vec3 edge_point(Index e, double s) const {
        const auto [low, high] = blocks_.edges[e];
        const BlockNode& node = blocks_.nodes[high];
        if (node.dimension == 1) {
            const double from = geometry_.chain_ends[node.id][0] == blocks_.nodes[low].id ? 0.0 : 1.0;
            return geometry_.chains[node.id].at((1.0 - s) * from + s * placement_.parameters[high][0]);
        }
        if (node.dimension == 2) {
            return geometry_.patches[node.id].at((1.0 - s) * chain_place(node.id, blocks_.nodes[low].id) +
                                                 s * placement_.parameters[high].head<2>());
        }
        return (1.0 - s) * placement_.positions[low] + s * placement_.positions[high];
    }

    /// Length along the geometry, up to the sag of 16 pieces.
    [[nodiscard]] double edge_length(Index e) const {
        constexpr int pieces = 16;
        double length = 0.0;
        Vec3 last = edge_point(e, 0.0);
        for (int i = 1; i <= pieces; ++i) {
            const Vec3 next = edge_point(e, static_cast<double>(i) / pieces);
            length += (next - last).norm();
            last = next;
        }
        return length;
    }

    /// The angle by which the geometry turns along an edge, degrees: the tangent of chains, the normal of patches; both
    /// from few points, so that facets count little. 0 inside of cells.
    [[nodiscard]] double edge_turning(Index e) const {
        const auto [low, high] = blocks_.edges[e];
        const BlockNode& node = blocks_.nodes[high];
        if (node.dimension == 1) {
            return degrees_a_radian * chain_turning(e);
        }
        if (node.dimension == 2) {
            const Vec2 from = chain_place(node.id, blocks_.nodes[low].id);
            return degrees_a_radian * patch_turning(node.id, from, placement_.parameters[high].head<2>());
        }
        return 0.0;
    }

    /// The least number of equal intervals, from \p least to \p most, with which no chord along an edge on a chain is
    /// farther from it than if it turned by \p max_angle degrees evenly; if there is none (a kink), the least number
    /// that is nearly as good as the best. \p least for other edges.
    [[nodiscard]] std::uint32_t intervals_round_bends(Index e, double max_angle, std::uint32_t least,
                                                      std::uint32_t most) const {
        if (blocks_.nodes[blocks_.edge_origin(e)].dimension != 1 || most <= least) {
            return least;
        }
        std::vector<double> sags;
        for (std::uint32_t n = least; n <= most; ++n) {
            sags.push_back(largest_sag(e, n));
            if (sags.back() <= 1.1 * std::tan(std::min(max_angle, 180.0) / degrees_a_radian / 4.0)) {
                return n;
            }
        }
        const double best = *std::min_element(sags.begin(), sags.end());
        const auto good = std::find_if(sags.begin(), sags.end(), [&](double sag) { return sag <= 1.1 * best; });
        return least + static_cast<std::uint32_t>(good - sags.begin());
    }

    /// The corners of a quad on a patch in the polygon of this.
    [[nodiscard]] std::array<Vec2, 4> places(Index q) const {
        const QuadCorners& c = blocks_.quads[q];
        const Index patch = blocks_.nodes[c[2]].id;
        const auto& sides = geometry_.patch_sides[patch];
        const Index vertex = blocks_.nodes[c[0]].id;
        const auto side =
            std::find_if(sides.begin(), sides.end(), [&](const PatchSide& s) { return s.vertex == vertex; });
        return {geometry_.patches[patch].polygon()[static_cast<std::size_t>(side - sides.begin())],
                chain_place(patch, blocks_.nodes[c[1]].id), placement_.parameters[c[2]].head<2>(),
                chain_place(patch, blocks_.nodes[c[3]].id)};
    }

private:
    static constexpr double degrees_a_radian = 57.29577951308232;

    /// Of \p n equal chords: how far the edge is from one, in parts of its length.
    [[nodiscard]] double largest_sag(Index e, std::uint32_t n) const {
        constexpr int pieces = 8;
        double largest = 0.0;
        Vec3 from = edge_point(e, 0.0);
        for (std::uint32_t i = 0; i < n; ++i) {
            const Vec3 to = edge_point(e, (i + 1.0) / n);
            for (int k = 1; k < pieces; ++k) {
                const Vec3 off = edge_point(e, (i + static_cast<double>(k) / pieces) / n) - from;
                const double square = (to - from).squaredNorm();
                largest = square > 0.0 ? std::max(largest, off.cross(to - from).norm() / square) : largest;
            }
            from = to;
        }
        return largest;
    }

    [[nodiscard]] static double angle(const Vec3& a, const Vec3& b) { return std::atan2(a.cross(b).norm(), a.dot(b)); }

    /// Of the arc through both ends and the middle.
    [[nodiscard]] double chain_turning(Index e) const {
        const Vec3 middle = edge_point(e, 0.5);
        return 2.0 * angle(middle - edge_point(e, 0.0), edge_point(e, 1.0) - middle);
    }

    [[nodiscard]] double patch_turning(Index patch, const Vec2& from, const Vec2& to) const {
        constexpr double end = 0.15;
        const Vec2 along = end * (to - from);
        const Vec2 across(-along[1], along[0]);
        const auto normal = [&](const Vec2& p) -> Vec3 {
            const PatchMap& map = geometry_.patches[patch];
            return (map.at(p + along) - map.at(p - along)).cross(map.at(p + across) - map.at(p - across));
        };
        return angle(normal(from + along), normal(to - along)) / (1.0 - 2.0 * end);
    }

    /// Where the node of a chain lies in the polygon of a patch on it.
    [[nodiscard]] Vec2 chain_place(Index patch, Index chain) const {
        const auto& sides = geometry_.patch_sides[patch];
        const auto side =
            std::find_if(sides.begin(), sides.end(), [&](const PatchSide& s) { return s.chain == chain; });
        const double t = placement_.parameters[blocks_.node(1, chain)][0];
        return geometry_.patches[patch].side(static_cast<std::size_t>(side - sides.begin()),
                                             side->reversed ? 1.0 - t : t);
    }

    const BlockMesh& blocks_;
    const BlockGeometry& geometry_;
    const BlockPlacement& placement_;
};

}  // namespace pavior::detail
