#pragma once
/// \file
/// The conditions of section 2.1 \cite roca2009 for one pair of caps, and the words for a pair that breaks them.

#include <pavior/brep/brep.hpp>
#include <pavior/brep/solid_boundary.hpp>
#include <pavior/core/compiled.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <set>
#include <string>
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

/// The vertices of a face.
[[nodiscard]] PAVIOR_INLINE std::set<VertexId> face_vertices(const SolidBoundary& solid, std::size_t face);

/// Condition on the caps alone: equally many loops (at least one), no seam, no common vertex.
[[nodiscard]] PAVIOR_INLINE bool caps_fit(const SolidBoundary& solid, std::size_t source, std::size_t target);

/// Finds what stands between the caps at two positions.
class ObstacleFinder {
public:
    ObstacleFinder(const SolidBoundary& solid, std::size_t source, std::size_t target)
        : solid_(solid), source_(source), target_(target) {}

    [[nodiscard]] std::vector<SweepObstacle> find();

private:
    void add(SweepCondition condition, std::size_t face, std::string reason) {
        obstacles_.push_back({condition, solid_.faces[face].face.face, solid_.faces[face].tag, std::move(reason)});
    }

    void caps();

    [[nodiscard]] bool share_vertex(std::size_t a, std::size_t b) const {
        const std::set<VertexId> first = face_vertices(solid_, a), second = face_vertices(solid_, b);
        return std::any_of(first.begin(), first.end(), [&](VertexId v) { return second.contains(v); });
    }

    void side(std::size_t face);

    void one_cap_only(std::size_t face, std::size_t missing);

    /// All faces look right one by one, but they do not close up from loop to loop.
    void rings() {
        add(SweepCondition::one_axis, target_,
            "the linking sides do not form rings that join each loop of the source to one loop of this target");
    }

    const SolidBoundary& solid_;
    std::size_t source_, target_;
    std::vector<SweepObstacle> obstacles_;
};

[[nodiscard]] PAVIOR_INLINE SweepRefusal too_few_faces(const SolidBoundary& solid);

/// The \p count pairs (positions, lower face first) that break the fewest conditions, best first. O(f^2 n).
[[nodiscard]] PAVIOR_INLINE std::vector<std::pair<std::size_t, std::size_t>> closest_pairs(const SolidBoundary& solid,
                                                                                           std::size_t count);

/// The error for a solid that cannot be swept; its ids are the user's tags of the faces concerned, each once.
[[nodiscard]] PAVIOR_INLINE UnmeshableError not_sweepable_error(const SolidBoundary& solid,
                                                                const std::vector<SweepRefusal>& refusals);

}  // namespace detail

/// The refusal of a pair of caps (positions) for the reasons given.
[[nodiscard]] PAVIOR_INLINE SweepRefusal make_refusal(const SolidBoundary& solid, std::size_t source,
                                                      std::size_t target, std::vector<SweepObstacle> obstacles);

/// Explains by topology why the solid is no sweep between the faces at positions \p source and \p target (which it is
/// not).
[[nodiscard]] inline SweepRefusal explain_refusal(const SolidBoundary& solid, std::size_t source, std::size_t target) {
    return make_refusal(solid, source, target, detail::ObstacleFinder(solid, source, target).find());
}

namespace detail {

/// Chains of the face's boundary that are shared with face \p cap.
[[nodiscard]] PAVIOR_INLINE std::size_t chains_along(const SolidBoundary& solid, std::size_t face, std::size_t cap);

}  // namespace detail

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/one_to_one/sweep_conditions-inl.hpp>
#endif
