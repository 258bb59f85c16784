#pragma once
/// \file
/// The rules that sweeps put on the numbers of intervals of a model's edges.

#include <pavior/brep/all_tags.hpp>
#include <pavior/brep/face_corners.hpp>
#include <pavior/core/error.hpp>
#include <pavior/intervals/integer_program.hpp>
#include <pavior/intervals/interval_system.hpp>
#include <pavior/one_to_one/layer_path.hpp>
#include <pavior/one_to_one/sweep_topology.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace pavior {

/// Lengths are in the model's unit. Tags are the numbers by which users know the entities (brep::tag).
struct IntervalOptions {
    double size = 0.0;                  ///< wished length of a mesh edge; must be given (> 0)
    std::map<int, double> edge_size;    ///< by edge tag; goes before everything else
    std::map<int, double> face_size;    ///< by face tag; for its edges, the smallest of the faces at an edge
    std::map<int, double> solid_size;   ///< by solid tag; where no face size applies, the smallest of the solids
    std::map<int, int> edge_intervals;  ///< by edge tag: exactly this many
    std::optional<int> layers;          ///< exactly this many layers in every solid
    std::map<int, int> solid_layers;    ///< by solid tag; goes before `layers`
    double max_angle = 30.0;            ///< an edge turns by at most this from one interval to the next, degrees;
                                        ///< given up where prescribed numbers leave no other way
    int min_loop = 4;                   ///< intervals of a loop of a cap, at least
};

namespace detail {

/// Builds the interval system of some sweeps of one model.
template <brep B>
class IntervalBuilder {
public:
    /// \p more: further solids whose edges are to be divided; their rules are added by others.
    IntervalBuilder(const B& b, std::span<const SweepTopology> sweeps, const IntervalOptions& options,
                    std::span<const SolidId> more = {})
        : b_(b), options_(options), index_(b.edge_count(), no_position) {
        check_options();
        for (const SolidId solid : more) {
            add_edges(solid);
        }
        for (const SweepTopology& sweep : sweeps) {
            add_edges(sweep.solid);
        }
        set_wishes();
        for (const SweepTopology& sweep : sweeps) {
            add_sides(sweep);
            add_layers(sweep);
            add_loops(sweep);
        }
        add_prescribed();
    }

    [[nodiscard]] IntervalSystem& system() { return system_; }
    [[nodiscard]] const IntervalSystem& system() const { return system_; }
    [[nodiscard]] const std::vector<EdgeId>& edges() const { return edges_; }
    /// Position of an edge in edges() and in the system.
    [[nodiscard]] std::size_t position(EdgeId e) const { return index_[e.index()]; }

private:
    using Terms = std::vector<std::pair<std::size_t, int>>;

    [[nodiscard]] int face_tag(FaceId f) const { return b_.tag(2, f.index()); }
    [[nodiscard]] int edge_tag(EdgeId e) const { return b_.tag(1, e.index()); }

    static void check_size(double size, const std::string& what) {
        if (!(size > 0.0) || !std::isfinite(size)) {
            throw InputError(ErrorCode::bad_option, "the size " + what + " must be positive");
        }
    }

    void check_options() const {
        check_size(options_.size, "of mesh edges");
        for (const auto* sizes : {&options_.edge_size, &options_.face_size, &options_.solid_size}) {
            for (const auto& [tag, size] : *sizes) {
                check_size(size, "given for entity " + std::to_string(tag));
            }
        }
        const auto positive = [](int n) {
            if (n < 1) {
                throw InputError(ErrorCode::bad_option, "a prescribed number of intervals or layers must be positive");
            }
        };
        positive(options_.layers.value_or(1));
        for (const auto* numbers : {&options_.edge_intervals, &options_.solid_layers}) {
            for (const auto& [tag, n] : *numbers) {
                positive(n);
            }
        }
        if (!(options_.max_angle > 0.0)) {
            throw InputError(ErrorCode::bad_option, "max_angle must be positive");
        }
    }

    /// Registers the edges of a solid and the sizes that its entities ask for.
    void add_edges(SolidId solid) {
        const std::optional<double> solid_size = size_by_tag(b_, 3, solid.index(), options_.solid_size);
        for (const OrientedFace& f : b_.solid_faces(solid)) {
            const std::optional<double> face_size = size_by_tag(b_, 2, f.face.index(), options_.face_size);
            for (const EdgeLoop& loop : b_.face_loops(f.face)) {
                for (const OrientedEdge& use : loop) {
                    const std::size_t at = add_edge(use.edge);
                    from_faces_[at] = std::min(from_faces_[at], face_size.value_or(no_bound));
                    from_solids_[at] = std::min(from_solids_[at], solid_size.value_or(no_bound));
                }
            }
        }
    }

    std::size_t add_edge(EdgeId e) {
        std::size_t& at = index_[e.index()];
        if (at == no_position) {
            at = edges_.size();
            edges_.push_back(e);
            from_faces_.push_back(no_bound);
            from_solids_.push_back(no_bound);
        }
        return at;
    }

    void set_wishes() {
        for (std::size_t i = 0; i < edges_.size(); ++i) {
            double size = std::isfinite(from_faces_[i])    ? from_faces_[i]
                          : std::isfinite(from_solids_[i]) ? from_solids_[i]
                                                           : options_.size;
            size = size_by_tag(b_, 1, edges_[i].index(), options_.edge_size).value_or(size);
            const double bends = edge_turning(b_, edges_[i]) / options_.max_angle;
            const double wish = std::max({1.0, b_.edge_length(edges_[i]) / size, bends});
            if (wish > 1e5) {
                throw InputError(
                    ErrorCode::bad_option,
                    "edge " + std::to_string(edge_tag(edges_[i])) + " would get more than 100000 intervals",
                    {edge_tag(edges_[i])});
            }
            system_.edges.push_back({wish, std::max(1, static_cast<int>(std::ceil(bends - 1e-3)))});
        }
    }

    void add_chain(Terms& terms, std::span<const OrientedEdge> chain, int coefficient) const {
        for (const OrientedEdge& use : chain) {
            const std::size_t edge = index_[use.edge.index()];
            const auto at = std::find_if(terms.begin(), terms.end(), [&](const auto& t) { return t.first == edge; });
            if (at == terms.end()) {
                terms.emplace_back(edge, coefficient);
            } else {
                at->second += coefficient;
            }
        }
        std::erase_if(terms, [](const auto& t) { return t.second == 0; });
    }

    [[nodiscard]] std::string name(std::span<const OrientedEdge> chain) const {
        std::string text = chain.size() == 1 ? "edge " : "edges ";
        for (std::size_t i = 0; i < chain.size(); ++i) {
            text += (i == 0 ? "" : "+") + std::to_string(edge_tag(chain[i].edge));
        }
        return text;
    }

    void add_rule(IntervalRule::Kind kind, Terms terms, int value, std::string text, std::vector<int> faces) {
        system_.rules.push_back({kind, std::move(terms), value, std::move(text), std::move(faces)});
    }

    void add_opposite(const LinkingSide& side, std::span<const OrientedEdge> a, std::span<const OrientedEdge> c) {
        Terms terms;
        add_chain(terms, a, 1);
        add_chain(terms, c, -1);
        if (!terms.empty()) {
            const int tag = face_tag(side.face);
            add_rule(IntervalRule::Kind::equal, std::move(terms), 0,
                     "opposite sides of face " + std::to_string(tag) + " are equal: " + name(a) + " = " + name(c),
                     {tag});
        }
    }

    /// Opposite logical sides of each linking side are equal, and a union of rectangles does not overlap itself.
    void add_sides(const SweepTopology& sweep) {
        for (const std::vector<LinkingSide>& sides : sweep.loops) {
            for (const LinkingSide& side : sides) {
                add_opposite(side, side.bottom, side.top);
                add_opposite(side, side.left, side.right);
                if (!side.rectangle()) {
                    add_room(side);
                }
            }
        }
    }

    /// Edges of a side with notches that face each other across it stay at least one interval apart. Which do is seen
    /// from the lengths of the edges.
    void add_room(const LinkingSide& side) {
        const auto outline = outline_of(side);
        const std::size_t n = outline.size();
        std::vector<std::array<double, 2>> place(n + 1, {0.0, 0.0});  // where each edge starts
        for (std::size_t i = 0; i < n; ++i) {
            const auto [use, role] = outline[i];
            const bool back = role == SideRole::top || role == SideRole::left;
            place[i + 1] = place[i];
            place[i + 1][axis_of(role)] += (back ? -1.0 : 1.0) * b_.edge_length(use.edge);
        }
        for (std::size_t i = 0; i < n; ++i) {
            for (std::size_t j = 0; j < n; ++j) {
                const auto [low, low_role] = outline[i];
                const auto [high, high_role] = outline[j];
                const std::size_t along = axis_of(low_role);
                const bool facing = (low_role == SideRole::bottom && high_role == SideRole::top) ||
                                    (low_role == SideRole::left && high_role == SideRole::right);
                const auto [a, c] = std::minmax(place[i][along], place[i + 1][along]);
                const auto [p, q] = std::minmax(place[j][along], place[j + 1][along]);
                const double overlap = std::min(c, q) - std::max(a, p);
                if (facing && overlap > 1e-3 * std::min(c - a, q - p) && place[j][1 - along] > place[i][1 - along]) {
                    add_distance(side.face, outline, i, j);
                }
            }
        }
    }

    [[nodiscard]] static std::size_t axis_of(SideRole role) {
        return role == SideRole::bottom || role == SideRole::top ? 0 : 1;
    }

    /// Edge \p j of the outline is beyond edge \p i, across the two, if the numbers might have it otherwise.
    void add_distance(FaceId face, std::span<const std::pair<OrientedEdge, SideRole>> outline, std::size_t i,
                      std::size_t j) {
        Terms terms;
        for (std::size_t k = (i + 1) % outline.size(); k != j; k = (k + 1) % outline.size()) {
            const auto& [use, role] = outline[k];
            if (axis_of(role) != axis_of(outline[i].second)) {
                add_chain(terms, std::span(&use, 1), role == SideRole::bottom || role == SideRole::right ? 1 : -1);
            }
        }
        if (std::any_of(terms.begin(), terms.end(), [](const auto& t) { return t.second < 0; })) {
            const int tag = face_tag(face);
            add_rule(IntervalRule::Kind::at_least, std::move(terms), 1,
                     "face " + std::to_string(tag) + " keeps room between its edges " +
                         std::to_string(edge_tag(outline[i].first.edge)) + " and " +
                         std::to_string(edge_tag(outline[j].first.edge)),
                     {tag});
        }
    }

    [[nodiscard]] std::vector<int> face_tags(const LayerPath& way) const {
        std::vector<int> tags;
        for (const FaceId f : way.faces) {
            tags.push_back(face_tag(f));
        }
        return tags;
    }

    void add_way(Terms& terms, const LayerPath& way, int sign) const {
        for (const auto& [use, rows] : way.edges) {
            add_chain(terms, std::span(&use, 1), sign * rows);
        }
    }

    /// All loops of a solid have the same number of layers, the prescribed one if there is one.
    void add_layers(const SweepTopology& sweep) {
        const int solid = b_.tag(3, sweep.solid.index());
        const auto own = options_.solid_layers.find(solid);
        const std::optional<int> wanted = own != options_.solid_layers.end() ? own->second : options_.layers;
        const LayerPath first = layer_path(b_, sweep, 0);
        for (std::size_t i = 0; i < sweep.loops.size(); ++i) {
            Terms terms;
            const LayerPath way = i == 0 ? first : layer_path(b_, sweep, i);
            std::vector<int> faces = face_tags(way);
            add_way(terms, way, 1);
            if (wanted) {
                add_rule(IntervalRule::Kind::equal, std::move(terms), *wanted,
                         "solid " + std::to_string(solid) + " has " + std::to_string(*wanted) + " layers", faces);
            } else if (i > 0) {
                add_way(terms, first, -1);
                const std::vector<int> more = face_tags(first);
                faces.insert(faces.end(), more.begin(), more.end());
                add_rule(IntervalRule::Kind::equal, std::move(terms), 0,
                         "all loops of solid " + std::to_string(solid) + " have equally many layers", faces);
            }
        }
    }

    /// Loops of the source (hence of the target) are even and not too short.
    void add_loops(const SweepTopology& sweep) {
        const int tag = face_tag(sweep.source);
        for (const EdgeLoop& loop : sweep.source_loops) {
            Terms terms;
            add_chain(terms, loop, 1);
            const std::string what = "the loop " + name(loop) + " of cap " + std::to_string(tag);
            add_rule(IntervalRule::Kind::even, terms, 0, what + " is even", {tag});
            add_rule(IntervalRule::Kind::at_least, std::move(terms), options_.min_loop,
                     what + " has at least " + std::to_string(options_.min_loop) + " intervals", {tag});
        }
    }

    void add_prescribed() {
        for (std::size_t i = 0; i < edges_.size(); ++i) {
            const int tag = edge_tag(edges_[i]);
            if (const auto n = options_.edge_intervals.find(tag); n != options_.edge_intervals.end()) {
                add_rule(IntervalRule::Kind::equal, {{i, 1}}, n->second,
                         "edge " + std::to_string(tag) + " has " + std::to_string(n->second) + " intervals", {});
            }
        }
    }

    const B& b_;
    const IntervalOptions& options_;
    std::vector<std::size_t> index_;  ///< per edge id: position in edges_
    std::vector<EdgeId> edges_;
    std::vector<double> from_faces_, from_solids_;
    IntervalSystem system_;
};

}  // namespace detail

}  // namespace pavior
