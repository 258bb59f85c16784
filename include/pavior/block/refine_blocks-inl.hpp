#pragma once

#include <pavior/block/detail/block_curves.hpp>
#include <pavior/block/detail/block_lattice.hpp>
#include <pavior/block/place_blocks.hpp>
#include <pavior/block/refine_blocks.hpp>
#include <pavior/core/error.hpp>
#include <pavior/core/parallel_for.hpp>
#include <pavior/core/stop.hpp>
#include <pavior/smooth/hexes.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace pavior {

namespace detail {

class BlockRefiner {
public:
    BlockRefiner(const BlockMesh& blocks, const BlockGeometry& geometry, const BlockPlacement& placement,
                 const RefineOptions& options, std::vector<SheetIntervals> sheets)
        : blocks_(blocks),
          geometry_(geometry),
          placement_(placement),
          options_(options),
          curves_(blocks, geometry, placement),
          out_{{}, {}, {}, {}, std::move(sheets), {}, {}},
          lattice_(blocks, out_.sheets) {}

    [[nodiscard]] RefinedBlocks run() {
        report(options_.progress, "nodes", 0.0);
        out_.mesh.nodes.resize(lattice_.node_count());
        out_.node_origin.resize(lattice_.node_count());
        out_.mesh.hexes.resize(lattice_.hex_count());
        out_.hex_block.resize(lattice_.hex_count());
        for (std::size_t i = 0; i < blocks_.nodes.size(); ++i) {
            put(static_cast<Index>(i), placement_.positions[i], static_cast<Index>(i));
        }
        each(blocks_.edges.size(), [&](Index e) { fill_edge(e); });
        each(blocks_.quads.size(), [&](Index q) { fill_quad(q); });
        each(blocks_.hexes.size(), [&](Index h) { fill_hex(h); });
        collect_boundary();
        report(options_.progress, "nodes", 0.3);
        untangle();
        report(options_.progress, "nodes", 1.0);
        return std::move(out_);
    }

private:
    using Lattice = BlockLattice::Lattice;

    template <class Body>
    void each(std::size_t count, const Body& body) const {
        parallel_for(options_.execution, count, 1, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                body(static_cast<Index>(i));
            }
        });
    }

    [[nodiscard]] const Vec3& at(Index i) const { return out_.mesh.nodes[i]; }

    void put(Index i, const Vec3& x, Index origin) {
        out_.mesh.nodes[i] = x;
        out_.node_origin[i] = origin;
    }

    void fill_edge(Index e) {
        const std::uint32_t n = lattice_.edge_intervals(e);
        for (std::uint32_t i = 1; i < n; ++i) {
            put(lattice_.edge_node(e, i), curves_.edge_point(e, static_cast<double>(i) / n), blocks_.edge_origin(e));
        }
    }

    /// On its patch; in a cell, between its four edges.
    void fill_quad(Index q) {
        const auto n = lattice_.quad_intervals(q);
        const Index origin = blocks_.quad_origin(q);
        const BlockNode& top = blocks_.nodes[origin];
        const bool on_patch = top.dimension == 2;
        const auto places = on_patch ? curves_.places(q) : std::array<Vec2, 4>{};
        for (std::uint32_t j = 1; j < n[1]; ++j) {
            for (std::uint32_t i = 1; i < n[0]; ++i) {
                const double u = static_cast<double>(i) / n[0];
                const double v = static_cast<double>(j) / n[1];
                put(lattice_.quad_node(q, i, j),
                    on_patch ? geometry_.patches[top.id].at(bilinear(places, u, v)) : between_edges(q, i, j, u, v),
                    origin);
            }
        }
    }

    [[nodiscard]] Vec3 between_edges(Index q, std::uint32_t i, std::uint32_t j, double u, double v) const {
        const auto& e = lattice_.quad_edges(q);
        const QuadCorners& c = blocks_.quads[q];
        const auto point = [&](Index edge, std::uint32_t k) { return at(lattice_.edge_node(edge, k)); };
        return (1.0 - v) * point(e[0], i) + v * point(e[2], i) + (1.0 - u) * point(e[3], j) + u * point(e[1], j) -
               bilinear<Vec3>({at(c[0]), at(c[1]), at(c[2]), at(c[3])}, u, v);
    }

    void fill_hex(Index h) {
        const Lattice n = lattice_.hex_intervals(h);
        const auto id = [&](std::uint32_t i, std::uint32_t j, std::uint32_t k) {
            return lattice_.hex_node(h, n, i, j, k);
        };
        for (std::uint32_t k = 1; k < n[2]; ++k) {
            for (std::uint32_t j = 1; j < n[1]; ++j) {
                for (std::uint32_t i = 1; i < n[0]; ++i) {
                    put(id(i, j, k), between_quads(h, n, {i, j, k}), blocks_.hex_origin(h));
                }
            }
        }
        std::size_t cell = lattice_.first_hex(h);
        for (std::uint32_t k = 0; k < n[2]; ++k) {
            for (std::uint32_t j = 0; j < n[1]; ++j) {
                for (std::uint32_t i = 0; i < n[0]; ++i, ++cell) {
                    out_.hex_block[cell] = h;
                    out_.mesh.hexes[cell] = {
                        id(i, j, k),     id(i + 1, j, k),     id(i + 1, j + 1, k),     id(i, j + 1, k),
                        id(i, j, k + 1), id(i + 1, j, k + 1), id(i + 1, j + 1, k + 1), id(i, j + 1, k + 1)};
                }
            }
        }
    }

    /// The sum over the faces, less that over the edges, plus that over the corners.
    [[nodiscard]] Vec3 between_quads(Index h, const Lattice& n, const Lattice& lattice) const {
        Vec3 sum = Vec3::Zero();
        for (std::size_t code = 1; code < 27; ++code) {  // a digit a direction: 0 as given, 1 low end, 2 high end
            Lattice where = lattice;
            double weight = -1.0;
            for (std::size_t d = 0, digits = code; d < 3; ++d, digits /= 3) {
                const double t = static_cast<double>(lattice[d]) / n[d];
                if (digits % 3 != 0) {
                    where[d] = digits % 3 == 1 ? 0 : n[d];
                    weight *= digits % 3 == 1 ? t - 1.0 : -t;
                }
            }
            sum += weight * at(lattice_.hex_node(h, n, where[0], where[1], where[2]));
        }
        return sum;
    }

    void collect_boundary() {
        for (const Index q : IndexRange(blocks_.quads.size())) {
            if (!blocks_.boundary_quad(q)) {
                continue;
            }
            check_stop(options_.execution.stop);
            const auto n = lattice_.quad_intervals(q);
            const Index patch = blocks_.nodes[blocks_.quad_origin(q)].id;
            const auto places = curves_.places(q);
            for (std::uint32_t j = 0; j < n[1]; ++j) {
                for (std::uint32_t i = 0; i < n[0]; ++i) {
                    const auto id = [&](std::uint32_t a, std::uint32_t b) {
                        return lattice_.quad_node(q, i + a, j + b);
                    };
                    const Vec2 middle = bilinear(places, (i + 0.5) / n[0], (j + 0.5) / n[1]);
                    const Index triangle = geometry_.patches[patch].triangle_at(middle);
                    out_.boundary.push_back(
                        {{id(0, 0), id(1, 0), id(1, 1), id(0, 1)}, patch, geometry_.patch_tags[patch][triangle]});
                }
            }
        }
    }

    void untangle() {
        const bool move = options_.untangle || options_.optimise;
        std::vector<std::uint8_t> fixed(out_.mesh.nodes.size(), move ? 0 : 1);  // all fixed: a report and no more
        for (const BlockQuad& quad : out_.boundary) {
            for (const Index i : quad.nodes) {
                fixed[i] = 1;
            }
        }
        UntangleOptions options;
        options.always = options_.optimise;
        options.max_ids = std::numeric_limits<std::size_t>::max();
        options.execution = options_.execution;
        options.progress = stage_of(options_.progress, 0.3, 1.0);
        out_.untangling = untangle_hexes(out_.mesh.nodes, out_.mesh.hexes, fixed, options);
        for (const Index h : out_.untangling.inverted_ids) {
            if (out_.inverted_blocks.empty() || out_.inverted_blocks.back() != out_.hex_block[h]) {
                out_.inverted_blocks.push_back(out_.hex_block[h]);
            }
        }
    }

    const BlockMesh& blocks_;
    const BlockGeometry& geometry_;
    const BlockPlacement& placement_;
    const RefineOptions& options_;
    BlockCurves curves_;
    RefinedBlocks out_;
    BlockLattice lattice_;  // after out_, whose sheets it looks at
};

}  // namespace detail

PAVIOR_INLINE RefinedBlocks refine_blocks(const BlockMesh& blocks, const BlockGeometry& geometry,
                                          const BlockPlacement& placement, const RefineOptions& options) {
    const auto require = [](bool condition, ErrorCode code, const char* message) {
        if (!condition) {
            throw InputError(code, message);
        }
    };
    require(placement.positions.size() == blocks.nodes.size() && placement.parameters.size() == blocks.nodes.size() &&
                geometry.vertices.size() == blocks.first[1] &&
                geometry.chains.size() == blocks.first[2] - blocks.first[1] &&
                geometry.patches.size() == blocks.first[3] - blocks.first[2],
            ErrorCode::size_mismatch, "blocks, geometry and placement do not belong together");
    require(options.intervals.empty() || options.intervals.size() == blocks.sheet_count, ErrorCode::size_mismatch,
            "RefineOptions::intervals: one number a sheet expected");
    require(options.max_angle > 0.0, ErrorCode::bad_option, "RefineOptions::max_angle must be positive");
    require(std::count(options.intervals.begin(), options.intervals.end(), 0U) == 0 && std::isfinite(options.size),
            ErrorCode::bad_option, "RefineOptions: intervals of 1 or more and a finite size expected");
    const BlockLengths lengths{options.size, options.max_angle, options.curve_size, options.patch_size};
    std::vector<SheetIntervals> sheets = sheet_intervals(blocks, geometry, placement, lengths);
    for (std::size_t s = 0; s < options.intervals.size(); ++s) {
        sheets[s].intervals = options.intervals[s];
    }
    return detail::BlockRefiner(blocks, geometry, placement, options, std::move(sheets)).run();
}

}  // namespace pavior
