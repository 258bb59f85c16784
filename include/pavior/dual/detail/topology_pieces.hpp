#pragma once
/// \file
/// The work behind tet_topology(): edges and faces filed under their first nodes.

#include <pavior/core/error.hpp>
#include <pavior/core/execution.hpp>
#include <pavior/core/parallel_for.hpp>
#include <pavior/core/stop.hpp>
#include <pavior/dual/detail/ranked_tets.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <stop_token>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace pavior::detail {

/// Edges and faces of a range of ranks of first nodes, numbered from 0.
template <class Topology>
class TopologyPiece {
public:
    TopologyPiece(const RankedTets& tets, Topology& out) : tets_(tets), out_(out) {}

    std::vector<std::array<Index, 2>> edges;
    std::vector<TriCorners> faces;
    std::vector<std::array<Index, 2>> face_tets;
    /// Edges of the faces, numbered as those of the piece. That opposite the first node belongs to another first node:
    /// instead of it, pending + its local number in the face's first tetrahedron.
    std::vector<std::array<Index, 3>> face_edges;
    static constexpr Index pending = no_index - 7;

    void run(std::size_t begin, std::size_t end, const std::stop_token& stop) {
        const std::size_t uses = tets_.begin[0][end] - tets_.begin[0][begin];
        slot_.assign(tets_.node.size(), 0);
        edges.reserve(uses * 5 / 4);
        faces.reserve(uses * 17 / 8);
        face_tets.reserve(uses * 17 / 8);
        face_edges.reserve(uses * 17 / 8);
        for (const Index r : stoppable(IndexRange(static_cast<Index>(begin), static_cast<Index>(end)), stop)) {
            out_.edge_begin[r] = static_cast<Index>(edges.size());
            out_.face_begin[r] = static_cast<Index>(faces.size());
            number_edges(r);
            collect_faces(r);
            number_faces(r);
        }
    }

private:
    /// A tetrahedron on a face of the node at work: the slot of the face's highest node, and 4 * tet + face.
    struct Half {
        Index high = 0;
        Index face = 0;
    };
    /// A half with the slot of its middle node.
    struct LooseHalf {
        Index low = 0;
        Half half;
    };

    [[nodiscard]] std::span<const Index> tets_at(std::size_t role, std::size_t r) const {
        const auto& begin = tets_.begin[role];
        return std::span(tets_.tets[role]).subspan(begin[r], begin[r + 1] - begin[r]);
    }

    /// Finds the neighbours of higher rank; slot_ tells the place of each in the order of ranks.
    void number_edges(std::size_t r) {
        const std::size_t most = 3 * tets_at(0, r).size() + 2 * tets_at(1, r).size() + tets_at(2, r).size();
        if (above_.size() < most + 1) {
            above_.resize(2 * most + 1, 0);
        }
        std::size_t count = 0;
        const auto meet = [&](Index rank) {
            const Index slot = slot_[rank];
            const bool known = slot < count && above_[slot] == rank;
            above_[count] = rank;
            slot_[rank] = known ? slot : static_cast<Index>(count);
            count += known ? 0 : 1;
        };
        for (std::size_t role = 0; role < 3; ++role) {
            for (const Index t : tets_at(role, r)) {
                for (std::size_t k = role + 1; k < 4; ++k) {
                    meet(tets_.ranks[t][k]);
                }
            }
        }
        count_ = count;
        const auto end = above_.begin() + static_cast<std::ptrdiff_t>(count);
        if (count > 24) {
            std::sort(above_.begin(), end);
        } else {
            insertion_sort(above_.begin(), end, [](Index a, Index b) { return a < b; });
        }
        const Index v = tets_.node[r];
        for (std::size_t i = 0; i < count; ++i) {
            const Index w = tets_.node[above_[i]];
            slot_[above_[i]] = static_cast<Index>(i);
            edges.push_back({std::min(v, w), std::max(v, w)});
        }
    }

    /// Writes tet_edges, and files the faces under their middle node.
    void collect_faces(std::size_t r) {
        loose_.clear();
        starts_.assign(count_ + 1, 0);
        for (const Index t : tets_at(0, r)) {
            const auto s = write_edges<0>(t, r);
            add_half(s[1], s[2], t, 3);
            add_half(s[1], s[3], t, 2);
            add_half(s[2], s[3], t, 1);
        }
        for (const Index t : tets_at(1, r)) {
            const auto s = write_edges<1>(t, r);
            add_half(s[2], s[3], t, 0);
        }
        for (const Index t : tets_at(2, r)) {
            std::ignore = write_edges<2>(t, r);
        }
        for (std::size_t i = 1; i < starts_.size(); ++i) {
            starts_[i] += starts_[i - 1];
        }
        halves_.resize(loose_.size());
        for (const LooseHalf& loose : loose_) {
            halves_[starts_[loose.low]++] = loose.half;
        }
    }

    /// The edges from the corner of this role to those of higher rank; returns the slots of the latter.
    template <std::size_t Role>
    std::array<Index, 4> write_edges(Index t, std::size_t r) {
        const Index first = out_.edge_begin[r];
        const std::array<Index, 4>& ranks = tets_.ranks[t];
        const auto& local = tets_.local[t];
        std::array<Index, 4> slots{};
        for (std::size_t k = Role + 1; k < 4; ++k) {
            slots[k] = slot_[ranks[k]];
            out_.tet_edges[t][static_cast<std::size_t>(tet_edge_between[local[Role]][local[k]])] = first + slots[k];
        }
        return slots;
    }

    /// The face of tetrahedron t without its corner of order \p opposite.
    void add_half(Index low, Index high, Index t, std::size_t opposite) {
        loose_.push_back({low, {high, 4 * t + tets_.local[t][opposite]}});
        ++starts_[low + std::size_t{1}];
    }

    /// Pairs the halves of faces; here starts_[i] is the end of the faces with middle node i.
    void number_faces(std::size_t r) {
        const auto before = [](const Half& a, const Half& b) { return a.high < b.high; };
        std::size_t begin = 0;
        for (Index low = 0; low < count_; ++low) {
            const std::size_t end = starts_[low];
            if (end - begin > 24) {
                std::stable_sort(at(begin), at(end), before);
            } else {
                insertion_sort(at(begin), at(end), before);
            }
            while (begin < end) {
                begin += add_face(r, low, begin, end);
            }
        }
    }

    [[nodiscard]] auto at(std::size_t i) { return halves_.begin() + static_cast<std::ptrdiff_t>(i); }

    /// Adds the face of the halves at \p begin and returns their number.
    std::size_t add_face(std::size_t r, Index low, std::size_t begin, std::size_t end) {
        const Half first = halves_[begin];
        const bool inner = begin + 1 < end && halves_[begin + 1].high == first.high;
        const Half second = inner ? halves_[begin + 1] : first;
        const Index a = tets_.node[r];
        const Index b = tets_.node[above_[low]];
        const Index c = tets_.node[above_[first.high]];
        if (inner && begin + 2 < end && halves_[begin + 2].high == first.high) {
            throw InputError(ErrorCode::non_manifold,
                             "a triangle has more than two tetrahedra; its nodes are " + std::to_string(a) + ", " +
                                 std::to_string(b) + ", " + std::to_string(c),
                             {a, b, c});
        }
        const auto id = static_cast<Index>(faces.size());
        push_face({a, pending + far_edge(std::min(first.face, second.face))}, {b, out_.edge_begin[r] + first.high},
                  {c, out_.edge_begin[r] + low});
        const Index t = first.face / 4;
        const Index u = second.face / 4;
        face_tets.push_back({std::min(t, u), inner ? std::max(t, u) : no_index});
        out_.tet_faces[t][first.face % 4] = id;
        out_.tet_faces[u][second.face % 4] = id;
        return inner ? 2 : 1;
    }

    /// A node of a face and the edge opposite to it.
    struct Side {
        Index node;
        Index edge;
    };

    /// Appends a face with its nodes in ascending order.
    void push_face(Side a, Side b, Side c) {
        const Side low = b.node < c.node ? b : c;
        const Side high = b.node < c.node ? c : b;
        const Side first = a.node < low.node ? a : low;
        const Side last = a.node < high.node ? high : a;
        const Side middle = a.node < low.node ? low : a.node < high.node ? a : high;
        faces.push_back({first.node, middle.node, last.node});
        face_edges.push_back({first.edge, middle.edge, last.edge});
    }

    /// The local edge between the two highest corners of a face, given as 4 * tet + face.
    [[nodiscard]] Index far_edge(Index face) const {
        const auto& local = tets_.local[face / 4];
        const std::size_t opposite = face % 4;
        const std::size_t c = local[3] == opposite ? local[2] : local[3];
        const std::size_t b = local[3] == opposite || local[2] == opposite ? local[1] : local[2];
        return static_cast<Index>(tet_edge_between[b][c]);
    }

    /// Stable; for short ranges.
    template <class Iterator, class Less>
    static void insertion_sort(Iterator begin, Iterator end, const Less& less) {
        for (Iterator i = begin; i != end; ++i) {
            const auto value = *i;
            Iterator j = i;
            for (; j != begin && less(value, *(j - 1)); --j) {
                *j = *(j - 1);
            }
            *j = value;
        }
    }

    const RankedTets& tets_;
    Topology& out_;
    std::vector<Index> slot_;   ///< of a rank among above_, valid if above_ says so
    std::vector<Index> above_;  ///< ranks of the neighbours of higher rank of the node at work, count_ of them
    std::size_t count_ = 0;
    std::vector<LooseHalf> loose_;
    std::vector<Half> halves_;
    std::vector<Index> starts_;
};

/// Ids of pieces become ids of the whole. \p cuts: ranks between the pieces.
template <class Topology>
void join_topology_pieces(const RankedTets& tets, std::vector<TopologyPiece<Topology>>& pieces,
                          const std::vector<std::size_t>& cuts, Topology& out, Execution execution) {
    std::vector<Index> edge_base(pieces.size() + 1, 0);
    std::vector<Index> face_base(pieces.size() + 1, 0);
    for (std::size_t p = 0; p < pieces.size(); ++p) {
        edge_base[p + 1] = edge_base[p] + static_cast<Index>(pieces[p].edges.size());
        face_base[p + 1] = face_base[p] + static_cast<Index>(pieces[p].faces.size());
    }
    out.edge_begin.back() = edge_base.back();
    out.face_begin.back() = face_base.back();
    if (pieces.size() == 1) {
        out.edges = std::move(pieces[0].edges);
        out.faces = std::move(pieces[0].faces);
        out.face_tets = std::move(pieces[0].face_tets);
        out.face_edges = std::move(pieces[0].face_edges);
        return;
    }
    out.edges.resize(edge_base.back());
    out.faces.resize(face_base.back());
    out.face_tets.resize(face_base.back());
    out.face_edges.resize(face_base.back());
    for_pieces(execution, pieces.size(), pieces.size(), [&](std::size_t p, std::size_t, std::size_t) {
        std::copy(pieces[p].edges.begin(), pieces[p].edges.end(), out.edges.begin() + edge_base[p]);
        std::copy(pieces[p].faces.begin(), pieces[p].faces.end(), out.faces.begin() + face_base[p]);
        std::copy(pieces[p].face_tets.begin(), pieces[p].face_tets.end(), out.face_tets.begin() + face_base[p]);
        std::transform(pieces[p].face_edges.begin(), pieces[p].face_edges.end(), out.face_edges.begin() + face_base[p],
                       [&](std::array<Index, 3> sides) {
                           for (Index& e : sides) {
                               e += e >= TopologyPiece<Topology>::pending ? 0 : edge_base[p];
                           }
                           return sides;
                       });
        for (std::size_t r = cuts[p]; r < cuts[p + 1]; ++r) {
            out.edge_begin[r] += edge_base[p];
            out.face_begin[r] += face_base[p];
        }
    });
    const auto piece_of = [&](Index rank) {
        std::size_t p = 0;
        while (rank >= cuts[p + 1]) {
            ++p;
        }
        return p;
    };
    parallel_for(execution, tets.ranks.size(), 1024, [&](std::size_t begin, std::size_t end) {
        for (std::size_t t = begin; t < end; ++t) {
            std::array<std::size_t, 4> p{};
            for (std::size_t k = 0; k < 4; ++k) {
                p[tets.local[t][k]] = piece_of(tets.ranks[t][k]);
            }
            for (std::size_t e = 0; e < 6; ++e) {
                const auto& ends = tet_edges[e];
                out.tet_edges[t][e] +=
                    edge_base[std::min(p[static_cast<std::size_t>(ends[0])], p[static_cast<std::size_t>(ends[1])])];
            }
            for (std::size_t f = 0; f < 4; ++f) {
                out.tet_faces[t][f] += face_base[std::min(std::min(p[(f + 1) % 4], p[(f + 2) % 4]), p[(f + 3) % 4])];
            }
        }
    });
}

/// Replaces the pending edges of the faces.
template <class Topology>
void finish_face_edges(Topology& out, Execution execution) {
    constexpr Index pending = TopologyPiece<Topology>::pending;
    parallel_for(execution, out.faces.size(), 1024, [&](std::size_t begin, std::size_t end) {
        for (std::size_t f = begin; f < end; ++f) {
            std::array<Index, 3>& e = out.face_edges[f];
            const std::size_t k = e[1] >= pending ? 1 : e[2] >= pending ? 2 : 0;
            e[k] = out.tet_edges[out.face_tets[f][0]][e[k] - pending];
        }
    });
}

/// Cuts of the ranks into \p pieces with like numbers of tetrahedra.
[[nodiscard]] inline std::vector<std::size_t> balanced_cuts(const RankedTets& tets, std::size_t pieces) {
    const std::size_t nodes = tets.node.size();
    std::vector<std::size_t> cuts{0};
    for (std::size_t r = 0; r < nodes && cuts.size() < pieces; ++r) {
        const std::size_t done = std::size_t{tets.begin[0][r]} + tets.begin[1][r] + tets.begin[2][r];
        if (done >= 3 * tets.ranks.size() * cuts.size() / pieces) {
            cuts.push_back(r);
        }
    }
    cuts.resize(pieces, nodes);
    cuts.push_back(nodes);
    return cuts;
}

/// The local node of \p corners that is \p node.
[[nodiscard]] constexpr std::size_t local_node(const TetCorners& corners, Index node) {
    return corners[0] == node ? 0 : corners[1] == node ? 1 : corners[2] == node ? 2 : 3;
}

}  // namespace pavior::detail
