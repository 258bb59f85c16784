#pragma once

#include <pavior/one_to_one/side_roles.hpp>

#include <algorithm>
#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <vector>

namespace pavior {

namespace detail {

PAVIOR_INLINE std::vector<SideRole> direct_roles(const SolidBoundary& solid, std::size_t source, std::size_t target) {
    std::vector<SideRole> roles(solid.half_edges.size(), SideRole::none);
    for (std::size_t face = 0; face < solid.faces.size(); ++face) {
        const SolidBoundary::Face& f = solid.faces[face];
        if (face == source || face == target || f.loops.size() != 1) {
            continue;
        }
        const std::size_t n = f.end - f.begin;
        SideRole last = SideRole::none;
        for (std::size_t i = 0; i < 2 * n; ++i) {  // the second round knows what the first half-edges follow
            const std::size_t h = f.begin + i % n, cap = solid.twin_face(h);
            if (cap == source || cap == target) {
                roles[h] = cap == source ? SideRole::bottom : SideRole::top;
                last = cap == source ? SideRole::right : SideRole::left;
            } else {
                roles[h] = last;
            }
        }
    }
    return roles;
}

/// A face with one loop that shares an edge with either cap.
[[nodiscard]] inline bool reaches(const SolidBoundary& solid, std::size_t face, std::size_t source,
                                  std::size_t target) {
    const SolidBoundary::Face& f = solid.faces[face];
    bool on_source = false, on_target = false;
    for (std::size_t h = f.begin; h < f.end; ++h) {
        on_source = on_source || solid.twin_face(h) == source;
        on_target = on_target || solid.twin_face(h) == target;
    }
    return f.loops.size() == 1 && on_source && on_target;
}

PAVIOR_INLINE std::optional<LinkingSide> side_from_roles(const SolidBoundary& solid, std::size_t face,
                                                         const std::vector<SideRole>& roles) {
    const SolidBoundary::Face& f = solid.faces[face];
    const std::size_t n = f.end - f.begin;
    const auto role = [&](std::size_t i) { return roles[f.begin + i % n]; };
    std::size_t start = n;
    int turns = 0;
    bool rectangle = true;
    bool seam = false;
    for (std::size_t i = 0; i < n; ++i) {
        const int turn = quarter_turn(role(i + n - 1), role(i));
        if (role(i) == SideRole::none || turn == 2) {
            return std::nullopt;
        }
        turns += turn;
        rectangle = rectangle && turn >= 0;
        seam = seam || solid.twin_face(f.begin + i) == face;
        start = start == n && turn == 1 && role(i) == SideRole::bottom ? i : start;
    }
    if (turns != 4 || start == n || (seam && !rectangle)) {
        return std::nullopt;
    }
    LinkingSide side{f.face.face, f.face.outward, {}, {}, {}, {}, {}};
    EdgeChain* const chains[] = {&side.bottom, &side.right, &side.top, &side.left};
    for (std::size_t i = start; i < start + n; ++i) {
        const OrientedEdge use = solid.half_edges[f.begin + i % n].use;
        chains[static_cast<int>(role(i))]->push_back(use);
        if (!rectangle) {
            side.outline.emplace_back(use, role(i));
        }
    }
    side.top = reversed(side.top);
    side.left = reversed(side.left);
    return side;
}

/// The linking surface round one loop of the source, as face positions: from the source upwards.
struct LinkingRing {
    std::vector<std::size_t> faces;
    std::size_t target_loop = 0;
};

/// Roles on the boundary of one solid, between two caps (positions in solid.faces).
class RoleChecker {
public:
    RoleChecker(const SolidBoundary& solid, std::size_t source, std::size_t target, const std::vector<SideRole>& roles)
        : solid_(solid), source_(source), target_(target), roles_(roles) {}

    /// Both half-edges of each edge agree, and no vertex is a singular point of the grid.
    [[nodiscard]] bool regular() const {
        std::map<VertexId, std::pair<int, bool>> quarters;
        for (std::size_t h = 0; h < solid_.half_edges.size(); ++h) {
            const SolidBoundary::HalfEdge& edge = solid_.half_edges[h];
            auto& [sum, on_cap] = quarters[edge.start];
            if (is_cap(edge.face)) {
                on_cap = true;
                continue;
            }
            if (!is_cap(solid_.twin_face(h)) && roles_[edge.twin] != opposite(roles_[h])) {
                return false;
            }
            sum += 2 - quarter_turn(roles_[previous(h)], roles_[h]);
        }
        return std::all_of(quarters.begin(), quarters.end(),
                           [](const auto& entry) { return entry.second.first == (entry.second.second ? 2 : 4); });
    }

    /// The faces round the source loop that starts at half-edge \p first, ordered from the source upwards and along the
    /// loop; nothing if they do not form a ring from this loop to exactly one loop of the target.
    [[nodiscard]] std::optional<LinkingRing> ring(std::size_t first) const {
        LinkingRing result;
        std::set<std::size_t> seen;
        for (const std::size_t h : cap_loop(source_, first)) {
            visit(solid_.twin_face(h), seen, result.faces);
        }
        const std::size_t bottoms = result.faces.size();
        collect(seen, result.faces);
        if (!is_ring(result, solid_.half_edges[first].loop) || !sort_upwards(result.faces, bottoms)) {
            return std::nullopt;
        }
        return result;
    }

    /// The half-edges of a cap's loop in the order of the sweep's sense, from \p first on: against the half-edges at
    /// the source, along them at the target.
    [[nodiscard]] std::vector<std::size_t> cap_loop(std::size_t cap, std::size_t first) const {
        std::vector<std::size_t> loop = solid_.loop_from(first);
        if (cap == source_) {
            std::reverse(loop.begin() + 1, loop.end());
        }
        return loop;
    }

private:
    [[nodiscard]] bool is_cap(std::size_t face) const { return face == source_ || face == target_; }

    [[nodiscard]] std::size_t previous(std::size_t h) const {
        const SolidBoundary::Face& f = solid_.faces[solid_.half_edges[h].face];
        return h == f.begin ? f.end - 1 : h - 1;  // a linking side has one loop
    }

    static void visit(std::size_t face, std::set<std::size_t>& seen, std::vector<std::size_t>& faces) {
        if (seen.insert(face).second) {
            faces.push_back(face);
        }
    }

    /// Adds all linking faces connected to those in \p faces.
    void collect(std::set<std::size_t>& seen, std::vector<std::size_t>& faces) const {
        for (std::size_t i = 0; i < faces.size(); ++i) {
            const SolidBoundary::Face& f = solid_.faces[faces[i]];
            for (std::size_t h = f.begin; h < f.end; ++h) {
                if (!is_cap(solid_.twin_face(h))) {
                    visit(solid_.twin_face(h), seen, faces);
                }
            }
        }
    }

    /// Euler characteristic 0, one loop of the source (\p source_loop), one of the target.
    [[nodiscard]] bool is_ring(LinkingRing& ring, std::size_t source_loop) const {
        std::set<VertexId> vertices;
        std::set<EdgeId> edges;
        std::set<std::size_t> target_loops;
        for (const std::size_t face : ring.faces) {
            for (std::size_t h = solid_.faces[face].begin; h < solid_.faces[face].end; ++h) {
                vertices.insert(solid_.half_edges[h].start);
                edges.insert(solid_.half_edges[h].use.edge);
                const SolidBoundary::HalfEdge& twin = solid_.half_edges[solid_.half_edges[h].twin];
                if (twin.face == source_ && twin.loop != source_loop) {
                    return false;
                }
                if (twin.face == target_) {
                    target_loops.insert(twin.loop);
                }
            }
        }
        if (target_loops.size() != 1 || vertices.size() + ring.faces.size() != edges.size()) {
            return false;
        }
        ring.target_loop = *target_loops.begin();
        return true;
    }

    /// Orders faces so that each one comes after those below it, the first \p bottoms (those on the source) first where
    /// nothing else is below them; false if sides lie above each other in a circle, but for one with a corner of 270
    /// degrees, which may be below and above another: it comes after one that it meets.
    [[nodiscard]] bool sort_upwards(std::vector<std::size_t>& faces, std::size_t bottoms) const {
        std::map<std::size_t, std::size_t> waiting;  // faces below that are not placed yet
        for (const std::size_t face : faces) {
            waiting[face] = neighbours(face, SideRole::bottom).size();
        }
        std::vector<std::size_t> queue, sorted;
        for (std::size_t i = 0; i < bottoms; ++i) {
            if (waiting[faces[i]] == 0) {
                queue.push_back(faces[i]);
            }
        }
        for (bool grown = true; grown;) {
            while (sorted.size() < queue.size()) {
                sorted.push_back(queue[sorted.size()]);
                waiting[sorted.back()] = 0;
                for (const std::size_t upper : neighbours(sorted.back(), SideRole::top)) {
                    if (waiting[upper] > 0 && --waiting[upper] == 0) {
                        queue.push_back(upper);
                    }
                }
            }
            const auto stuck = std::find_if(faces.begin(), faces.end(), [&](std::size_t face) {
                return waiting[face] > 0 && !convex(face) && meets_one_of(face, sorted);
            });
            grown = stuck != faces.end();
            if (grown) {
                queue.push_back(*stuck);
            }
        }
        const bool complete = sorted.size() == faces.size();
        faces = std::move(sorted);
        return complete;
    }

    /// No corner of 270 degrees.
    [[nodiscard]] bool convex(std::size_t face) const {
        const SolidBoundary::Face& f = solid_.faces[face];
        for (std::size_t h = f.begin; h < f.end; ++h) {
            if (quarter_turn(roles_[previous(h)], roles_[h]) < 0) {
                return false;
            }
        }
        return true;
    }

    /// The face shares an edge with the source or with one of \p placed.
    [[nodiscard]] bool meets_one_of(std::size_t face, const std::vector<std::size_t>& placed) const {
        for (std::size_t h = solid_.faces[face].begin; h < solid_.faces[face].end; ++h) {
            const std::size_t other = solid_.twin_face(h);
            if (other == source_ || std::find(placed.begin(), placed.end(), other) != placed.end()) {
                return true;
            }
        }
        return false;
    }

    /// The linking faces across the edges of a face that have a role.
    [[nodiscard]] std::set<std::size_t> neighbours(std::size_t face, SideRole role) const {
        std::set<std::size_t> result;
        for (std::size_t h = solid_.faces[face].begin; h < solid_.faces[face].end; ++h) {
            if (roles_[h] == role && !is_cap(solid_.twin_face(h))) {
                result.insert(solid_.twin_face(h));
            }
        }
        return result;
    }

    const SolidBoundary& solid_;
    std::size_t source_, target_;
    const std::vector<SideRole>& roles_;
};

PAVIOR_INLINE EdgeLoop cap_edges(const SolidBoundary& solid, const std::vector<std::size_t>& half_edges, bool source,
                                 const OrientedEdge& begin) {
    EdgeLoop loop;
    for (const std::size_t h : half_edges) {
        const OrientedEdge use = solid.half_edges[h].use;
        loop.push_back(source ? OrientedEdge{use.edge, !use.forward} : use);
    }
    if (const auto at = std::find(loop.begin(), loop.end(), begin); at != loop.end()) {
        std::rotate(loop.begin(), at, loop.end());
    }
    return loop;
}

/// Adds the linking sides round the source loop that starts at half-edge \p first, and the two cap loops. Returns the
/// loop of the target, or nothing if the sides do not form a ring.
[[nodiscard]] inline std::optional<std::size_t> add_ring(const SolidBoundary& solid, const RoleChecker& checker,
                                                         const std::vector<SideRole>& roles, std::size_t source,
                                                         std::size_t target, std::size_t first, SweepTopology& sweep) {
    const std::optional<LinkingRing> ring = checker.ring(first);
    if (!ring) {
        return std::nullopt;
    }
    std::vector<LinkingSide>& sides = sweep.loops.emplace_back();
    for (const std::size_t face : ring->faces) {
        std::optional<LinkingSide> side = side_from_roles(solid, face, roles);
        if (!side) {
            return std::nullopt;
        }
        sides.push_back(std::move(*side));
        sweep.stacked = sweep.stacked || !reaches(solid, face, source, target);
    }
    const std::size_t top = solid.faces[target].loops[ring->target_loop];
    sweep.source_loops.push_back(cap_edges(solid, checker.cap_loop(source, first), true, sides[0].bottom[0]));
    EdgeLoop loop = cap_edges(solid, checker.cap_loop(target, top), false, {});
    for (const LinkingSide& side : sides) {
        if (const auto at = std::find(loop.begin(), loop.end(), side.top[0]); at != loop.end()) {
            std::rotate(loop.begin(), at, loop.end());
            break;
        }
    }
    sweep.target_loops.push_back(std::move(loop));
    return ring->target_loop;
}

PAVIOR_INLINE std::optional<SweepTopology> sweep_from_roles(const SolidBoundary& solid, std::size_t source,
                                                            std::size_t target, const std::vector<SideRole>& roles) {
    const RoleChecker checker(solid, source, target, roles);
    if (!checker.regular()) {
        return std::nullopt;
    }
    const SolidBoundary::Face &s = solid.faces[source], &t = solid.faces[target];
    SweepTopology sweep;
    sweep.solid = solid.solid;
    sweep.source = s.face.face;
    sweep.target = t.face.face;
    sweep.source_outward = s.face.outward;
    sweep.target_outward = t.face.outward;
    std::size_t faces = 2;
    std::set<std::size_t> reached;
    for (const std::size_t first : s.loops) {
        const auto target_loop = add_ring(solid, checker, roles, source, target, first, sweep);
        if (!target_loop || !reached.insert(*target_loop).second) {
            return std::nullopt;
        }
        faces += sweep.loops.back().size();
    }
    if (faces != solid.faces.size() || reached.size() != t.loops.size()) {
        return std::nullopt;
    }
    return sweep;
}

PAVIOR_INLINE std::optional<SweepTopology> find_direct_sweep(const SolidBoundary& solid, std::size_t source,
                                                             std::size_t target) {
    for (std::size_t face = 0; face < solid.faces.size(); ++face) {
        if (face != source && face != target && !reaches(solid, face, source, target)) {
            return std::nullopt;
        }
    }
    return sweep_from_roles(solid, source, target, direct_roles(solid, source, target));
}

}  // namespace detail

}  // namespace pavior
