#pragma once

#include <pavior/block/place_blocks.hpp>
#include <pavior/core/error.hpp>
#include <pavior/core/stop.hpp>
#include <pavior/math/hexahedron.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace pavior {

namespace detail {

/// Moves block nodes along their chains, on their patches and in their cells.
class BlockPlacer {
public:
    BlockPlacer(const BlockMesh& blocks, const BlockGeometry& geometry, const PlaceOptions& options)
        : blocks_(blocks), geometry_(geometry), options_(options) {
        star_begin_.assign(blocks.nodes.size() + 1, 0);
        for (const HexCorners& c : blocks.hexes) {
            for (const Index i : c) {
                ++star_begin_[i + 1];
            }
        }
        for (std::size_t i = 1; i < star_begin_.size(); ++i) {
            star_begin_[i] += star_begin_[i - 1];
        }
        star_.resize(star_begin_.back());
        std::vector<std::size_t> next(star_begin_.begin(), star_begin_.end() - 1);
        for (std::size_t h = 0; h < blocks.hexes.size(); ++h) {
            for (const Index i : blocks.hexes[h]) {
                star_[next[i]++] = static_cast<Index>(h);
            }
        }
        chain_patches_.resize(geometry.chains.size());
        for (std::size_t p = 0; p < geometry.patch_sides.size(); ++p) {
            for (const PatchSide& side : geometry.patch_sides[p]) {
                chain_patches_[side.chain].push_back(static_cast<Index>(p));
            }
        }
        place_first();
    }

    [[nodiscard]] BlockPlacement run() {
        const std::vector<Vec3> first = placement_.parameters;
        optimise();
        for (std::size_t h = 0; h < blocks_.hexes.size(); ++h) {
            const double q = quality(static_cast<Index>(h));
            placement_.min_jacobian = std::min(placement_.min_jacobian, q);
            if (!(q > 0.0)) {
                placement_.inverted.push_back(static_cast<Index>(h));
            }
        }
        for (std::size_t i = 0; i < first.size(); ++i) {
            placement_.moved += first[i] != placement_.parameters[i] ? 1U : 0U;
        }
        return std::move(placement_);
    }

private:
    [[nodiscard]] Vec3 position(Index i, const Vec3& parameter) const {
        const BlockNode& node = blocks_.nodes[i];
        switch (node.dimension) {
            case 0: return geometry_.vertices[node.id];
            case 1: return geometry_.chains[node.id].at(parameter[0]);
            case 2: return geometry_.patches[node.id].at(parameter.head<2>());
            default: return parameter;
        }
    }

    [[nodiscard]] Vec3 first_parameter(const BlockNode& node) const {
        switch (node.dimension) {
            case 0: return Vec3::Zero();
            case 1: return {0.5, 0.0, 0.0};
            case 2: {
                const PatchMap& map = geometry_.patches[node.id];
                const Vec2 uv = map.nearest(map.centroid());
                const Vec2 inside = within(node.id, uv) ? uv : map.middle();
                return {inside[0], inside[1], 0.0};
            }
            default: return geometry_.cells[node.id];
        }
    }

    void place_first() {
        placement_.parameters.assign(blocks_.nodes.size(),
                                     Vec3(0.5, 0.0, 0.0));  // chains first: within() asks for them
        placement_.positions.resize(blocks_.nodes.size());
        for (std::size_t i = 0; i < blocks_.nodes.size(); ++i) {
            set(static_cast<Index>(i), first_parameter(blocks_.nodes[i]));
        }
    }

    void set(Index i, const Vec3& parameter) {
        placement_.parameters[i] = parameter;
        placement_.positions[i] = position(i, parameter);
    }

    /// True if the quads of the patch round its node at \p uv are convex in the polygon.
    [[nodiscard]] bool within(Index patch, const Vec2& uv) const {
        const auto& sides = geometry_.patch_sides[patch];
        const PatchMap& map = geometry_.patches[patch];
        const auto middle = [&](std::size_t s) {
            const double t = placement_.parameters[blocks_.node(1, sides[s].chain)][0];
            return map.side(s, sides[s].reversed ? 1.0 - t : t);
        };
        const auto turns = [](const Vec2& a, const Vec2& b) {
            return a[0] * b[1] - a[1] * b[0] > 1e-3 * a.norm() * b.norm();
        };
        for (std::size_t s = 0; s < sides.size(); ++s) {
            const Vec2& corner = map.polygon()[s];
            const Vec2 after = middle(s);
            const Vec2 before = middle((s + sides.size() - 1) % sides.size());
            if (!turns(after - corner, uv - after) || !turns(uv - after, before - uv) ||
                !turns(before - uv, corner - before)) {
                return false;
            }
        }
        return true;
    }

    /// True if the node may have this parameter; it must have it already.
    [[nodiscard]] bool allowed(Index i) const {
        const BlockNode& node = blocks_.nodes[i];
        const auto convex = [&](Index patch) {
            return within(patch, placement_.parameters[blocks_.node(2, patch)].head<2>());
        };
        if (node.dimension == 1) {
            const double t = placement_.parameters[i][0];
            const auto& patches = chain_patches_[node.id];
            return t >= 0.05 && t <= 0.95 && std::all_of(patches.begin(), patches.end(), convex);
        }
        return node.dimension != 2 || convex(node.id);
    }

    [[nodiscard]] double quality(Index hex) const {
        HexPoints x;
        for (std::size_t k = 0; k < 8; ++k) {
            x[k] = placement_.positions[blocks_.hexes[hex][k]];
        }
        return hex_scaled_jacobian(x);
    }

    [[nodiscard]] std::span<const Index> star(Index i) const {
        return std::span(star_).subspan(star_begin_[i], star_begin_[i + 1] - star_begin_[i]);
    }

    /// How much the blocks round node \p i fall short of twice the quality wanted.
    [[nodiscard]] double shortfall(Index i) const {
        double sum = 0.0;
        for (const Index h : star(i)) {
            const double missing = std::max(0.0, 2.0 * options_.sufficient - quality(h));
            sum += missing * missing;
        }
        return sum;
    }

    /// Tries a parameter; keeps it if the blocks round the node fall less short.
    bool try_at(Index i, const Vec3& parameter, double& best) {
        const Vec3 old_parameter = placement_.parameters[i];
        const Vec3 old_position = placement_.positions[i];
        set(i, parameter);
        if (allowed(i)) {
            if (const double now = shortfall(i); now < best * (1.0 - 1e-6)) {
                best = now;
                return true;
            }
        }
        placement_.parameters[i] = old_parameter;
        placement_.positions[i] = old_position;
        return false;
    }

    /// A length by which the parameter of a node may sensibly change.
    [[nodiscard]] double first_step(Index i) const {
        const BlockNode& node = blocks_.nodes[i];
        if (node.dimension == 1) {
            return 0.2;
        }
        double reach = 0.0;
        if (node.dimension == 2) {
            for (const Vec2& p : geometry_.patches[node.id].polygon()) {
                reach = std::max(reach, (p - geometry_.patches[node.id].middle()).norm());
            }
        } else {
            for (const Index h : star(i)) {
                reach = std::max(reach, (placement_.positions[blocks_.hexes[h][0]] - placement_.positions[i]).norm());
            }
        }
        return 0.2 * reach;
    }

    /// Places that are worth a look before small steps are taken.
    void try_others(Index i, double& best) {
        const BlockNode& node = blocks_.nodes[i];
        if (node.dimension == 2) {
            const Vec2 middle = geometry_.patches[node.id].middle();
            try_at(i, {middle[0], middle[1], 0.0}, best);
        } else if (node.dimension == 3) {
            for (const std::size_t corner : {0U, 1U, 2U}) {
                Vec3 mean = Vec3::Zero();
                for (const Index h : star(i)) {
                    mean += placement_.positions[blocks_.hexes[h][corner]] / static_cast<double>(star(i).size());
                }
                try_at(i, mean, best);
            }
        }
    }

    /// One round of steps; true if the node has moved.
    bool improve(Index i, double step) {
        double best = shortfall(i);
        if (best == 0.0) {
            return false;
        }
        bool moved = false;
        const int axes = blocks_.nodes[i].dimension;
        for (int code = 1; code < (axes == 1 ? 3 : axes == 2 ? 9 : 27); ++code) {
            Vec3 direction = Vec3::Zero();
            for (int axis = 0, digits = code; axis < axes; ++axis, digits /= 3) {
                direction[axis] = digits % 3 == 2 ? -1.0 : digits % 3;
            }
            moved |= try_at(i, placement_.parameters[i] + step * direction.normalized(), best);
        }
        return moved;
    }

    void optimise() {
        std::vector<double> steps(blocks_.nodes.size(), 0.0);
        for (int round = 0; round < options_.max_rounds; ++round) {
            std::vector<char> wanted(blocks_.nodes.size(), 0);
            bool bad = false;
            for (std::size_t h = 0; h < blocks_.hexes.size(); ++h) {
                if (quality(static_cast<Index>(h)) < options_.sufficient) {
                    bad = true;
                    for (const Index i : blocks_.hexes[h]) {
                        wanted[i] = blocks_.nodes[i].dimension > 0 ? 1 : 0;
                    }
                }
            }
            if (!bad || !move_wanted(wanted, steps)) {
                return;
            }
        }
    }

    /// False when no node can be moved any more.
    bool move_wanted(const std::vector<char>& wanted, std::vector<double>& steps) {
        bool alive = false;
        for (std::size_t n = wanted.size(); n-- > 0;) {  // cells first, then patches, chains last
            const auto i = static_cast<Index>(n);
            if (wanted[n] == 0) {
                continue;
            }
            check_stop(options_.execution.stop);
            if (steps[n] == 0.0) {
                steps[n] = first_step(i);
                double best = shortfall(i);
                try_others(i, best);
            }
            if (!improve(i, steps[n])) {
                steps[n] /= 2.0;
            }
            alive |= steps[n] > 1e-3 * first_step(i);
        }
        return alive;
    }

    const BlockMesh& blocks_;
    const BlockGeometry& geometry_;
    PlaceOptions options_;
    BlockPlacement placement_;
    std::vector<std::size_t> star_begin_;
    std::vector<Index> star_;
    std::vector<std::vector<Index>> chain_patches_;
};

}  // namespace detail

PAVIOR_INLINE BlockPlacement place_blocks(const BlockMesh& blocks, const BlockGeometry& geometry,
                                          const PlaceOptions& options) {
    if (!(options.sufficient >= 0.0 && options.sufficient < 1.0) || options.max_rounds < 0) {
        throw InputError(ErrorCode::bad_option, "PlaceOptions: sufficient in [0, 1) and max_rounds >= 0 expected");
    }
    const std::array<std::size_t, 4> counts{geometry.vertices.size(), geometry.chains.size(), geometry.patches.size(),
                                            geometry.cells.size()};
    for (std::size_t d = 0; d < 4; ++d) {
        if (blocks.first[d + 1] - blocks.first[d] != counts[d]) {
            throw InputError(ErrorCode::size_mismatch, "blocks and geometry are not of one cell complex");
        }
    }
    return detail::BlockPlacer(blocks, geometry, options).run();
}

}  // namespace pavior
