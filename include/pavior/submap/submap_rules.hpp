#pragma once
/// \file
/// The rules that submapping puts on the numbers of intervals.

#include <pavior/brep/all_tags.hpp>
#include <pavior/lattice/signed_axis.hpp>
#include <pavior/lattice/submap_topology.hpp>
#include <pavior/one_to_one/interval_rules.hpp>
#include <pavior/submap/submap_unknowns.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace pavior {

namespace detail {

/// Adds the rules of a SubmapModel to an interval system.
template <brep B>
class SubmapRules {
public:
    SubmapRules(const B& b, const SubmapModel& model, IntervalBuilder<B>& builder, const IntervalOptions& options)
        : b_(b), model_(model), builder_(builder), links_(model.faces.size()) {
        add_links(options);
        for (std::size_t f = 0; f < model.faces.size(); ++f) {
            add_face(FaceId{static_cast<std::int32_t>(f)});
        }
        for (const SubmapTopology& solid : model.solids) {
            add_solid(solid);
        }
    }

    /// Rules that give vertices of one place along an axis (within \p tolerance) one coordinate. With a finite \p gap
    /// also: coordinates never descend along an axis, and ascend from one place to the next one farther off than gap.
    [[nodiscard]] std::vector<IntervalRule> level_rules(double tolerance, double gap) const {
        std::vector<IntervalRule> result;
        EquationSpan span = span_;
        for (const SolidUnknowns& solid : solids_) {
            for (std::size_t a = 0; a < 3; ++a) {
                std::vector<std::size_t> order(solid.index.size());
                std::iota(order.begin(), order.end(), std::size_t{0});
                const std::vector<double>& x = solid.length[a];
                std::stable_sort(order.begin(), order.end(), [&](std::size_t p, std::size_t q) { return x[p] < x[q]; });
                for (std::size_t i = 1; i < order.size(); ++i) {
                    const double way = x[order[i]] - x[order[i - 1]];
                    const IntervalSum sum =
                        difference(solid.coordinate[a][order[i]], solid.coordinate[a][order[i - 1]]);
                    if (way <= tolerance && span.add(sum)) {
                        result.push_back(rule(IntervalRule::Kind::equal, sum, 0, "levels agree", {}));
                    } else if (way > tolerance && std::isfinite(gap) && EquationSpan(span).add(sum)) {
                        result.push_back(
                            rule(IntervalRule::Kind::at_least, sum, way > gap ? 1 : 0, "levels ascend", {}));
                    }
                }
            }
        }
        return result;
    }

    /// The lattice coordinates of the solids, in the order of SubmapModel::solids.
    [[nodiscard]] const std::vector<SolidUnknowns>& solids() const { return solids_; }

    /// Widths of the layers of solid \p s along axis \p a, from the mean heights of the vertices on its lattice planes;
    /// none is thinner than a tenth of the mean. \p first: coordinate of the lowest plane.
    [[nodiscard]] std::vector<double> layer_widths(std::size_t s, std::size_t a, const std::vector<int>& numbers,
                                                   int& first) const {
        std::map<int, std::pair<double, double>> planes;  // sum of heights, number of vertices
        for (std::size_t v = 0; v < solids_[s].index.size(); ++v) {
            auto& [sum, count] = planes[value(solids_[s].coordinate[a][v], numbers)];
            sum += solids_[s].length[a][v];
            count += 1.0;
        }
        first = planes.begin()->first;
        const auto height = [](const auto& plane) { return plane.second.first / plane.second.second; };
        const double mean =
            (height(*planes.rbegin()) - height(*planes.begin())) / std::max(1, planes.rbegin()->first - first);
        std::vector<double> widths;
        for (auto low = planes.begin(), high = std::next(low); high != planes.end(); low = high++) {
            const int layers = high->first - low->first;
            const double width = (height(*high) - height(*low)) / layers;
            widths.insert(widths.end(), static_cast<std::size_t>(layers), std::max(width, 0.1 * std::abs(mean)));
        }
        return widths;
    }

    /// Per edge id: where its nodes lie, as fractions of its length, so that they follow the layers of the solids.
    [[nodiscard]] std::vector<std::vector<double>> fractions(const std::vector<int>& numbers) const {
        std::vector<std::vector<double>> result(b_.edge_count());
        std::vector<double> solids(b_.edge_count(), 0.0);
        for (std::size_t s = 0; s < solids_.size(); ++s) {
            for (std::size_t a = 0; a < 3; ++a) {
                int first = 0;
                const std::vector<double> widths = layer_widths(s, a, numbers, first);
                for (const LatticeStep& step : solids_[s].steps[a]) {
                    if (step.sign != 0 && step.edge < builder_.edges().size()) {
                        add_fractions(s, a, step, numbers, widths, first, result, solids);
                    }
                }
            }
        }
        for (std::size_t e = 0; e < result.size(); ++e) {
            for (double& fraction : result[e]) {
                fraction /= solids[e];
            }
        }
        return result;
    }

    [[nodiscard]] std::vector<std::vector<std::array<int, 2>>> links(const std::vector<int>& numbers) const {
        std::vector<std::vector<std::array<int, 2>>> result(links_.size());
        for (std::size_t f = 0; f < links_.size(); ++f) {
            for (const auto& [s, t] : links_[f]) {
                result[f].push_back({numbers[s], numbers[t]});
            }
        }
        return result;
    }

private:
    [[nodiscard]] static IntervalRule rule(IntervalRule::Kind kind, const IntervalSum& sum, int value, std::string text,
                                           std::vector<int> faces) {
        return {kind, {sum.begin(), sum.end()}, value, std::move(text), std::move(faces)};
    }
    void add_links(const IntervalOptions& options) {
        for (std::size_t f = 0; f < model_.faces.size(); ++f) {
            const double size = size_by_tag(b_, 2, f, options.face_size).value_or(options.size);
            for (const LoopLink& link : model_.faces[f].links) {
                std::array<std::size_t, 2> at{};
                for (std::size_t a = 0; a < 2; ++a) {
                    at[a] = builder_.system().edges.size();
                    builder_.system().edges.push_back({std::max(1.0, link.length[a] / size), 1});
                }
                links_[f].push_back(at);
            }
        }
    }

    /// Each loop closes along both axes of the face.
    void add_face(FaceId f) {
        const int face_tag = b_.tag(2, f.index());
        const LogicalFace& face = model_.faces[f.index()];
        for (std::size_t l = 0; l < face.loops.size(); ++l) {
            for (int axis = 0; axis < 2; ++axis) {
                IntervalSum sum;
                std::array<std::string, 2> text;
                for (std::size_t i = 0; i < face.loops[l].uses.size(); ++i) {
                    const int heading = face.loops[l].heading[i];
                    if (heading % 2 == axis) {
                        const EdgeId e = face.loops[l].uses[i].edge;
                        sum[builder_.position(e)] += heading < 2 ? 1 : -1;
                        std::string& side = text[heading < 2 ? 0 : 1];
                        side += (side.empty() ? "" : "+") + std::to_string(b_.tag(1, e.index()));
                    }
                }
                std::erase_if(sum, [](const auto& term) { return term.second == 0; });
                if (span_.add(sum)) {
                    add(rule(IntervalRule::Kind::equal, sum, 0,
                             "opposite sides of face " + std::to_string(face_tag) + " are equal: edges " + text[0] +
                                 " = " + text[1],
                             {face_tag}));
                }
            }
        }
    }

    void add_fractions(std::size_t s, std::size_t a, const LatticeStep& step, const std::vector<int>& numbers,
                       const std::vector<double>& widths, int first, std::vector<std::vector<double>>& result,
                       std::vector<double>& solids) const {
        const EdgeId e = builder_.edges()[step.edge];
        const bool along =
            solids_[s].index.at(b_.edge_vertices(e)[0]) == step.from;  // step.from is where the edge starts
        const int n = numbers[step.edge];
        const int from = value(solids_[s].coordinate[a][step.from], numbers) - first;
        const int low = step.sign > 0 ? from : from - n;
        std::vector<double> at{0.0};
        for (int k = 0; k < n; ++k) {
            const bool upward = along == (step.sign > 0);
            at.push_back(at.back() + widths[static_cast<std::size_t>(low + (upward ? k : n - 1 - k))]);
        }
        std::vector<double>& sum = result[e.index()];
        sum.resize(at.size(), 0.0);
        solids[e.index()] += 1.0;
        for (std::size_t k = 0; k < at.size(); ++k) {
            sum[k] += at[k] / at.back();
        }
    }

    void add(IntervalRule rule) { builder_.system().rules.push_back(std::move(rule)); }

    /// Calls visit(use, direction) for every edge of a solid, once.
    template <class Visit>
    void for_each_edge(const SubmapTopology& solid, Visit&& visit) const {
        std::set<EdgeId> seen;
        for (const LogicalSide& side : solid.sides) {
            for (const LogicalLoop& loop : model_.faces[side.face.face.index()].loops) {
                for (std::size_t i = 0; i < loop.uses.size(); ++i) {
                    if (seen.insert(loop.uses[i].edge).second) {
                        visit(loop.uses[i], side.direction(loop.heading[i]));
                    }
                }
            }
        }
    }

    [[nodiscard]] Vec3 chord(OrientedEdge use) const {
        const auto ends = b_.edge_vertices(use.edge);
        return (use.forward ? 1.0 : -1.0) * (b_.vertex_point(ends[1]) - b_.vertex_point(ends[0]));
    }

    /// Directions in space of the axes of a solid, if each of its edges leads along its own, within 60 degrees.
    [[nodiscard]] std::optional<std::array<Vec3, 3>> straight_axes(const SubmapTopology& solid) const {
        std::array<Vec3, 3> axes{Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
        for_each_edge(solid, [&](OrientedEdge use, SignedAxis d) { axes[d.axis()] += d.sign() * chord(use); });
        for (Vec3& axis : axes) {
            axis.normalize();
        }
        bool straight = true;
        for_each_edge(solid, [&](OrientedEdge use, SignedAxis d) {
            const Vec3 way = chord(use);
            straight = straight && d.sign() * way.dot(axes[d.axis()]) > 0.5 * way.norm();
        });
        return straight ? std::optional(axes) : std::nullopt;
    }

    void add_solid(const SubmapTopology& solid) {
        SolidUnknowns unknowns;
        for_each_edge(solid, [&](OrientedEdge use, SignedAxis d) { add_edge_steps(unknowns, use, d); });
        std::vector<int> holed;
        for (const LogicalSide& side : solid.sides) {
            if (!model_.faces[side.face.face.index()].links.empty()) {
                holed.push_back(b_.tag(2, side.face.face.index()));
            }
        }
        for (const LogicalSide& side : solid.sides) {
            add_link_steps(unknowns, side);
        }
        unknowns.resolve();
        const auto axes = model_.as_in_space ? straight_axes(solid) : std::nullopt;
        if (axes) {
            for (const auto& [v, i] : unknowns.index) {
                for (std::size_t a = 0; a < 3; ++a) {
                    unknowns.length[a][i] = b_.vertex_point(v).dot((*axes)[a]);
                }
            }
        }
        for (std::size_t a = 0; a < 3; ++a) {
            for (const std::size_t i : unknowns.closing[a]) {
                const LatticeStep& step = unknowns.steps[a][i];
                IntervalSum sum = difference(unknowns.coordinate[a][step.to], unknowns.coordinate[a][step.from]);
                if (step.sign != 0) {
                    sum = difference(std::move(sum), {{step.edge, step.sign}});
                }
                if (span_.add(sum)) {
                    add(rule(IntervalRule::Kind::equal, sum, 0, cycle_text(solid, holed), holed));
                }
            }
        }
        solids_.push_back(std::move(unknowns));
    }

    [[nodiscard]] std::string cycle_text(const SubmapTopology& solid, const std::vector<int>& holed) const {
        std::string text = "the ways round and through the holes of solid " +
                           std::to_string(b_.tag(3, solid.solid.index())) + " agree";
        for (std::size_t i = 0; i < holed.size(); ++i) {
            text += (i == 0 ? " (faces " : ", ") + std::to_string(holed[i]);
        }
        return text + (holed.empty() ? "" : ")");
    }

    void add_edge_steps(SolidUnknowns& unknowns, OrientedEdge use, SignedAxis direction) {
        const auto ends = b_.edge_vertices(use.edge);
        const std::size_t from = unknowns.vertex(ends[use.forward ? 0 : 1]);
        const std::size_t to = unknowns.vertex(ends[use.forward ? 1 : 0]);
        for (std::size_t a = 0; a < 3; ++a) {
            const int sign = a == direction.axis() ? direction.sign() : 0;
            unknowns.steps[a].push_back({from, to, sign, builder_.position(use.edge), sign * b_.edge_length(use.edge)});
        }
    }

    void add_link_steps(SolidUnknowns& unknowns, const LogicalSide& side) {
        const LogicalFace& face = model_.faces[side.face.face.index()];
        const auto start = [&](std::size_t l, std::size_t i) {
            const OrientedEdge use = face.loops[l].uses[i];
            return unknowns.vertex(b_.edge_vertices(use.edge)[use.forward ? 0 : 1]);
        };
        for (std::size_t l = 0; l < face.links.size(); ++l) {
            for (std::size_t a = 0; a < 2; ++a) {
                const SignedAxis d = a == 0 ? side.s : side.t;
                unknowns.steps[d.axis()].push_back({start(0, face.links[l].anchor[a]), start(l + 1, 0), d.sign(),
                                                    links_[side.face.face.index()][l][a],
                                                    d.sign() * face.links[l].length[a]});
            }
            unknowns.steps[side.outward().axis()].push_back({start(0, 0), start(l + 1, 0), 0, 0, 0.0});
        }
    }

    const B& b_;
    const SubmapModel& model_;
    IntervalBuilder<B>& builder_;
    std::vector<std::vector<std::array<std::size_t, 2>>> links_;  ///< by face id, per link: positions in the system
    std::vector<SolidUnknowns> solids_;
    EquationSpan span_;
};

}  // namespace detail

}  // namespace pavior
