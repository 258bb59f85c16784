#pragma once

#include <pavior/block/flip_tets.hpp>
#include <pavior/block/split_tets.hpp>
#include <pavior/brep/all_tags.hpp>
#include <pavior/brep/surface_foot.hpp>
#include <pavior/core/error.hpp>
#include <pavior/core/stop.hpp>
#include <pavior/core/stopwatch.hpp>
#include <pavior/math/hexahedron.hpp>
#include <pavior/mesh/quality.hpp>
#include <pavior/part/detail/hex_jacobian.hpp>
#include <pavior/part/entity_guide.hpp>
#include <pavior/part/split_solids.hpp>
#include <pavior/smooth/improve_hexes.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <stop_token>
#include <tuple>
#include <utility>

namespace pavior {

namespace detail {

/// Nodes of split tetrahedra: what they lie on, where the tetrahedra have them, and where the model wants them.
struct SplitPlaces {
    std::vector<NodeEntity> on;  ///< dimension 0 with id -1: on the boundary, but not to be moved
    std::vector<Vec3> straight, wanted;
};

/// Finds the entities of the nodes from the tags of the tetrahedra, and their places on them.
class SplitPlacer {
public:
    SplitPlacer(const AnyModel& b, const SolidsTets& tets, const SplitTets& split)
        : b_(b), tets_(tets), split_(split), near_edge_(b) {}

    SplitPlaces run() {
        places_.straight = places_.wanted = split_.mesh.nodes;
        classify();
        for (std::size_t i = 0; i < tets_.tets.edges.size(); ++i) {
            const Index middle = split_.edge_node(i);
            const std::array<Index, 2>& ends = tets_.tets.edges[i].nodes;
            put(middle, on_edge(EdgeId{tets_.tets.edges[i].tag}, middle), length(ends[0], ends[1]));
        }
        place_on_faces();
        return std::move(places_);
    }

private:
    [[nodiscard]] double length(Index i, Index j) const { return (places_.straight[i] - places_.straight[j]).norm(); }

    /// The entity of least dimension of each node; nodes that their tags contradict are not to be moved.
    void classify() {
        std::vector<NodeEntity>& on = places_.on;
        on.resize(places_.straight.size());
        for (std::size_t h = split_.mesh.hexes.size(); h-- > 0;) {
            for (const Index i : split_.mesh.hexes[h]) {
                on[i].id = tets_.tet_solid[h / 4].value;
            }
        }
        std::vector<char> contradicted(on.size(), 0);
        const auto add = [&](Index i, int dimension, std::int32_t id) {
            if (on[i].dimension > dimension) {
                on[i] = {dimension, id, Vec2::Zero()};
                contradicted[i] = 0;
            } else if (on[i].dimension == dimension && on[i].id != id) {
                contradicted[i] = 1;
            }
        };
        for (std::size_t q = 0; q < split_.quads.size(); ++q) {
            for (const Index i : split_.quads[q]) {
                add(i, 2, split_.quad_tags[q]);
            }
        }
        for (const TaggedEdge& half : split_.edges) {
            add(half.nodes[0], 1, half.tag);
            add(half.nodes[1], 1, half.tag);
        }
        for (const TaggedNode& vertex : tets_.tets.vertices) {
            on[vertex.node] = {0, vertex.tag, Vec2::Zero()};
            contradicted[vertex.node] = 0;
        }
        for (std::size_t i = 0; i < on.size(); ++i) {
            on[i] = contradicted[i] != 0 ? NodeEntity{0, -1, Vec2::Zero()} : on[i];
        }
    }

    /// The new place of a node unless it is far off for an edge of the length.
    void put(Index i, const Vec3& x, double edge) {
        if ((x - places_.straight[i]).norm() < 0.5 * edge) {
            places_.wanted[i] = x;
        } else {
            places_.on[i] = {0, -1, Vec2::Zero()};
        }
    }

    [[nodiscard]] Vec3 on_edge(EdgeId e, Index i) {
        const EdgePoint found = near_edge_.closest(e, places_.straight[i]);
        places_.on[i].uv = {found.t, 0.0};
        return b_.edge_point(e, found.t);
    }

    void place_on_faces() {
        std::vector<std::int32_t> known(places_.on.size(), -1);  // the face for which foot is known
        std::vector<SurfaceFoot> foot(places_.on.size());
        std::map<std::int32_t, bool> plane;
        for (std::size_t t = 0; t < tets_.tets.triangles.size(); ++t) {
            const TriCorners& c = tets_.tets.triangles[t].nodes;
            const FaceId f{tets_.tets.triangles[t].tag};
            if (const auto [at, first] = plane.emplace(f.value, false); first) {
                at->second = plane_of(b_, f).has_value();
            }
            if (plane.at(f.value)) {
                continue;
            }
            const double longest = std::max({length(c[0], c[1]), length(c[1], c[2]), length(c[2], c[0])});
            const double precision = 1e-9 * longest;
            for (std::size_t k = 0; k < 3; ++k) {
                if (known[c[k]] == f.value) {
                    continue;
                }
                std::optional<SurfaceFoot> found;
                for (const std::size_t j : {(k + 1) % 3, (k + 2) % 3}) {
                    if (!found && known[c[j]] == f.value && foot[c[j]].regular) {
                        found = surface_foot(b_, f, places_.straight[c[k]], foot[c[j]].uv, precision);
                    }
                }
                const bool on = found && found->distance <= 1e-3 * longest;
                foot[c[k]] = on ? *found : projected_foot(b_, f, places_.straight[c[k]]);
                known[c[k]] = f.value;
                if (places_.on[c[k]].dimension == 2) {
                    places_.on[c[k]].uv = foot[c[k]].uv;
                }
            }
            const auto place = [&](Index node, std::initializer_list<std::size_t> corners) {
                if (places_.on[node].dimension == 2 && places_.on[node].id == f.value) {
                    put(node, on_face(f, node, c, corners, foot, longest), longest);
                }
            };
            for (std::size_t k = 0; k < 3; ++k) {
                place(split_.quads[3 * t + k][1], {k, (k + 1) % 3});
            }
            place(split_.triangle_node(t), {0, 1, 2});
        }
    }

    /// From the middle of the parameters of the corners, or by projection.
    [[nodiscard]] Vec3 on_face(FaceId f, Index node, const TriCorners& c, std::initializer_list<std::size_t> corners,
                               const std::vector<SurfaceFoot>& foot, double longest) {
        const std::array<double, 2> period = b_.face_period(f);
        const Vec3& x = places_.straight[node];
        std::optional<Vec2> first;
        Vec2 sum = Vec2::Zero();
        bool regular = true;
        for (const std::size_t k : corners) {
            Vec2 uv = foot[c[k]].uv;
            first = first.value_or(uv);
            for (Eigen::Index d = 0; d < 2; ++d) {
                const double p = period[static_cast<std::size_t>(d)];
                uv[d] += p > 0 ? p * std::round(((*first)[d] - uv[d]) / p) : 0;
            }
            sum += uv;
            regular = regular && foot[c[k]].regular;
        }
        std::optional<SurfaceFoot> found;
        if (regular) {
            found = surface_foot(b_, f, x, sum / static_cast<double>(corners.size()), 1e-9 * longest);
        }
        const Vec2 uv = found && found->distance < 0.5 * longest ? found->uv : b_.closest_on_face(f, x);
        places_.on[node].uv = uv;
        return b_.face_point(f, uv);
    }

    const AnyModel& b_;
    const SolidsTets& tets_;
    const SplitTets& split_;
    NearestEdge<AnyModel> near_edge_;
    SplitPlaces places_;
};

/// Moves the nodes of split tetrahedra to where the model wants them as far as that is valid, then improves the rest.
class SplitImprover {
public:
    SplitImprover(const AnyModel& b, const SplitOptions& options, const std::function<bool()>& late, HexMesh& mesh,
                  SplitPlaces& places)
        : b_(b), options_(options), late_(late), mesh_(mesh), places_(places) {}

    /// \return the least scaled Jacobian
    double run() {
        move_to_model();
        double least = late_() ? minimum() : raise(false, 30);
        constexpr int most_rings = 4;
        for (int slice = 0, rings = 2; slice < 7 && least < enough() && !late_(); ++slice) {
            const double before = least;
            least = raise(true, 20, rings);
            if (!(least > before + 1e-3) && (least >= options_.sufficient || ++rings > most_rings)) {
                break;
            }
        }
        least = finish(least);
        for (const Index i : left_) {
            places_.on[i] = {0, -1, Vec2::Zero()};
        }
        return least;
    }

private:
    /// What the next better mesh is not worth the time for.
    [[nodiscard]] double enough() const { return std::max(0.3, options_.sufficient); }

    [[nodiscard]] double quality(std::size_t h) const { return scaled_jacobian(mesh_, h); }

    [[nodiscard]] double minimum() const { return least_scaled_jacobian(mesh_); }

    /// All nodes whose move leaves the hexahedra positive, the others as far as they can once there is more room.
    void move_to_model() {
        for (std::size_t i = 0; i < mesh_.nodes.size(); ++i) {
            if (places_.wanted[i] != places_.straight[i]) {
                left_.push_back(static_cast<Index>(i));
            }
        }
        constexpr int rounds = 6;
        static_cast<void>(advance());
        for (int round = 0; round < rounds && !left_.empty() && !late_(); ++round) {
            static_cast<void>(raise(false, 10));
            if (advance() == 0) {
                break;
            }
        }
    }

    /// The last try for nodes that are left, unless that costs more than it is worth.
    double finish(double least) {
        const std::vector<Vec3> saved = mesh_.nodes;
        const std::vector<Index> left = left_;
        if (left_.empty() || late_() || advance(true) == 0) {
            return least;
        }
        const double now = raise(true, 10);
        if (now >= std::min(least, options_.sufficient) || (left_.empty() && now >= 0.5 * least)) {
            return now;
        }
        mesh_.nodes = saved;
        left_ = left;
        return least;
    }

    /// Moves the nodes that are left the whole way, or a half or a quarter of it, unless a hexahedron falls below a
    /// limit. \return how many nodes arrived
    std::size_t advance(bool whole_way = false) {
        constexpr double least = 0.02;
        const std::size_t before = left_.size();
        for (const double part : {1.0, 0.5, 0.25}) {
            if (left_.empty() || (whole_way && part < 1.0)) {
                break;
            }
            std::vector<double> limit(mesh_.hexes.size());
            for (std::size_t h = 0; h < limit.size(); ++h) {
                limit[h] = std::min(least, 0.5 * quality(h));
            }
            const std::vector<Vec3> saved = mesh_.nodes;
            std::vector<char> moved(mesh_.nodes.size(), 0);
            for (const Index i : left_) {
                moved[i] = 1;
                mesh_.nodes[i] =
                    part == 1.0 ? places_.wanted[i] : Vec3(saved[i] + part * (places_.wanted[i] - saved[i]));
            }
            for (bool changed = true; changed;) {
                changed = false;
                for (std::size_t h = 0; h < limit.size(); ++h) {
                    const HexCorners& hex = mesh_.hexes[h];
                    const bool any = std::any_of(hex.begin(), hex.end(), [&](Index i) { return moved[i] != 0; });
                    if (!any || quality(h) >= limit[h]) {
                        continue;
                    }
                    for (const Index i : hex) {
                        mesh_.nodes[i] = saved[i];
                        changed = changed || moved[i] != 0;
                        moved[i] = 0;
                    }
                }
            }
            if (part == 1.0) {
                std::erase_if(left_, [&](Index i) { return moved[i] != 0; });
            }
        }
        return before - left_.size();
    }

    /// improve_hexes() with the boundary fixed, or sliding. \return the least scaled Jacobian
    double raise(bool sliding, double effort, int rings = 2) {
        ImproveOptions own;
        own.target = 0.5;
        own.sufficient = enough();
        own.effort = effort;
        own.rings = rings;
        own.execution = options_.execution;
        const std::span<Vec3> nodes(mesh_.nodes);
        const std::span<const HexCorners> hexes(mesh_.hexes);
        if (sliding) {
            std::vector<NodeEntity> on = places_.on;
            for (const Index i : left_) {
                on[i] = {0, -1, Vec2::Zero()};
            }
            const EntityGuide guide(b_, std::move(on), 1e-8 * options_.size);
            return improve_hexes(nodes, hexes, guide, own).min_det_after;
        }
        std::vector<std::uint8_t> fixed(nodes.size());
        for (std::size_t i = 0; i < fixed.size(); ++i) {
            fixed[i] = places_.on[i].dimension < 3 ? 1 : 0;
        }
        return improve_hexes(nodes, hexes, FixedNodes{fixed}, own).min_det_after;
    }

    const AnyModel& b_;
    const SplitOptions& options_;
    const std::function<bool()>& late_;
    HexMesh& mesh_;
    SplitPlaces& places_;
    std::vector<Index> left_;  ///< nodes that are not where the model wants them, ascending
};

/// What is tried, the first as a rule sufficient: lengths in parts of twice the wished one.
[[nodiscard]] inline std::vector<std::pair<TetSizes, bool>> split_candidates(const AnyModel& b,
                                                                             const SplitOptions& options) {
    struct Candidate {
        double size, least;
        double turn;  ///< part of the largest angle
        int variant;
        bool thin = false;  ///< shorter where the solid is thin
    };
    constexpr std::array<Candidate, 11> candidates{{{1.0, 0.35, 1.0, 0},
                                                    {1.0, 0.35, 1.0, 0, true},
                                                    {0.9, 0.35, 1.0, 0},
                                                    {1.1, 0.5, 1.0, 0},
                                                    {0.75, 0.35, 1.0, 1},
                                                    {1.4, 0.5, 1.0, 0},
                                                    {0.8, 0.35, 1.0, 0, true},
                                                    {1.3, 0.4, 1.0, 1},
                                                    {2.0, 0.5, 1.0, 0},
                                                    {0.6, 0.3, 0.75, 0},
                                                    {0.45, 0.25, 0.5, 2}}};
    std::vector<std::pair<TetSizes, bool>> result;
    for (const Candidate& c : candidates) {
        TetSizes sizes;
        const double part = 2 * c.size;
        sizes.size = part * options.size;
        sizes.least = c.least * sizes.size;
        sizes.per_turn = std::max(6, static_cast<int>(std::ceil(180.0 / (c.turn * options.max_angle) - 1e-9)));
        sizes.variant = c.variant;
        sizes.stop = options.execution.stop;
        const auto add = [&](int dimension, std::size_t index, const std::map<int, double>& given, auto& own, auto id) {
            if (const std::optional<double> length = size_by_tag(b, dimension, index, given)) {
                id.value = static_cast<std::int32_t>(index);
                own[id] = part * *length;
                sizes.least = std::min(sizes.least, c.least * own[id]);
            }
        };
        for (std::size_t e = 0; e < b.edge_count() && !options.local.edge.empty(); ++e) {
            add(1, e, options.local.edge, sizes.edge, EdgeId{});
        }
        for (std::size_t f = 0; f < b.face_count() && !options.local.face.empty(); ++f) {
            add(2, f, options.local.face, sizes.face, FaceId{});
        }
        for (std::size_t s = 0; s < b.solid_count() && !options.local.solid.empty(); ++s) {
            add(3, s, options.local.solid, sizes.solid, SolidId{});
        }
        result.emplace_back(std::move(sizes), c.thin);
    }
    return result;
}

/// Where the solids are thinner than the wished length, by inner edges between two nodes of the boundary and by short
/// edges of the model: lengths that leave room for a shape. At most one in a cell of half that length.
[[nodiscard]] inline std::vector<TetSizeAt> thin_places(const TaggedTetMesh& tets, double size, double least) {
    constexpr double longer = 2.5;  // than it is thick
    using Edge = std::pair<Index, Index>;
    const std::vector<Vec3>& x = tets.mesh.nodes;
    const auto edge_of = [](Index i, Index j) { return Edge(std::min(i, j), std::max(i, j)); };
    std::vector<char> boundary(x.size(), 0);
    std::set<Edge> along, features;
    for (const TaggedTriangle& t : tets.triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            boundary[t.nodes[k]] = 1;
            along.insert(edge_of(t.nodes[k], t.nodes[(k + 1) % 3]));
        }
    }
    for (const TaggedEdge& e : tets.edges) {
        features.insert(edge_of(e.nodes[0], e.nodes[1]));
    }
    std::map<std::array<long, 3>, TetSizeAt> cells;
    for (const TetCorners& c : tets.mesh.tets) {
        for (const auto& local : tet_edges) {
            const Index i = c[static_cast<std::size_t>(local[0])], j = c[static_cast<std::size_t>(local[1])];
            const double length = longer * (x[i] - x[j]).norm();
            const Edge edge = edge_of(i, j);
            const bool across = boundary[i] != 0 && boundary[j] != 0 && !along.contains(edge);
            if (length >= size || !(across || features.contains(edge))) {
                continue;
            }
            const TetSizeAt at{(x[i] + x[j]) / 2.0, std::max(length, least)};
            std::array<long, 3> cell{};
            for (std::size_t k = 0; k < 3; ++k) {
                cell[k] = std::lround(at.point[static_cast<Eigen::Index>(k)] / (0.5 * size));
            }
            const auto [known, first] = cells.emplace(cell, at);
            if (!first && at.size < known->second.size) {
                known->second = at;
            }
        }
    }
    std::vector<TetSizeAt> result;
    for (const auto& [cell, at] : cells) {
        result.push_back(at);
    }
    return result;
}

/// "0.15 at edge 12, where 24 tetrahedra meet".
[[nodiscard]] inline std::string split_limit(const AnyModel& b, const SplitSolids& mesh, std::size_t tet_nodes) {
    double least = 2;
    Index worst = 0;
    for (const HexCorners& hex : mesh.mesh.hexes) {
        for (std::size_t k = 0; k < 8; ++k) {
            std::array<Vec3, 3> u;
            for (std::size_t n = 0; n < 3; ++n) {
                const auto next = static_cast<std::size_t>(hex_corner_neighbours[k][n]);
                u[n] = (mesh.mesh.nodes[hex[next]] - mesh.mesh.nodes[hex[k]]).normalized();
            }
            if (const double det = u[0].cross(u[1]).dot(u[2]); det < least) {
                least = det;
                worst = hex[k];
            }
        }
    }
    std::ostringstream text;
    text.precision(3);
    text << least;
    const NodeEntity& on = mesh.on[worst];
    constexpr std::array<const char*, 4> names{"vertex ", "edge ", "face ", "inside solid "};
    if (on.id >= 0) {
        const auto dimension = static_cast<std::size_t>(on.dimension);
        text << (dimension == 3 ? " " : " at ") << names[dimension]
             << b.tag(on.dimension, static_cast<std::size_t>(on.id));
    }
    if (worst < tet_nodes) {
        const auto count = std::count_if(mesh.mesh.hexes.begin(), mesh.mesh.hexes.end(),
                                         [&](const HexCorners& hex) { return hex[0] == worst; });
        text << ", where " << count << " tetrahedra meet";
    }
    return text.str();
}

/// Tetrahedra flipped for the sake of what they are split into.
inline void connect_better(SolidsTets& tets, const std::stop_token& stop) {
    FlipOptions own;
    own.stop = stop;
    FlippedTets flipped = flip_tets(tets.tets, own);
    std::vector<SolidId> solids;
    for (const Index t : flipped.origin) {
        solids.push_back(tets.tet_solid[t]);
    }
    tets.tets.mesh.tets = std::move(flipped.tets);
    tets.tet_solid = std::move(solids);
}

/// The mesh of one attempt, whose least scaled Jacobian and nodes that are off are noted.
[[nodiscard]] inline SplitSolids split_attempt(const AnyModel& b, const SplitOptions& options, const SolidsTets& tets,
                                               const std::function<bool()>& late, SplitAttempt& attempt) {
    SplitTets split = split_tets(tets.tets, options.execution);
    attempt.split_jacobian = hex_quality(split.mesh, {10, options.execution}).scaled_jacobian.min;
    SplitPlaces places = SplitPlacer(b, tets, split).run();
    attempt.min_jacobian = SplitImprover(b, options, late, split.mesh, places).run();
    SplitSolids made;
    made.mesh = std::move(split.mesh);
    for (const SolidId solid : tets.tet_solid) {
        made.hex_solid.insert(made.hex_solid.end(), 4, solid);
    }
    made.quads = std::move(split.quads);
    for (const std::int32_t face : split.quad_tags) {
        made.quad_face.push_back(FaceId{face});
    }
    attempt.off = static_cast<std::size_t>(std::count_if(
        places.on.begin(), places.on.end(), [](const NodeEntity& on) { return on.dimension == 0 && on.id < 0; }));
    made.on = std::move(places.on);
    if (attempt.min_jacobian < options.sufficient) {
        made.limit = split_limit(b, made, tets.tets.mesh.nodes.size());
    }
    return made;
}

}  // namespace detail

PAVIOR_INLINE SplitSolids split_solids(const AnyModel& b, std::span<const SolidId> solids, const SplitOptions& options,
                                       const TetMesher& mesher) {
    const auto positive = [](double value) { return value > 0 && std::isfinite(value); };
    if (!positive(options.size) || !positive(options.max_angle)) {
        throw InputError(ErrorCode::bad_option, "the size and the largest angle must be positive");
    }
    const Stopwatch watch;
    const double limit = 0.65 * options.seconds;  // the rest is for what follows
    const std::function<bool()> late = [&] { return limit > 0 && watch.total() > limit; };
    const auto score = [&](const SplitAttempt& a) {
        return std::tuple(a.off == 0 && a.min_jacobian >= options.sufficient, a.off == 0, a.min_jacobian);
    };
    SplitSolids best;
    std::vector<SplitAttempt> attempts;
    double last = 0;                  // seconds of the last attempt
    std::optional<SolidsTets> first;  // tetrahedra without regard to thickness
    for (const auto& [sizes, thin] : detail::split_candidates(b, options)) {
        check_stop(options.execution.stop);
        const bool has_mesh = !best.mesh.hexes.empty();
        if (has_mesh && std::get<0>(score(attempts[best.taken]))) {
            break;
        }
        const double begin = watch.total();
        if (limit > 0 && !attempts.empty() && begin + (has_mesh ? 1.5 * last : 0.0) > limit) {
            best.out_of_time = true;
            break;
        }
        SplitAttempt attempt;
        attempt.sizes = sizes;
        if (thin) {
            constexpr double thinnest = 0.15;
            const double least = thinnest * sizes.size;
            attempt.sizes.near = first ? detail::thin_places(first->tets, sizes.size, least) : std::vector<TetSizeAt>{};
            attempt.sizes.least = std::min(sizes.least, least);
            if (attempt.sizes.near.empty()) {
                continue;
            }
        }
        attempt.sizes.seconds = limit > 0 ? std::max((has_mesh ? 0.5 : 0.7) * (limit - begin), 0.01) : 0;
        try {
            SolidsTets tets = mesher(solids, attempt.sizes);
            if (!first) {
                first = tets;
            }
            detail::connect_better(tets, options.execution.stop);
            attempt.tets = tets.tets.mesh.tets.size();
            if (options.max_hexahedra > 0 && 4.0 * static_cast<double>(attempt.tets) > options.max_hexahedra) {
                throw UnmeshableError(ErrorCode::tetrahedra_failed,
                                      std::to_string(4 * attempt.tets) + " hexahedra are more than the limit");
            }
            SplitSolids made = detail::split_attempt(b, options, tets, late, attempt);
            if (!has_mesh || score(attempt) > score(attempts[best.taken])) {
                made.taken = attempts.size();
                best = std::move(made);
            }
        } catch (const Stopped&) {
            throw;
        } catch (const Error& error) {
            attempt.error = error.what();
        }
        last = watch.total() - begin;
        attempts.push_back(std::move(attempt));
    }
    if (best.mesh.hexes.empty()) {
        std::string reasons;
        for (const SplitAttempt& attempt : attempts) {
            if (reasons.find(attempt.error) == std::string::npos) {
                reasons += (reasons.empty() ? "" : "; ") + attempt.error;
            }
        }
        throw UnmeshableError(ErrorCode::tetrahedra_failed, "no tetrahedra to split: " + reasons);
    }
    best.attempts = std::move(attempts);
    return best;
}

}  // namespace pavior
