#pragma once

#include <pavior/submap/submap_recognition.hpp>

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace pavior {

namespace detail {

[[nodiscard]] inline std::complex<double> quarter_power(int quarters) {
    constexpr std::array<std::complex<double>, 4> powers{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
    return powers[static_cast<std::size_t>(((quarters % 4) + 4) % 4)];
}

PAVIOR_INLINE std::vector<int> headings(const std::vector<CornerClass>& corner, int first) {
    std::vector<int> result{first};
    for (std::size_t i = 1; i < corner.size(); ++i) {
        result.push_back((result.back() + quarter_turns(corner[i]) + 4) % 4);
    }
    return result;
}

PAVIOR_INLINE std::complex<double> direction_of_s(const std::vector<Vec2>& chords, const std::vector<int>& heading) {
    std::complex<double> sum = 0.0;
    for (std::size_t i = 0; i < chords.size(); ++i) {
        sum += std::complex<double>(chords[i].x(), chords[i].y()) * quarter_power(-heading[i]);
    }
    return sum;
}

PAVIOR_INLINE SideSpreading::SideSpreading(const SolidBoundary& boundary, const SolidClasses& classes,
                                           std::span<const LogicalFace> faces)
    : boundary_(boundary), classes_(classes), faces_(faces), sides_(boundary.faces.size()) {
    for (std::size_t f = 0; f < sides_.size(); ++f) {
        sides_[f].face = boundary.faces[f].face;
    }
    sides_[0].s = SignedAxis{1};
    sides_[0].t = SignedAxis{2};
    std::vector<std::size_t> stack{0};
    while (!stack.empty()) {
        const std::size_t f = stack.back();
        stack.pop_back();
        for (std::size_t h = boundary.faces[f].begin; h < boundary.faces[f].end; ++h) {
            const std::size_t g = boundary.twin_face(h);
            const LogicalSide side = beyond(h);
            if (!sides_[g].s.valid()) {
                sides_[g] = side;
                stack.push_back(g);
            } else if (sides_[g].s != side.s || sides_[g].t != side.t) {
                throw UnmeshableError(ErrorCode::not_submappable,
                                      "the logical directions of faces " + std::to_string(boundary.faces[f].tag) +
                                          " and " + std::to_string(boundary.faces[g].tag) +
                                          " contradict each other: the solid is twisted in itself",
                                      {boundary.faces[f].tag, boundary.faces[g].tag});
            }
        }
    }
}

PAVIOR_INLINE std::vector<LogicalSide> SideSpreading::take() {
    for (std::size_t f = 0; f < sides_.size(); ++f) {
        if (!sides_[f].s.valid()) {
            throw UnmeshableError(ErrorCode::not_submappable,
                                  "the boundary is in several pieces; face " + std::to_string(boundary_.faces[f].tag) +
                                      " belongs to an inner one",
                                  {boundary_.faces[f].tag});
        }
    }
    return std::move(sides_);
}

PAVIOR_INLINE int SideSpreading::heading(std::size_t h) const {
    const SolidBoundary::HalfEdge& half = boundary_.half_edges[h];
    const SolidBoundary::Face& face = boundary_.faces[half.face];
    const LogicalLoop& loop = faces_[face.face.face.index()].loops[half.loop];
    return loop.heading[own_use(face.face.outward, h - face.loops[half.loop], loop.uses.size())];
}

PAVIOR_INLINE LogicalSide SideSpreading::beyond(std::size_t h) const {
    const LogicalSide& here = sides_[boundary_.half_edges[h].face];
    const std::size_t twin = boundary_.half_edges[h].twin;
    const OrientedFace face = boundary_.faces[boundary_.half_edges[twin].face].face;
    const SignedAxis own = here.direction(heading(h));
    const SignedAxis seen = here.face.outward ? own : -own;  // as seen from outside
    const SignedAxis outward = turned(here.outward(), -seen, static_cast<int>(classes_.dihedral[h]) - 2);
    const SignedAxis normal = face.outward ? outward : -outward;
    const SignedAxis there = face.outward ? -seen : seen;  // the twin in the sense of its face's own loop
    const SignedAxis s = turned(there, normal, -heading(twin));
    return {face, s, cross(normal, s)};
}

}  // namespace detail

}  // namespace pavior
