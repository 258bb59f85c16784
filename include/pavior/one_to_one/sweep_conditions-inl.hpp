#pragma once

#include <pavior/one_to_one/side_roles.hpp>
#include <pavior/one_to_one/sweep_conditions.hpp>

#include <algorithm>
#include <cstddef>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace pavior {

namespace detail {

/// How a face meets the two caps.
struct CapContact {
    std::size_t source_runs = 0, target_runs = 0;  ///< chains of its boundary that lie on the cap
    bool source_vertex = false, target_vertex = false;
};

PAVIOR_INLINE std::set<VertexId> face_vertices(const SolidBoundary& solid, std::size_t face) {
    std::set<VertexId> result;
    for (std::size_t h = solid.faces[face].begin; h < solid.faces[face].end; ++h) {
        result.insert(solid.half_edges[h].start);
    }
    return result;
}

PAVIOR_INLINE std::size_t chains_along(const SolidBoundary& solid, std::size_t face, std::size_t cap) {
    std::size_t runs = 0;
    for (const std::size_t first : solid.faces[face].loops) {
        std::size_t inside = 0, starts = 0;
        for (const std::size_t h : solid.loop_from(first)) {
            const bool on = solid.twin_face(h) == cap;
            inside += on ? 1 : 0;
            starts += !on && solid.twin_face(solid.half_edges[h].next) == cap ? 1U : 0U;
        }
        runs += inside != 0 && starts == 0 ? 1 : starts;
    }
    return runs;
}

PAVIOR_INLINE bool caps_fit(const SolidBoundary& solid, std::size_t source, std::size_t target) {
    const SolidBoundary::Face &s = solid.faces[source], &t = solid.faces[target];
    if (s.loops.empty() || s.loops.size() != t.loops.size() || s.seam || t.seam) {
        return false;
    }
    const std::set<VertexId> vertices = face_vertices(solid, source);
    for (std::size_t h = t.begin; h < t.end; ++h) {
        if (vertices.contains(solid.half_edges[h].start)) {
            return false;
        }
    }
    return true;
}

/// The obstacles in one line, faces with the same fate together.
[[nodiscard]] inline std::string obstacle_text(const std::vector<SweepObstacle>& obstacles) {
    std::string text;
    std::vector<bool> done(obstacles.size(), false);
    for (std::size_t i = 0; i < obstacles.size(); ++i) {
        if (done[i]) {
            continue;
        }
        std::set<int> tags;
        for (std::size_t j = i; j < obstacles.size(); ++j) {
            if (obstacles[j].condition == obstacles[i].condition && obstacles[j].reason == obstacles[i].reason) {
                done[j] = true;
                tags.insert(obstacles[j].tag);
            }
        }
        text += (text.empty() ? "" : "; ") + std::string(tags.size() == 1 ? "face" : "faces");
        for (const int tag : tags) {
            text += (tag == *tags.begin() ? " " : ", ") + std::to_string(tag);
        }
        text += ": " + obstacles[i].reason + " (condition " + numeral(obstacles[i].condition) + ")";
    }
    return text;
}

PAVIOR_INLINE std::vector<SweepObstacle> ObstacleFinder::find() {
    caps();
    for (std::size_t face = 0; face < solid_.faces.size(); ++face) {
        if (face != source_ && face != target_) {
            side(face);
        }
    }
    if (obstacles_.empty()) {
        rings();
    }
    return std::move(obstacles_);
}

PAVIOR_INLINE void ObstacleFinder::caps() {
    const SolidBoundary::Face &s = solid_.faces[source_], &t = solid_.faces[target_];
    for (const std::size_t cap : {source_, target_}) {
        if (solid_.faces[cap].seam) {
            add(SweepCondition::equal_caps, cap, "closed in itself by a seam edge, cannot be a cap");
        } else if (solid_.faces[cap].loops.empty()) {
            add(SweepCondition::equal_caps, cap, "no boundary, cannot be a cap");
        }
    }
    if (s.loops.size() != t.loops.size()) {
        add(SweepCondition::equal_caps, target_,
            std::to_string(t.loops.size()) + " loops, but " + std::to_string(s.loops.size()) + " on the source");
    }
    if (chains_along(solid_, source_, target_) != 0) {
        add(SweepCondition::one_source_one_target, target_,
            "an edge in common with the source, no room for a linking side between them");
    } else if (share_vertex(source_, target_)) {
        add(SweepCondition::one_source_one_target, target_,
            "a vertex in common with the source, no room for a rib between them");
    }
}

PAVIOR_INLINE void ObstacleFinder::side(std::size_t face) {
    const SolidBoundary::Face& f = solid_.faces[face];
    const std::size_t bottoms = chains_along(solid_, face, source_), tops = chains_along(solid_, face, target_);
    if (f.loops.size() != 1) {
        add(SweepCondition::four_logical_sides, face,
            std::to_string(f.loops.size()) + " boundary loops where a linking side has one");
    } else if (bottoms > 1 || tops > 1) {
        add(SweepCondition::four_logical_sides, face,
            std::string("contact with the ") + (bottoms > 1 ? "source" : "target") + " along " +
                std::to_string(std::max(bottoms, tops)) + " separate chains");
    } else if (bottoms == 0 && tops == 0) {
        add(SweepCondition::one_source_one_target, face, "no contact with source or target, would be a further cap");
    } else if (bottoms == 0 || tops == 0) {
        one_cap_only(face, bottoms == 0 ? source_ : target_);
    }
}

PAVIOR_INLINE void ObstacleFinder::one_cap_only(std::size_t face, std::size_t missing) {
    const std::string cap = missing == source_ ? "source" : "target";
    if (share_vertex(face, missing)) {
        add(SweepCondition::four_logical_sides, face, "three logical sides, only a vertex on the " + cap);
    } else {
        add(SweepCondition::one_source_one_target, face, "no edge on the " + cap);
    }
}

PAVIOR_INLINE SweepRefusal too_few_faces(const SolidBoundary& solid) {
    SweepRefusal refusal;
    const std::string reason =
        "one of only " + std::to_string(solid.faces.size()) + " faces, too few for source, target and linking side";
    if (!solid.faces.empty()) {
        refusal.obstacles.push_back(
            {SweepCondition::one_source_one_target, solid.faces[0].face.face, solid.faces[0].tag, reason});
    }
    refusal.text = obstacle_text(refusal.obstacles);
    return refusal;
}

/// How badly a pair fails: caps that touch, other defects of the caps, unfit side faces.
[[nodiscard]] inline std::tuple<std::size_t, std::size_t, std::size_t> badness(const SolidBoundary& solid,
                                                                               std::size_t source, std::size_t target) {
    const SolidBoundary::Face &s = solid.faces[source], &t = solid.faces[target];
    const std::set<VertexId> vertices = face_vertices(solid, source);
    std::size_t touching = 0;
    for (std::size_t h = t.begin; h < t.end; ++h) {
        touching = vertices.contains(solid.half_edges[h].start) ? 1 : touching;
    }
    const std::size_t caps = (s.seam ? 1U : 0U) + (t.seam ? 1U : 0U) + (s.loops.size() != t.loops.size() ? 1U : 0U) +
                             (s.loops.empty() || t.loops.empty() ? 1U : 0U);
    std::size_t sides = 0;
    for (std::size_t face = 0; face < solid.faces.size(); ++face) {
        if (face != source && face != target) {
            const bool fits = solid.faces[face].loops.size() == 1 && chains_along(solid, face, source) == 1 &&
                              chains_along(solid, face, target) == 1;
            sides += fits ? 0 : 1;
        }
    }
    return {touching, caps + sides, caps};
}

PAVIOR_INLINE std::vector<std::pair<std::size_t, std::size_t>> closest_pairs(const SolidBoundary& solid,
                                                                             std::size_t count) {
    using Entry = std::tuple<std::tuple<std::size_t, std::size_t, std::size_t>, std::size_t, std::size_t>;
    std::vector<Entry> entries;
    for (std::size_t i = 0; i < solid.faces.size(); ++i) {
        for (std::size_t j = i + 1; j < solid.faces.size(); ++j) {
            entries.emplace_back(badness(solid, i, j), i, j);
        }
    }
    count = std::min(count, entries.size());
    std::partial_sort(entries.begin(), entries.begin() + static_cast<std::ptrdiff_t>(count), entries.end());
    std::vector<std::pair<std::size_t, std::size_t>> result;
    for (std::size_t i = 0; i < count; ++i) {
        result.emplace_back(std::get<1>(entries[i]), std::get<2>(entries[i]));
    }
    return result;
}

PAVIOR_INLINE UnmeshableError not_sweepable_error(const SolidBoundary& solid,
                                                  const std::vector<SweepRefusal>& refusals) {
    std::string text = "solid " + std::to_string(solid.tag) + " is no one-to-one sweep";
    Error::Ids ids;
    for (const SweepRefusal& refusal : refusals) {
        text += "\n  " + refusal.text;
        for (const SweepObstacle& obstacle : refusal.obstacles) {
            if (std::find(ids.begin(), ids.end(), obstacle.tag) == ids.end()) {
                ids.push_back(obstacle.tag);
            }
        }
    }
    return {ErrorCode::not_sweepable, text, ids};
}

}  // namespace detail

PAVIOR_INLINE SweepRefusal make_refusal(const SolidBoundary& solid, std::size_t source, std::size_t target,
                                        std::vector<SweepObstacle> obstacles) {
    const SolidBoundary::Face &s = solid.faces[source], &t = solid.faces[target];
    std::string text = "from face " + std::to_string(s.tag) + " to face " + std::to_string(t.tag) + ": " +
                       detail::obstacle_text(obstacles);
    return {s.face.face, t.face.face, std::move(obstacles), std::move(text)};
}

}  // namespace pavior
