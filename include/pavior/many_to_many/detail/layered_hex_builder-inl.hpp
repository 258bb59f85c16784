#pragma once

#include <pavior/core/error.hpp>
#include <pavior/many_to_many/detail/layered_hex_builder.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace pavior {

namespace detail {

/// Which side lies over an edge between two levels.
struct SideSpan {
    Index side;
    int low, high;
};

/// Per edge of the arrangement: the sides over it.
[[nodiscard]] inline std::vector<std::vector<SideSpan>> side_spans(const ExtrudedBody& body,
                                                                   const PlaneArrangement& plane,
                                                                   const CapLevels& levels) {
    std::vector<std::vector<SideSpan>> result(plane.edges.size());
    for (Index s = 0; s < body.sides.size(); ++s) {
        std::vector<std::pair<Index, int>> at;
        for (const Index c : body.sides[s].curves) {
            for (const OrientedPlaneEdge& use : plane.routes[c]) {
                at.emplace_back(use.edge, levels.curves[c]);
            }
        }
        std::sort(at.begin(), at.end());
        for (std::size_t i = 0; i + 1 < at.size(); i += 2) {
            result[at[i].first].push_back({s, at[i].second, at[i + 1].second});
        }
    }
    return result;
}

PAVIOR_INLINE LayerSolids::LayerSolids(const ExtrudedBody& body, const std::vector<CapsOverCell>& stacks,
                                       const CapLevels& levels)
    : layers_(static_cast<std::size_t>(levels.count)), solid_(stacks.size() * layers_, no_index) {
    for (std::size_t cell = 0; cell < stacks.size(); ++cell) {
        const std::vector<Index>& caps = stacks[cell].caps;
        for (std::size_t i = 0; i + 1 < caps.size(); ++i) {
            for (int k = levels.caps[caps[i]]; k < levels.caps[caps[i + 1]]; ++k) {
                solid_[cell * layers_ + static_cast<std::size_t>(k)] = body.caps[caps[i]].above;
            }
        }
    }
}

PAVIOR_INLINE LayeredHexBuilder::LayeredHexBuilder(const ExtrudedBody& body, const PlaneArrangement& arrangement,
                                                   const PlaneMesh& plane, const std::vector<CapsOverCell>& stacks,
                                                   const CapLevels& levels)
    : body_(body),
      arrangement_(arrangement),
      plane_(plane),
      stacks_(stacks),
      levels_(levels),
      solids_(body, stacks, levels),
      nodes_(plane.nodes.size(), solids_.layers() + 1) {
    number_nodes();
    add_hexes();
    add_caps();
    add_sides();
}

PAVIOR_INLINE void LayeredHexBuilder::number_nodes() {
    for (std::size_t layer = 0; layer < solids_.layers(); ++layer) {
        for (Index cell = 0; cell < plane_.cell_count(); ++cell) {
            if (solids_(cell, layer) != no_index) {
                for_quads(cell, [&](const QuadCorners& quad) {
                    for (const Index p : quad) {
                        nodes_.use(p, layer);
                        nodes_.use(p, layer + 1);
                    }
                });
            }
        }
    }
    result_.mesh.nodes.resize(nodes_.number());
}

PAVIOR_INLINE void LayeredHexBuilder::add_hexes() {
    for (std::size_t layer = 0; layer < solids_.layers(); ++layer) {
        for (Index cell = 0; cell < plane_.cell_count(); ++cell) {
            const Index solid = solids_(cell, layer);
            if (solid == no_index) {
                continue;
            }
            for_quads(cell, [&](const QuadCorners& q) {
                HexCorners hex{};
                for (std::size_t k = 0; k < 4; ++k) {
                    hex[k] = nodes_(q[k], layer);
                    hex[k + 4] = nodes_(q[k], layer + 1);
                }
                result_.mesh.hexes.push_back(hex);
                result_.hex_solid.push_back(solid);
            });
        }
    }
}

PAVIOR_INLINE void LayeredHexBuilder::add_quad(QuadCorners quad, bool flip, Index surface, Index solid) {
    if (flip) {
        std::swap(quad[1], quad[3]);
    }
    result_.quads.push_back(quad);
    result_.quad_surface.push_back(surface);
    result_.quad_solid.push_back(solid);
}

PAVIOR_INLINE void LayeredHexBuilder::add_caps() {
    std::vector<std::vector<Index>> cells(body_.caps.size());
    for (Index cell = 0; cell < stacks_.size(); ++cell) {
        for (const Index c : stacks_[cell].caps) {
            cells[c].push_back(cell);
        }
    }
    for (Index c = 0; c < body_.caps.size(); ++c) {
        const auto level = static_cast<std::size_t>(levels_.caps[c]);
        const bool down = body_.caps[c].below == no_index;
        for (const Index cell : cells[c]) {
            for_quads(cell, [&](const QuadCorners& q) {
                add_quad({nodes_(q[0], level), nodes_(q[1], level), nodes_(q[2], level), nodes_(q[3], level)}, down, c,
                         down ? body_.caps[c].above : body_.caps[c].below);
            });
        }
    }
}

PAVIOR_INLINE void LayeredHexBuilder::add_sides() {
    const auto spans = side_spans(body_, arrangement_, levels_);
    for (Index e = 0; e < arrangement_.edges.size(); ++e) {
        const std::array<Index, 2>& cells = arrangement_.edges[e].cells;
        for (std::size_t layer = 0; layer < solids_.layers(); ++layer) {
            const Index left = solids_(cells[0], layer);
            const Index right = solids_(cells[1], layer);
            const auto over = std::find_if(spans[e].begin(), spans[e].end(), [&](const SideSpan& s) {
                return s.low <= static_cast<int>(layer) && static_cast<int>(layer) < s.high;
            });
            if (left == right && over == spans[e].end()) {
                continue;
            }
            if (left == right) {
                const int tag = body_.sides[over->side].tag;
                throw UnmeshableError(ErrorCode::not_sweepable,
                                      "face " + std::to_string(tag) + " parts nothing from nothing on its level",
                                      {tag});
            }
            const Index surface =
                over == spans[e].end() ? no_index : static_cast<Index>(body_.caps.size() + over->side);
            const std::vector<Index>& nodes = plane_.edges[e];
            for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
                add_quad({nodes_(nodes[i], layer), nodes_(nodes[i + 1], layer), nodes_(nodes[i + 1], layer + 1),
                          nodes_(nodes[i], layer + 1)},
                         left == no_index, surface, left == no_index ? right : left);
            }
        }
    }
}

}  // namespace detail

}  // namespace pavior
