#pragma once
/// \file
/// The conditions of section 2.1 \cite roca2009 for one pair of caps, and the words for a pair that breaks them.

#include <pavior/one_to_one/side_roles.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace pavior {

/// Conditions (i) to (iv) for a one-to-one sweep \cite roca2009 section 2.1.
enum class SweepCondition : std::uint8_t {
    equal_caps,             ///< (i) source and target are topologically equivalent
    four_logical_sides,     ///< (ii) linking sides are defined by four logical sides
    one_source_one_target,  ///< (iii) there is one source and one target
    one_axis                ///< (iv) there is one axis
};

/// The number of \p condition in section 2.1: "(i)" to "(iv)".
[[nodiscard]] constexpr const char* numeral(SweepCondition condition) {
    constexpr const char* names[] = {"(i)", "(ii)", "(iii)", "(iv)"};
    return names[static_cast<int>(condition)];
}

/// One reason why a pair of caps does not make a sweep.
struct SweepObstacle {
    SweepCondition condition = SweepCondition::equal_caps;
    FaceId face;         ///< the face that breaks the condition; a cap itself if the caps do not fit each other
    int tag = 0;         ///< its number as users know it
    std::string reason;  ///< e.g. "no edge on the target"
};

/// Why the solid is no sweep from \p source to \p target. Both are invalid if the solid has no pair of faces.
struct SweepRefusal {
    FaceId source, target;
    std::vector<SweepObstacle> obstacles;
    std::string text;  ///< all obstacles in one line, faces by the user's tags
};

namespace detail {

/// How a face meets the two caps.
struct CapContact {
    std::size_t source_runs = 0, target_runs = 0;  ///< chains of its boundary that lie on the cap
    bool source_vertex = false, target_vertex = false;
};

/// The vertices of a face.
[[nodiscard]] inline std::set<VertexId> face_vertices(const SolidBoundary& solid, std::size_t face) {
    std::set<VertexId> result;
    for (std::size_t h = solid.faces[face].begin; h < solid.faces[face].end; ++h) {
        result.insert(solid.half_edges[h].start);
    }
    return result;
}

/// Chains of the face's boundary that are shared with face \p cap.
[[nodiscard]] inline std::size_t chains_along(const SolidBoundary& solid, std::size_t face, std::size_t cap) {
    std::size_t runs = 0;
    for (const std::size_t first : solid.faces[face].loops) {
        std::size_t inside = 0, starts = 0;
        for (const std::size_t h : solid.loop_from(first)) {
            const bool on = solid.twin_face(h) == cap;
            inside += on ? 1 : 0;
            starts += !on && solid.twin_face(solid.half_edges[h].next) == cap ? 1 : 0;
        }
        runs += inside != 0 && starts == 0 ? 1 : starts;
    }
    return runs;
}

/// Condition on the caps alone: equally many loops (at least one), no seam, no common vertex.
[[nodiscard]] inline bool caps_fit(const SolidBoundary& solid, std::size_t source, std::size_t target) {
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

/// Finds what stands between the caps at two positions.
class ObstacleFinder {
public:
    ObstacleFinder(const SolidBoundary& solid, std::size_t source, std::size_t target)
        : solid_(solid), source_(source), target_(target) {}

    [[nodiscard]] std::vector<SweepObstacle> find() {
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

private:
    void add(SweepCondition condition, std::size_t face, std::string reason) {
        obstacles_.push_back({condition, solid_.faces[face].face.face, solid_.faces[face].tag, std::move(reason)});
    }

    void caps() {
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

    [[nodiscard]] bool share_vertex(std::size_t a, std::size_t b) const {
        const std::set<VertexId> first = face_vertices(solid_, a), second = face_vertices(solid_, b);
        return std::any_of(first.begin(), first.end(), [&](VertexId v) { return second.contains(v); });
    }

    void side(std::size_t face) {
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
            add(SweepCondition::one_source_one_target, face,
                "no contact with source or target, would be a further cap");
        } else if (bottoms == 0 || tops == 0) {
            one_cap_only(face, bottoms == 0 ? source_ : target_);
        }
    }

    void one_cap_only(std::size_t face, std::size_t missing) {
        const std::string cap = missing == source_ ? "source" : "target";
        if (share_vertex(face, missing)) {
            add(SweepCondition::four_logical_sides, face, "three logical sides, only a vertex on the " + cap);
        } else {
            add(SweepCondition::one_source_one_target, face, "no edge on the " + cap);
        }
    }

    /// All faces look right one by one, but they do not close up from loop to loop.
    void rings() {
        add(SweepCondition::one_axis, target_,
            "the linking sides do not form rings that join each loop of the source to one loop of this target");
    }

    const SolidBoundary& solid_;
    std::size_t source_, target_;
    std::vector<SweepObstacle> obstacles_;
};

[[nodiscard]] inline SweepRefusal too_few_faces(const SolidBoundary& solid) {
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

/// The \p count pairs (positions, lower face first) that break the fewest conditions, best first. O(f^2 n).
[[nodiscard]] inline std::vector<std::pair<std::size_t, std::size_t>> closest_pairs(const SolidBoundary& solid,
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

/// The error for a solid that cannot be swept; its ids are the user's tags of the faces concerned, each once.
[[nodiscard]] inline UnmeshableError not_sweepable_error(const SolidBoundary& solid,
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

/// The refusal of a pair of caps (positions) for the reasons given.
[[nodiscard]] inline SweepRefusal make_refusal(const SolidBoundary& solid, std::size_t source, std::size_t target,
                                               std::vector<SweepObstacle> obstacles) {
    const SolidBoundary::Face &s = solid.faces[source], &t = solid.faces[target];
    std::string text = "from face " + std::to_string(s.tag) + " to face " + std::to_string(t.tag) + ": " +
                       detail::obstacle_text(obstacles);
    return {s.face.face, t.face.face, std::move(obstacles), std::move(text)};
}

/// Explains by topology why the solid is no sweep between the faces at positions \p source and \p target (which it is
/// not).
[[nodiscard]] inline SweepRefusal explain_refusal(const SolidBoundary& solid, std::size_t source, std::size_t target) {
    return make_refusal(solid, source, target, detail::ObstacleFinder(solid, source, target).find());
}

}  // namespace pavior
