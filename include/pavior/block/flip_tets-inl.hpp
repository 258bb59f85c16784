#pragma once

#include <pavior/block/flip_tets.hpp>
#include <pavior/block/split_tets.hpp>
#include <pavior/core/error.hpp>
#include <pavior/core/stop.hpp>
#include <pavior/math/hexahedron.hpp>
#include <pavior/mesh/cells.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

namespace pavior {

namespace detail {

/// The least scaled Jacobian of the four hexahedra of a tetrahedron; -1 unless it is positive.
[[nodiscard]] inline double split_quality(const std::array<Vec3, 4>& x) {
    if (!((x[1] - x[0]).cross(x[2] - x[0]).dot(x[3] - x[0]) > 0)) {
        return -1;
    }
    const Vec3 centre = (x[0] + x[1] + x[2] + x[3]) / 4.0;
    double least = 1;
    for (const auto& p : tet_from_corner) {
        const Vec3 &a = x[p[0]], &b = x[p[1]], &c = x[p[2]], &d = x[p[3]];
        least = std::min(least, hex_scaled_jacobian({a, (a + b) / 2.0, (a + b + c) / 3.0, (a + c) / 2.0, (a + d) / 2.0,
                                                     (a + b + d) / 3.0, centre, (a + c + d) / 3.0}));
    }
    return least;
}

class TetFlipper {
public:
    TetFlipper(const TaggedTetMesh& input, const FlipOptions& options)
        : x_(input.mesh.nodes), options_(options), tets_(input.mesh.tets), at_(x_.size()), tagged_(x_.size()) {
        for (const TaggedTriangle& triangle : input.triangles) {
            tagged_[*std::min_element(triangle.nodes.begin(), triangle.nodes.end())].push_back(sorted(triangle.nodes));
        }
        for (std::size_t t = 0; t < tets_.size(); ++t) {
            origin_.push_back(static_cast<Index>(t));
            quality_.push_back(quality(tets_[t]));
            for (const Index i : tets_[t]) {
                at_[i].push_back(static_cast<Index>(t));
            }
        }
    }

    FlippedTets run() {
        FlippedTets result;
        result.before = least();
        for (int round = 0; round < options_.rounds; ++round) {
            std::vector<std::pair<double, Index>> poor;
            for (std::size_t t = 0; t < tets_.size(); ++t) {
                if (alive(t) && quality_[t] < options_.sufficient) {
                    poor.emplace_back(quality_[t], static_cast<Index>(t));
                }
            }
            std::sort(poor.begin(), poor.end());
            const std::size_t before = result.flips;
            for (const auto& [q, t] : poor) {
                check_stop(options_.stop);
                if (alive(t) && improve(t)) {
                    ++result.flips;
                }
            }
            if (result.flips == before) {
                break;
            }
        }
        result.after = least();
        for (std::size_t t = 0; t < tets_.size(); ++t) {
            if (alive(t)) {
                result.tets.push_back(tets_[t]);
                result.origin.push_back(origin_[t]);
            }
        }
        return result;
    }

private:
    static constexpr std::size_t most_round_edge = 8;

    /// Tetrahedra in the place of others, and the least quality among them.
    struct Flip {
        std::vector<Index> old;
        std::vector<TetCorners> made;
        double quality = -1;
    };

    static TriCorners sorted(TriCorners c) {
        std::sort(c.begin(), c.end());
        return c;
    }
    [[nodiscard]] bool alive(std::size_t t) const { return tets_[t][0] != tets_[t][1]; }
    [[nodiscard]] bool is_tagged(const TriCorners& c) const {
        const TriCorners key = sorted(c);
        const auto& list = tagged_[key[0]];
        return std::find(list.begin(), list.end(), key) != list.end();
    }
    [[nodiscard]] double least() const {
        double least = 1;
        for (std::size_t t = 0; t < tets_.size(); ++t) {
            least = alive(t) ? std::min(least, quality_[t]) : least;
        }
        return least;
    }

    [[nodiscard]] double quality(const TetCorners& c) const {
        const std::array<Vec3, 4> x{x_[c[0]], x_[c[1]], x_[c[2]], x_[c[3]]};
        const double q = split_quality(x);
        if (q <= 0) {
            return q;
        }
        constexpr double cosine = -0.866;  // of 150 degrees
        std::array<std::optional<Vec3>, 4> normals;
        for (std::size_t f = 0; f < 4; ++f) {
            const TriCorners side = tet_face(c, f);
            if (is_tagged(side)) {
                normals[f] = (x_[side[1]] - x_[side[0]]).cross(x_[side[2]] - x_[side[0]]).normalized();
            }
            for (std::size_t g = 0; g < f && normals[f]; ++g) {
                if (normals[g] && -normals[f]->dot(*normals[g]) < cosine) {
                    return 1e-3 * q;
                }
            }
        }
        return q;
    }

    /// The best flip that takes tetrahedron \p t away, if that raises the least quality of those involved.
    bool improve(std::size_t t) {
        const TetCorners c = tets_[t];
        Flip best;
        double gain = 0.01;
        const auto consider = [&](Flip flip) {
            double before = 1;
            for (const Index o : flip.old) {
                before = std::min(before, quality_[o]);
            }
            if (!flip.made.empty() && flip.quality > before + gain) {
                gain = flip.quality - before;
                best = std::move(flip);
            }
        };
        for (std::size_t f = 0; f < 4; ++f) {
            consider(without_face(static_cast<Index>(t), tet_face(c, f), c[f]));
        }
        for (const auto& edge : tet_edges) {
            consider(without_edge(c[static_cast<std::size_t>(edge[0])], c[static_cast<std::size_t>(edge[1])]));
        }
        if (best.made.empty()) {
            return false;
        }
        apply(best);
        return true;
    }

    void apply(const Flip& flip) {
        const Index origin = origin_[flip.old.front()];
        for (const Index t : flip.old) {
            for (const Index i : tets_[t]) {
                std::erase(at_[i], t);
            }
            tets_[t] = {0, 0, 0, 0};
        }
        for (const TetCorners& c : flip.made) {
            for (const Index i : c) {
                at_[i].push_back(static_cast<Index>(tets_.size()));
            }
            tets_.push_back(c);
            origin_.push_back(origin);
            quality_.push_back(quality(c));
        }
    }

    /// Three tetrahedra round the edge from \p apex to the node across \p face, instead of the two on the face, which
    /// is seen from outside of \p t.
    [[nodiscard]] Flip without_face(Index t, const TriCorners& face, Index apex) const {
        if (is_tagged(face)) {
            return {};
        }
        for (const Index other : at_[face[0]]) {
            const TetCorners& c = tets_[other];
            const auto has = [&](Index i) { return std::find(c.begin(), c.end(), i) != c.end(); };
            if (other == t || !has(face[1]) || !has(face[2])) {
                continue;
            }
            const Index across = *std::find_if(
                c.begin(), c.end(), [&](Index i) { return std::find(face.begin(), face.end(), i) == face.end(); });
            Flip flip{{t, other}, {}, 1};
            for (std::size_t k = 0; k < 3; ++k) {
                flip.made.push_back({apex, face[k], face[(k + 1) % 3], across});
                flip.quality = std::min(flip.quality, quality(flip.made.back()));
            }
            return flip;
        }
        return {};
    }

    /// The best triangles on the ring round an inner edge, each with a tetrahedron on either side, instead of those
    /// round the edge.
    [[nodiscard]] Flip without_edge(Index a, Index b) const {
        Flip flip;
        std::vector<std::array<Index, 2>> links;  // c, d of tetrahedra (a, b, c, d)
        for (const Index t : at_[a]) {
            const TetCorners& c = tets_[t];
            const auto from = static_cast<std::size_t>(std::find(c.begin(), c.end(), a) - c.begin());
            const auto& p = tet_from_corner[from];
            for (std::size_t k = 1; k < 4; ++k) {
                if (c[p[k]] == b) {
                    links.push_back({c[p[1 + k % 3]], c[p[1 + (k + 1) % 3]]});
                    flip.old.push_back(t);
                }
            }
        }
        const std::size_t n = links.size();
        if (n < 3 || n > most_round_edge) {
            return {};
        }
        std::vector<Index> ring{links[0][0]};
        for (std::size_t i = 0; i < n; ++i) {
            const auto next =
                std::find_if(links.begin(), links.end(), [&](const auto& link) { return link[0] == ring.back(); });
            if (next == links.end() || is_tagged({a, b, ring.back()})) {
                return {};
            }
            ring.push_back((*next)[1]);
        }
        if (ring.back() != ring.front()) {
            return {};
        }
        ring.pop_back();
        fill_ring(a, b, ring, flip);
        return flip;
    }

    /// The triangulation of the polygon whose worst tetrahedron is best, by dynamic programming.
    void fill_ring(Index a, Index b, const std::vector<Index>& ring, Flip& flip) const {
        const std::size_t n = ring.size();
        using Table = std::array<std::array<double, most_round_edge>, most_round_edge>;
        Table best{};
        std::array<std::array<std::size_t, most_round_edge>, most_round_edge> middle{};
        for (std::size_t i = 0; i + 1 < n; ++i) {
            best[i][i + 1] = 1;
        }
        for (std::size_t span = 2; span < n; ++span) {
            for (std::size_t i = 0; i + span < n; ++i) {
                const std::size_t k = i + span;
                best[i][k] = -2;
                for (std::size_t j = i + 1; j < k; ++j) {
                    const double q = std::min({best[i][j], best[j][k], quality({ring[i], ring[j], ring[k], b}),
                                               quality({ring[i], ring[k], ring[j], a})});
                    if (q > best[i][k]) {
                        best[i][k] = q;
                        middle[i][k] = j;
                    }
                }
            }
        }
        flip.quality = best[0][n - 1];
        std::vector<std::array<std::size_t, 2>> open{{0, n - 1}};
        while (!open.empty()) {
            const auto [i, k] = open.back();
            open.pop_back();
            if (k - i < 2) {
                continue;
            }
            const std::size_t j = middle[i][k];
            flip.made.push_back({ring[i], ring[j], ring[k], b});
            flip.made.push_back({ring[i], ring[k], ring[j], a});
            open.push_back({i, j});
            open.push_back({j, k});
        }
    }

    const std::vector<Vec3>& x_;
    const FlipOptions& options_;
    std::vector<TetCorners> tets_;  ///< dead ones: node 0 four times
    std::vector<Index> origin_;
    std::vector<double> quality_;
    std::vector<std::vector<Index>> at_;           ///< tetrahedra at each node
    std::vector<std::vector<TriCorners>> tagged_;  ///< ascending nodes, at the least of them
};

}  // namespace detail

PAVIOR_INLINE FlippedTets flip_tets(const TaggedTetMesh& tets, const FlipOptions& options) {
    if (!(options.sufficient > 0 && options.sufficient <= 1) || options.rounds < 0) {
        throw InputError(ErrorCode::bad_option, "what is sufficient must lie in (0, 1], rounds must not be negative");
    }
    for (std::size_t t = 0; t < tets.mesh.tets.size(); ++t) {
        for (const Index i : tets.mesh.tets[t]) {
            if (i >= tets.mesh.nodes.size()) {
                throw InputError(ErrorCode::bad_index, "a node does not exist: tetrahedron " + std::to_string(t),
                                 {static_cast<std::int64_t>(t)});
            }
        }
    }
    for (std::size_t i = 0; i < tets.triangles.size(); ++i) {
        for (const Index node : tets.triangles[i].nodes) {
            if (node >= tets.mesh.nodes.size()) {
                throw InputError(ErrorCode::bad_index, "a node does not exist: triangle " + std::to_string(i),
                                 {static_cast<std::int64_t>(i)});
            }
        }
    }
    return detail::TetFlipper(tets, options).run();
}

}  // namespace pavior
