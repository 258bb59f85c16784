#pragma once
/// \file
/// Distances that the lattice of a submapped solid must keep: between faces, and within a face between its edges.

#include <pavior/core/compiled.hpp>
#include <pavior/core/error.hpp>
#include <pavior/intervals/interval_system.hpp>
#include <pavior/lattice/signed_axis.hpp>
#include <pavior/lattice/submap_topology.hpp>
#include <pavior/submap/submap_unknowns.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace pavior {

namespace detail {

/// The outline of a side across an axis, in lengths, for overlaps.
struct SideOutline {
    std::vector<std::vector<Vec2>> loops;
    Vec2 low, high;
    std::array<std::vector<double>, 2> cuts;  ///< sorted coordinates of the vertices

    [[nodiscard]] bool contains(const Vec2& p) const;
    /// Whether the outlines have common inner points, after growing the boxes by \p margin if that is positive.
    [[nodiscard]] bool meets(const SideOutline& other, double margin) const;
};

/// Finds faces of a solid, and edges of a face, that look at each other, through the material or across a gap, and lie
/// closer than one element on the lattice.
template <brep B>
class SubmapDistances {
public:
    SubmapDistances(const B& b, const SubmapModel& model, std::span<const SolidUnknowns> solids)
        : b_(b), model_(model), solids_(solids) {}

    /// Rules for what is too close with \p numbers (of the interval system). With \p margin > 0 also for what would
    /// look at each other if it were larger by the margin.
    [[nodiscard]] std::vector<IntervalRule> rules(const std::vector<int>& numbers, double margin) const {
        std::vector<IntervalRule> result;
        for (std::size_t s = 0; s < solids_.size(); ++s) {
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const auto met = [&](const Item& a, const Item& c) {
                    return outline(s, a.side, axis).meets(outline(s, c.side, axis), margin);
                };
                compare(s, axis, sides_across(s, axis), numbers, met, result);
                for (std::size_t f = 0; f < model_.solids[s].sides.size(); ++f) {
                    compare(
                        s, axis, uses_across(s, f, axis), numbers,
                        [&](const Item& a, const Item& c) {
                            const double common = std::min(a.to, c.to) - std::max(a.from, c.from);
                            return common > (margin > 0.0 ? -margin : 1e-6 * (a.to - a.from + c.to - c.from));
                        },
                        result);
                }
            }
        }
        return result;
    }

private:
    /// A face or an edge across an axis.
    struct Item {
        std::size_t side = 0, vertex = 0;
        int sign = 1;        ///< of the outward direction
        double place = 0.0;  ///< mean height along the axis
        int tag = 0;
        bool edge = false;
        double from = 0.0, to = 0.0;  ///< of an edge: its extent
    };

    [[nodiscard]] const LogicalFace& face(std::size_t s, std::size_t side) const {
        return model_.faces[model_.solids[s].sides[side].face.face.index()];
    }
    [[nodiscard]] std::size_t start(std::size_t s, OrientedEdge use) const {
        return solids_[s].index.at(b_.edge_vertices(use.edge)[use.forward ? 0 : 1]);
    }
    [[nodiscard]] std::size_t end(std::size_t s, OrientedEdge use) const { return start(s, {use.edge, !use.forward}); }

    [[nodiscard]] std::vector<Item> sides_across(std::size_t s, std::size_t axis) const {
        std::vector<Item> result;
        for (std::size_t f = 0; f < model_.solids[s].sides.size(); ++f) {
            const LogicalSide& side = model_.solids[s].sides[f];
            if (side.outward().axis() != axis) {
                continue;
            }
            double sum = 0.0, count = 0.0;
            for (const LogicalLoop& loop : face(s, f).loops) {
                for (const OrientedEdge use : loop.uses) {
                    sum += solids_[s].length[axis][start(s, use)];
                    count += 1.0;
                }
            }
            result.push_back({f, start(s, face(s, f).loops[0].uses[0]), side.outward().sign(), sum / count,
                              b_.tag(2, side.face.face.index())});
        }
        return result;
    }

    /// The uses of a face that run across an axis of the face.
    [[nodiscard]] std::vector<Item> uses_across(std::size_t s, std::size_t f, std::size_t axis) const {
        std::vector<Item> result;
        const LogicalSide& side = model_.solids[s].sides[f];
        if (side.outward().axis() == axis) {
            return result;
        }
        for (const LogicalLoop& loop : face(s, f).loops) {
            for (std::size_t i = 0; i < loop.uses.size(); ++i) {
                const SignedAxis outward = -side.direction((loop.heading[i] + 1) % 4);
                if (outward.axis() != axis) {
                    continue;
                }
                const std::size_t along = side.direction(loop.heading[i]).axis();
                const std::size_t v = start(s, loop.uses[i]), w = end(s, loop.uses[i]);
                const auto [from, to] = std::minmax(solids_[s].length[along][v], solids_[s].length[along][w]);
                result.push_back({f, v, outward.sign(), 0.5 * (solids_[s].length[axis][v] + solids_[s].length[axis][w]),
                                  b_.tag(1, loop.uses[i].edge.index()), true, from, to});
            }
        }
        return result;
    }

    template <class Met>
    void compare(std::size_t s, std::size_t axis, const std::vector<Item>& items, const std::vector<int>& numbers,
                 const Met& met, std::vector<IntervalRule>& result) const {
        const std::vector<IntervalSum>& x = solids_[s].coordinate[axis];
        std::vector<int> at;
        for (const Item& item : items) {
            at.push_back(value(x[item.vertex], numbers));
        }
        for (std::size_t i = 0; i < items.size(); ++i) {
            for (std::size_t j = 0; j < items.size(); ++j) {
                if (items[i].sign < 0 || items[j].sign > 0) {
                    continue;
                }
                // In one place: faces see a gap between them, and so must their edges in a face that both stand on.
                const double way = items[i].place - items[j].place;
                const bool solid_between = way == 0 ? items[i].edge : way > 0;
                const std::size_t low = solid_between ? j : i, high = solid_between ? i : j;
                if (at[high] - at[low] < 1 && met(items[low], items[high])) {
                    const IntervalSum sum = difference(x[items[high].vertex], x[items[low].vertex]);
                    result.push_back({IntervalRule::Kind::at_least,
                                      {sum.begin(), sum.end()},
                                      1,
                                      text(s, items[low], items[high]),
                                      tags(s, items[low], items[high])});
                }
            }
        }
    }

    [[nodiscard]] int face_tag(std::size_t s, const Item& item) const {
        return b_.tag(2, model_.solids[s].sides[item.side].face.face.index());
    }
    [[nodiscard]] std::string text(std::size_t s, const Item& a, const Item& c) const {
        return (a.edge ? "edges " : "faces ") + std::to_string(a.tag) + " and " + std::to_string(c.tag) +
               (a.edge ? " of face " + std::to_string(face_tag(s, a)) : "") + " lie at least one element apart";
    }
    [[nodiscard]] std::vector<int> tags(std::size_t s, const Item& a, const Item& c) const {
        return a.edge ? std::vector<int>{face_tag(s, a)} : std::vector<int>{a.tag, c.tag};
    }

    [[nodiscard]] SideOutline outline(std::size_t s, std::size_t side, std::size_t axis) const {
        SideOutline result;
        for (const LogicalLoop& loop : face(s, side).loops) {
            std::vector<Vec2> points;
            for (const OrientedEdge use : loop.uses) {
                const std::size_t v = start(s, use);
                points.emplace_back(solids_[s].length[(axis + 1) % 3][v], solids_[s].length[(axis + 2) % 3][v]);
            }
            for (const Vec2& p : points) {
                const bool first = result.cuts[0].empty();
                result.low = first ? p : Vec2(result.low.cwiseMin(p));
                result.high = first ? p : Vec2(result.high.cwiseMax(p));
                result.cuts[0].push_back(p[0]);
                result.cuts[1].push_back(p[1]);
            }
            result.loops.push_back(std::move(points));
        }
        std::sort(result.cuts[0].begin(), result.cuts[0].end());
        std::sort(result.cuts[1].begin(), result.cuts[1].end());
        return result;
    }

    const B& b_;
    const SubmapModel& model_;
    std::span<const SolidUnknowns> solids_;
};

}  // namespace detail

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/submap/submap_distances-inl.hpp>
#endif
