#pragma once

#include <pavior/core/disjoint_sets.hpp>
#include <pavior/core/error.hpp>
#include <pavior/math/hexahedron.hpp>
#include <pavior/mesh/boundary_quads.hpp>
#include <pavior/mesh/edge_table.hpp>
#include <pavior/mesh/face_table.hpp>
#include <pavior/smooth/pillow.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <tuple>

namespace pavior {

namespace detail {

/// Face f of the hexahedron in slot s has the number 6 s + f, its corner c the number 8 s + c.
constexpr Index no_face = no_index;

/// One layer. Hexahedra that touch a chosen quad stand in slots; arrays are by slot, face and corner.
class Pillower {
public:
    Pillower(HexMeshData& data, std::span<const std::size_t> chosen, const PillowOptions& options)
        : data_(data), options_(options), x_(data.mesh.nodes), chosen_quad_(data.quads.size(), 0) {
        for (const std::size_t q : chosen) {
            if (q >= data.quads.size()) {
                throw InputError(ErrorCode::bad_index, "there is no quad " + std::to_string(q),
                                 {static_cast<std::int64_t>(q)});
            }
            chosen_quad_[q] = 1;
        }
    }

    PillowReport run() {
        find_slots();
        join_faces();
        choose_faces();
        find_doubles();
        walk_edges();
        check_rims();
        if (report_.ok()) {
            way_ = ways(false);
        }
        if (report_.ok()) {
            place();
            write();
        }
        std::sort(report_.fault_nodes.begin(), report_.fault_nodes.end());
        const auto last = std::unique(report_.fault_nodes.begin(), report_.fault_nodes.end());
        report_.fault_nodes.erase(last, report_.fault_nodes.end());
        report_.fault_nodes.resize(std::min<std::size_t>(report_.fault_nodes.size(), 16));
        return std::move(report_);
    }

private:
    /// A quad beside chosen ones, on which a double has to lie: what it is part of.
    using Label = std::array<std::int64_t, 3>;
    /// Where the hexahedra under an edge of a chosen quad end.
    struct Side {
        Index end = no_face;              ///< the chosen face, or that of the boundary
        std::vector<std::size_t> listed;  ///< quads in between, and at the end, that end on the edge
    };

    [[nodiscard]] const HexCorners& corners(Index slot) const { return data_.mesh.hexes[slots_[slot]]; }
    [[nodiscard]] QuadCorners face(Index f) const { return hex_face(corners(f / 6), f % 6); }
    [[nodiscard]] std::int32_t group(Index slot) const {
        return data_.hex_groups.empty() ? 0 : data_.hex_groups[slots_[slot]];
    }
    [[nodiscard]] bool taken(Index slot) const { return options_.shrink.empty() || options_.shrink[slots_[slot]] != 0; }
    [[nodiscard]] std::size_t local(Index slot, Index node) const {
        const HexCorners& c = corners(slot);
        return static_cast<std::size_t>(std::find(c.begin(), c.end(), node) - c.begin());
    }
    /// The node that takes the place of \p node in the hexahedron: its double, or itself.
    [[nodiscard]] Index twin(Index slot, Index node) const {
        const Index found = twin_[8 * slot + local(slot, node)];
        return found == no_index ? node : found;
    }
    void fault(PillowFault kind, std::initializer_list<Index> nodes) {
        if (report_.ok() || report_.fault == kind) {
            report_.fault = kind;
            report_.fault_nodes.insert(report_.fault_nodes.end(), nodes);
        }
    }

    void find_slots() {
        touched_.assign(x_.size(), 0);
        for (std::size_t q = 0; q < data_.quads.size(); ++q) {
            for (const Index i : data_.quads[q]) {
                if (i >= x_.size()) {
                    throw InputError(ErrorCode::bad_index, "there is no node " + std::to_string(i), {i});
                }
                touched_[i] = chosen_quad_[q] != 0 ? 1 : touched_[i];
            }
        }
        for (const Index h : IndexRange(data_.mesh.hexes.size())) {
            const HexCorners& c = data_.mesh.hexes[h];
            if (std::any_of(c.begin(), c.end(), [&](Index i) { return touched_[i] != 0; })) {
                slots_.push_back(h);
            }
        }
    }

    /// The other hexahedron on each face that touches a chosen quad.
    void join_faces() {
        std::vector<std::pair<QuadCorners, Index>> rows;
        for (const Index f : IndexRange(6 * slots_.size())) {
            QuadCorners c = face(f);
            if (std::any_of(c.begin(), c.end(), [&](Index i) { return touched_[i] != 0; })) {
                std::sort(c.begin(), c.end());
                rows.emplace_back(c, f);
            }
        }
        std::sort(rows.begin(), rows.end());
        partner_.assign(6 * slots_.size(), no_face);
        for (std::size_t i = 0; i + 1 < rows.size(); ++i) {
            if (rows[i].first != rows[i + 1].first) {
                continue;
            }
            const QuadCorners& c = rows[i].first;
            if (i + 2 < rows.size() && rows[i + 2].first == c) {
                throw InputError(ErrorCode::non_manifold, "a quad of more than two hexahedra",
                                 {c[0], c[1], c[2], c[3]});
            }
            if (!opposite(face(rows[i].second), face(rows[i + 1].second))) {
                throw InputError(ErrorCode::bad_orientation, "two hexahedra see a quad from one side",
                                 {c[0], c[1], c[2], c[3]});
            }
            partner_[rows[i].second] = rows[i + 1].second;
            partner_[rows[i + 1].second] = rows[i].second;
        }
    }

    void choose_faces() {
        const QuadTable table(data_.quads);
        listed_.assign(6 * slots_.size(), {});
        is_chosen_.assign(6 * slots_.size(), 0);
        on_.assign(data_.quads.size(), no_face);
        for (const Index f : IndexRange(6 * slots_.size())) {
            if (!taken(f / 6)) {
                continue;
            }
            table.for_each(face(f), [&](std::size_t q) {
                listed_[f].push_back(q);
                on_[q] = on_[q] == no_face ? f : on_[q];
            });
        }
        for (std::size_t q = 0; q < data_.quads.size(); ++q) {
            if (chosen_quad_[q] == 0) {
                continue;
            }
            const Index f = on_[q];
            if (f == no_face || (partner_[f] != no_face && taken(partner_[f] / 6))) {
                throw InputError(ErrorCode::bad_index,
                                 "quad " + std::to_string(q) + " is not on the boundary of the set of hexahedra",
                                 {static_cast<std::int64_t>(q)});
            }
            if (is_chosen_[f] == 0) {
                is_chosen_[f] = 1;
                chosen_.push_back(f);
            }
        }
    }

    /// Numbers the doubles: one a node and set of hexahedra that hang together at it by quads.
    void find_doubles() {
        DisjointSets<> sets(8 * slots_.size());
        for (const Index f : IndexRange(6 * slots_.size())) {
            const Index other = partner_[f];
            if (other == no_face || other < f || !taken(f / 6) || !taken(other / 6)) {
                continue;
            }
            for (const Index i : face(f)) {
                sets.unite(static_cast<Index>(8 * (f / 6) + local(f / 6, i)),
                           static_cast<Index>(8 * (other / 6) + local(other / 6, i)));
            }
        }
        std::vector<std::pair<Index, Index>> roots;  // by node
        for (const Index f : chosen_) {
            for (const Index i : face(f)) {
                roots.emplace_back(i, sets.root(static_cast<Index>(8 * (f / 6) + local(f / 6, i))));
            }
        }
        std::sort(roots.begin(), roots.end());
        roots.erase(std::unique(roots.begin(), roots.end()), roots.end());
        std::vector<Index> of_root(8 * slots_.size(), no_index);
        for (const auto& [node, root] : roots) {
            of_root[root] = static_cast<Index>(x_.size() + report_.node_from.size());
            report_.node_from.push_back(node);
        }
        twin_.resize(8 * slots_.size());
        for (const Index c : IndexRange(twin_.size())) {
            twin_[c] = of_root[sets.root(c)];
            if (twin_[c] != no_index) {
                corners_of_.emplace_back(twin_[c], c);
            }
        }
        std::sort(corners_of_.begin(), corners_of_.end());
    }

    /// The other face at the edge of a face of one hexahedron.
    [[nodiscard]] Index across(Index f, Index a, Index b) const {
        for (const Index g : IndexRange(6 * (f / 6), 6 * (f / 6) + 6)) {
            const QuadCorners c = face(g);
            if (g != f && std::find(c.begin(), c.end(), a) != c.end() && std::find(c.begin(), c.end(), b) != c.end()) {
                return g;
            }
        }
        return no_face;
    }

    /// From a chosen face round one of its edges, through the hexahedra of the set.
    [[nodiscard]] Side walk(Index from, Index a, Index b) {
        Side side;
        std::size_t changes = 0;
        for (Index f = from;;) {
            const Index g = across(f, a, b);
            side.end = g;
            if (is_chosen_[g] != 0) {
                break;
            }
            side.listed.insert(side.listed.end(), listed_[g].begin(), listed_[g].end());
            f = partner_[g];
            if (f == no_face) {
                break;
            }
            if (!taken(f / 6)) {
                fault(PillowFault::open_rim, {a, b});
                break;
            }
            changes += group(f / 6) != group(g / 6) ? 1 : 0;
        }
        if (changes > (is_chosen_[side.end] != 0 ? 1U : 0U)) {
            fault(PillowFault::foreign_rim, {a, b});
        }
        return side;
    }

    /// Finds strips and rims at the edges of chosen quads.
    void walk_edges() {
        std::vector<std::pair<std::array<Index, 2>, std::array<Index, 2>>> sides;  // by doubles
        for (const Index f : chosen_) {
            const QuadCorners c = face(f);
            for (std::size_t k = 0; k < 4; ++k) {
                const Index a = c[k], b = c[(k + 1) % 4];
                const std::array<Index, 2> in{twin(f / 6, a), twin(f / 6, b)};
                chosen_edges_.insert(chosen_edges_.end(), {{in[0], b}, {in[1], a}});
                Side side = walk(f, a, b);
                const bool rim = is_chosen_[side.end] == 0;
                if (rim) {
                    rims_.insert(rims_.end(), in.begin(), in.end());
                } else if (side.end < f) {
                    continue;  // seen from the other quad
                }
                sides.push_back({{std::min(in[0], in[1]), std::max(in[0], in[1])}, {a, b}});
                for (const std::size_t q : side.listed) {
                    const bool along = runs_along(data_.quads[q], a, b);
                    strips_.push_back(along ? QuadCorners{a, b, in[1], in[0]} : QuadCorners{b, a, in[0], in[1]});
                    report_.quad_from.push_back(q);
                }
            }
        }
        std::sort(chosen_edges_.begin(), chosen_edges_.end());
        std::sort(sides.begin(), sides.end());
        for (std::size_t i = 0; i + 1 < sides.size(); ++i) {
            if (sides[i].first == sides[i + 1].first) {
                fault(PillowFault::pinched, {sides[i].second[0], sides[i].second[1]});
            }
        }
    }

    /// Every node of the layer is inside it or has two edges of the rim; and the set ends there as the layer does.
    void check_rims() {
        std::sort(rims_.begin(), rims_.end());
        for (std::size_t i = 0, end = 0; i < rims_.size(); i = end) {
            for (end = i; end < rims_.size() && rims_[end] == rims_[i]; ++end) {
            }
            if (end - i != 2) {
                fault(PillowFault::pinched, {report_.node_from[rims_[i] - x_.size()]});
            }
        }
        for (const auto& [twin, corner] : corners_of_) {
            const Index slot = corner / 8, node = corners(slot)[corner % 8];
            for (const Index f : IndexRange(6 * slot, 6 * slot + 6)) {
                const QuadCorners c = face(f);
                if (is_chosen_[f] == 0 && partner_[f] != no_face && !taken(partner_[f] / 6) &&
                    std::find(c.begin(), c.end(), node) != c.end()) {
                    fault(PillowFault::open_rim, {node});
                }
            }
        }
    }

    /// The label of a face that holds its nodes; nothing for those inside.
    [[nodiscard]] bool label_of(Index f, Label& label) const {
        const Index other = partner_[f];
        const std::int64_t here = group(f / 6), there = other == no_face ? here : group(other / 6);
        if (!listed_[f].empty()) {
            label = {0, data_.quad_groups.empty() ? 0 : data_.quad_groups[listed_[f][0]], 0};
        } else {
            label = {1, std::min(here, there), std::max(here, there)};
        }
        return !listed_[f].empty() || other == no_face || here != there;
    }

    /// How far inward a double lies from its node: a part of the way to \p to.
    [[nodiscard]] Vec3 part_of_way(Index slot, Index node, Index to) const {
        const Vec3 way = x_[to] - x_[node];
        return even_ ? Vec3(way.normalized()) : Vec3((twin(slot, to) == to ? 1.0 : 0.5) * options_.fraction * way);
    }
    /// The same across a cell between chosen quads, less far if the edges \p ends meet at more than 90 degrees.
    [[nodiscard]] Vec3 part_across(Index slot, Index node, Index to, std::span<const Index> ends) const {
        double least = 0;
        Vec3 between = Vec3::Zero();
        for (std::size_t i = 0; i < ends.size(); ++i) {
            between += (x_[ends[i]] - x_[node]).normalized();
            for (std::size_t j = i + 1; j < ends.size(); ++j) {
                least =
                    std::min(least, (x_[ends[i]] - x_[node]).normalized().dot((x_[ends[j]] - x_[node]).normalized()));
            }
        }
        return even_ ? between : Vec3((1.0 + 0.5 * least) * part_of_way(slot, node, to));
    }
    [[nodiscard]] bool chosen_edge(Index twin, Index to) const {
        return std::binary_search(chosen_edges_.begin(), chosen_edges_.end(), std::pair(twin, to));
    }

    /// The way of every double; or as far in the middle of the directions that count, which is less good a shape as a
    /// rule, but positive where no direction lies beyond a chosen quad.
    [[nodiscard]] std::vector<Vec3> ways(bool even) {
        even_ = even;
        std::vector<Vec3> result(report_.node_from.size());
        for (std::size_t i = 0, end = 0; i < corners_of_.size(); i = end) {
            const Index twin = corners_of_[i].first;
            for (end = i; end < corners_of_.size() && corners_of_[end].first == twin; ++end) {
            }
            const auto around = std::span<const std::pair<Index, Index>>(corners_of_).subspan(i, end - i);
            result[twin - x_.size()] = way_on_faces(twin, around);
        }
        return result;
    }

    /// An edge of a face that holds a double.
    struct Spoke {
        Index to;
        Label label;
        QuadCorners face;  ///< sorted
        Index of;          ///< its number
        friend auto operator<=>(const Spoke&, const Spoke&) = default;
    };

    [[nodiscard]] Vec3 way_on_faces(Index twin, std::span<const std::pair<Index, Index>> around) {
        const Index node = report_.node_from[twin - x_.size()];
        std::vector<Spoke> spokes;
        std::vector<Label> labels;
        for (const auto& [of, corner] : around) {
            for (const Index f : IndexRange(6 * (corner / 8), 6 * (corner / 8) + 6)) {
                const QuadCorners c = face(f);
                const auto at = static_cast<std::size_t>(std::find(c.begin(), c.end(), node) - c.begin());
                Label label{};
                if (at == 4 || is_chosen_[f] != 0 || !label_of(f, label)) {
                    continue;
                }
                labels.push_back(label);
                QuadCorners sorted = c;
                std::sort(sorted.begin(), sorted.end());
                for (const std::size_t k : {(at + 1) % 4, (at + 3) % 4}) {
                    spokes.push_back({c[k], label, sorted, f});
                }
            }
        }
        if (labels.empty()) {
            return way_inside(twin, node, around);
        }
        std::sort(spokes.begin(), spokes.end());
        std::sort(labels.begin(), labels.end());
        labels.erase(std::unique(labels.begin(), labels.end()), labels.end());
        return labels.size() > 1 ? way_on_line(twin, node, spokes, labels.size()) : way_on_face(twin, node, spokes);
    }

    /// Along the one line on which all faces at the node meet.
    [[nodiscard]] Vec3 way_on_line(Index twin, Index node, std::span<const Spoke> spokes, std::size_t labels) {
        std::vector<Spoke> lines;
        bool all = false;
        for (std::size_t i = 0, end = 0; i < spokes.size(); i = end) {
            std::size_t different = 1;
            for (end = i + 1; end < spokes.size() && spokes[end].to == spokes[i].to; ++end) {
                different += spokes[end].label != spokes[end - 1].label ? 1 : 0;
            }
            if (different > 1 && !chosen_edge(twin, spokes[i].to)) {
                lines.push_back(spokes[i]);
                all = different == labels;
            }
        }
        if (lines.size() != 1 || !all) {
            fault(PillowFault::split_feature, {node});
            return Vec3::Zero();
        }
        return part_of_way(lines[0].of / 6, node, lines[0].to);
    }

    /// Along the mesh edges inside one face, or across its only quad.
    [[nodiscard]] Vec3 way_on_face(Index twin, Index node, std::span<const Spoke> spokes) const {
        Vec3 sum = Vec3::Zero();
        std::size_t count = 0;
        for (std::size_t i = 0; i < spokes.size(); ++i) {
            if ((i == 0 || spokes[i].to != spokes[i - 1].to) && !chosen_edge(twin, spokes[i].to)) {
                sum += part_of_way(spokes[i].of / 6, node, spokes[i].to);
                ++count;
            }
        }
        if (count > 0) {
            return sum / static_cast<double>(count);
        }
        for (std::size_t i = 0; i < spokes.size(); ++i) {
            const QuadCorners c = face(spokes[i].of);
            const auto at = static_cast<std::size_t>(std::find(c.begin(), c.end(), node) - c.begin());
            const std::array<Index, 2> ends{c[(at + 1) % 4], c[(at + 3) % 4]};
            sum += part_across(spokes[i].of / 6, node, c[(at + 2) % 4], ends);
        }
        return sum / static_cast<double>(spokes.size());
    }

    /// Along the mesh edges that leave the chosen quads, or across the hexahedra between them.
    [[nodiscard]] Vec3 way_inside(Index twin, Index node, std::span<const std::pair<Index, Index>> around) const {
        std::vector<std::pair<Index, Index>> inward;  // to, slot
        for (const auto& [of, corner] : around) {
            for (const int k : hex_corner_neighbours[corner % 8]) {
                const Index to = corners(corner / 8)[static_cast<std::size_t>(k)];
                if (!chosen_edge(twin, to)) {
                    inward.emplace_back(to, corner / 8);
                }
            }
        }
        std::sort(inward.begin(), inward.end());
        Vec3 sum = Vec3::Zero();
        std::size_t count = 0;
        for (std::size_t i = 0; i < inward.size(); ++i) {
            if (i == 0 || inward[i].first != inward[i - 1].first) {
                sum += part_of_way(inward[i].second, node, inward[i].first);
                ++count;
            }
        }
        for (std::size_t i = 0; i < around.size() && inward.empty(); ++i) {
            sum += way_across(around[i].second, node);
            ++count;
        }
        return sum / static_cast<double>(count);
    }

    /// Across the quad of a corner that is not chosen if the two others are, else across the hexahedron.
    [[nodiscard]] Vec3 way_across(Index corner, Index node) const {
        const Index slot = corner / 8;
        const HexCorners& c = corners(slot);
        std::array<Index, 3> ends{};
        for (std::size_t k = 0; k < 3; ++k) {
            ends[k] = c[static_cast<std::size_t>(hex_corner_neighbours[corner % 8][k])];
        }
        std::vector<Index> others;
        for (const Index f : IndexRange(6 * slot, 6 * slot + 6)) {
            const QuadCorners q = face(f);
            if (is_chosen_[f] == 0 && std::find(q.begin(), q.end(), node) != q.end()) {
                others.push_back(f);
            }
        }
        if (others.size() == 1) {
            const QuadCorners q = face(others[0]);
            const auto at = static_cast<std::size_t>(std::find(q.begin(), q.end(), node) - q.begin());
            const std::array<Index, 2> two{q[(at + 1) % 4], q[(at + 3) % 4]};
            return part_across(slot, node, q[(at + 2) % 4], two);
        }
        constexpr std::array<std::size_t, 8> opposite_corner{6, 7, 4, 5, 2, 3, 0, 1};
        return part_across(slot, node, c[opposite_corner[corner % 8]], ends);
    }

    [[nodiscard]] double quality(const HexCorners& c, std::span<const Vec3> doubles) const {
        HexPoints x;
        for (std::size_t k = 0; k < 8; ++k) {
            x[k] = c[k] < x_.size() ? x_[c[k]] : doubles[c[k] - x_.size()];
        }
        return hex_scaled_jacobian(x);
    }

    /// Places the doubles, nearer to their nodes where hexahedra would be inverted.
    void place() {
        for (const Index s : IndexRange(slots_.size())) {
            HexCorners c = corners(s);
            for (Index& i : c) {
                i = twin(s, i);
            }
            moved_.push_back(c);
        }
        for (const Index f : chosen_) {
            const QuadCorners q = face(f);
            const auto in = [&](std::size_t k) { return twin(f / 6, q[k]); };
            moved_.push_back({in(0), in(1), in(2), in(3), q[0], q[1], q[2], q[3]});
            report_.hex_from.push_back(slots_[f / 6]);
        }
        std::vector<char> must(moved_.size(), 1);
        for (const Index s : IndexRange(slots_.size())) {
            must[s] = quality(corners(s), {}) > 0 ? 1 : 0;
        }
        doubles_.resize(way_.size());
        const std::vector<Vec3> whole = way_;
        const std::vector<char> left = halve_ways(must);
        if (std::find(left.begin(), left.end(), 1) != left.end()) {
            const std::vector<Vec3> even = ways(true);
            for (std::size_t i = 0; i < way_.size(); ++i) {
                way_[i] = left[i] != 0 ? Vec3(whole[i].norm() * even[i].normalized()) : way_[i];
            }
            static_cast<void>(halve_ways(must));
        }
    }

    /// Halves the ways of the doubles of hexahedra that must be positive and are not, each up to five times.
    /// \return the doubles of those that are left
    std::vector<char> halve_ways(std::span<const char> must) {
        constexpr int most = 5, most_rounds = 20;
        std::vector<int> halved(way_.size(), 0);
        std::vector<char> nearer(way_.size(), 0);
        bool again = true;
        for (int round = 0; again && round < most_rounds; ++round) {
            for (std::size_t i = 0; i < way_.size(); ++i) {
                doubles_[i] = x_[report_.node_from[i]] + way_[i];
            }
            nearer.assign(way_.size(), 0);
            report_.inverted = 0;
            for (std::size_t m = 0; m < moved_.size(); ++m) {
                const bool positive = quality(moved_[m], doubles_) > 0;
                report_.inverted += positive ? 0 : 1;
                for (const Index i : moved_[m]) {
                    if (!positive && must[m] != 0 && i >= x_.size()) {
                        nearer[i - x_.size()] = 1;
                    }
                }
            }
            again = false;
            for (std::size_t i = 0; i < way_.size(); ++i) {
                if (nearer[i] != 0 && halved[i] < most) {
                    way_[i] *= 0.5;
                    ++halved[i];
                    again = true;
                }
            }
        }
        return nearer;
    }

    void write() {
        for (std::size_t q = 0; q < data_.quads.size(); ++q) {
            if (on_[q] != no_face && is_chosen_[on_[q]] == 0) {
                for (Index& i : data_.quads[q]) {
                    i = twin(on_[q] / 6, i);
                }
            }
        }
        data_.quads.insert(data_.quads.end(), strips_.begin(), strips_.end());
        for (const std::size_t q : report_.quad_from) {
            if (!data_.quad_groups.empty()) {
                data_.quad_groups.push_back(data_.quad_groups[q]);
            }
        }
        for (const Index s : IndexRange(slots_.size())) {
            data_.mesh.hexes[slots_[s]] = moved_[s];
        }
        data_.mesh.hexes.insert(data_.mesh.hexes.end(), moved_.begin() + static_cast<std::ptrdiff_t>(slots_.size()),
                                moved_.end());
        for (const Index h : report_.hex_from) {
            if (!data_.hex_groups.empty()) {
                data_.hex_groups.push_back(data_.hex_groups[h]);
            }
        }
        data_.mesh.nodes.insert(data_.mesh.nodes.end(), doubles_.begin(), doubles_.end());
    }

    HexMeshData& data_;
    const PillowOptions& options_;
    std::span<const Vec3> x_;
    std::vector<char> chosen_quad_, touched_;
    std::vector<Index> slots_;                      ///< hexahedra, ascending
    std::vector<Index> partner_;                    ///< of faces
    std::vector<std::vector<std::size_t>> listed_;  ///< quads on faces of the set
    std::vector<char> is_chosen_;
    std::vector<Index> on_;                              ///< a face of the set for each quad
    std::vector<Index> chosen_;                          ///< faces
    std::vector<Index> twin_;                            ///< of corners; no_index: none
    std::vector<std::pair<Index, Index>> corners_of_;    ///< doubles and the corners that take them
    std::vector<std::pair<Index, Index>> chosen_edges_;  ///< doubles and nodes at the other end
    std::vector<Index> rims_;                            ///< doubles at ends of rim edges
    std::vector<QuadCorners> strips_;
    bool even_ = false;
    std::vector<Vec3> way_, doubles_;
    std::vector<HexCorners> moved_;  ///< those in slots, then the layer
    PillowReport report_;
};

}  // namespace detail

PAVIOR_INLINE PillowReport pillow(HexMeshData& data, std::span<const std::size_t> chosen,
                                  const PillowOptions& options) {
    if (!(options.fraction > 0 && options.fraction < 1)) {
        throw InputError(ErrorCode::bad_option, "PillowOptions::fraction must lie in (0, 1)");
    }
    const std::size_t hexes = data.mesh.hexes.size();
    if ((!options.shrink.empty() && options.shrink.size() != hexes) ||
        (!data.hex_groups.empty() && data.hex_groups.size() != hexes) ||
        (!data.quad_groups.empty() && data.quad_groups.size() != data.quads.size())) {
        throw InputError(ErrorCode::size_mismatch, "flags and groups must be as many as hexahedra and quads, or none");
    }
    VerifyReport ids;
    static_cast<void>(detail::check_hex_corners(data.mesh, ids));
    ids.throw_if_bad();
    return detail::Pillower(data, chosen, options).run();
}

}  // namespace pavior
