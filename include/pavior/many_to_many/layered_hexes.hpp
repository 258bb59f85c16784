#pragma once
/// \file
/// Hexahedra in columns over the quads of an arrangement: layer by layer between the levels of the caps.

#include <pavior/core/error.hpp>
#include <pavior/many_to_many/column_heights.hpp>
#include <pavior/many_to_many/level_program.hpp>
#include <pavior/many_to_many/plane_mesh.hpp>
#include <pavior/mesh/span_mesh.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace pavior {

/// Hexahedra of a body with their entities. Nodes are numbered level by level in the order of the plane mesh,
/// hexahedra layer by layer in the order of its quads.
struct LayeredHexes {
    HexMesh mesh;
    std::vector<Index> hex_solid;
    std::vector<QuadCorners> quads;   ///< of caps and sides, seen from outside of the solid quad_solid
    std::vector<Index> quad_surface;  ///< cap, or number of caps + side; no_index: a side that the body does not name
    std::vector<Index> quad_solid;  ///< the solid behind; between two solids the one below, or on the left of the edge
};

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

/// The solid over each cell between each level and the next, no_index: none.
class LayerSolids {
public:
    LayerSolids(const ExtrudedBody& body, const std::vector<CapsOverCell>& stacks, const CapLevels& levels)
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
    [[nodiscard]] std::size_t layers() const { return layers_; }
    [[nodiscard]] Index operator()(Index cell, std::size_t layer) const {
        return cell == no_index ? no_index : solid_[cell * layers_ + layer];
    }

private:
    std::size_t layers_;
    std::vector<Index> solid_;
};

/// Makes the nodes, hexahedra and boundary quads; their places are another matter.
class LayeredHexBuilder {
public:
    LayeredHexBuilder(const ExtrudedBody& body, const PlaneArrangement& arrangement, const PlaneMesh& plane,
                      const std::vector<CapsOverCell>& stacks, const CapLevels& levels)
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

    [[nodiscard]] const ColumnNodes& nodes() const { return nodes_; }
    [[nodiscard]] const LayerSolids& solids() const { return solids_; }
    [[nodiscard]] LayeredHexes& result() { return result_; }

private:
    template <class Visit>
    void for_quads(Index cell, Visit&& visit) const {
        for (std::size_t q = plane_.cell_quads[cell]; q < plane_.cell_quads[cell + 1]; ++q) {
            visit(plane_.quads[q]);
        }
    }

    void number_nodes() {
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

    void add_hexes() {
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

    void add_quad(QuadCorners quad, bool flip, Index surface, Index solid) {
        if (flip) {
            std::swap(quad[1], quad[3]);
        }
        result_.quads.push_back(quad);
        result_.quad_surface.push_back(surface);
        result_.quad_solid.push_back(solid);
    }

    void add_caps() {
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
                    add_quad({nodes_(q[0], level), nodes_(q[1], level), nodes_(q[2], level), nodes_(q[3], level)}, down,
                             c, down ? body_.caps[c].above : body_.caps[c].below);
                });
            }
        }
    }

    void add_sides() {
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

    const ExtrudedBody& body_;
    const PlaneArrangement& arrangement_;
    const PlaneMesh& plane_;
    const std::vector<CapsOverCell>& stacks_;
    const CapLevels& levels_;
    LayerSolids solids_;
    ColumnNodes nodes_;
    LayeredHexes result_;
};

}  // namespace detail

}  // namespace pavior
