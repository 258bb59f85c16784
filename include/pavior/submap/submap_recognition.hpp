#pragma once
/// \file
/// Recognition of solids that are unions of logical boxes.

#include <pavior/brep/flat_face.hpp>
#include <pavior/core/compiled.hpp>
#include <pavior/intervals/integer_program.hpp>
#include <pavior/lattice/submap_topology.hpp>
#include <pavior/submap/submap_classes.hpp>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace pavior {

namespace detail {

/// Headings of a loop whose first use has \p first.
[[nodiscard]] PAVIOR_INLINE std::vector<int> headings(const std::vector<CornerClass>& corner, int first);

/// Direction of +s in the flat face as a loop with the given headings sees it; not of length 1.
[[nodiscard]] PAVIOR_INLINE std::complex<double> direction_of_s(const std::vector<Vec2>& chords,
                                                                const std::vector<int>& heading);

/// The headings of all loops and the links, for a face whose loops have their uses and classes.
template <brep B>
void orient_loops(const B& b, FaceId f, LogicalFace& face) {
    std::vector<EdgeLoop> loops;
    for (const LogicalLoop& loop : face.loops) {
        loops.push_back(loop.uses);
    }
    face.loops[0].heading = headings(face.loops[0].corner, 0);
    if (loops.size() == 1) {
        return;
    }
    const FlatFace flat = flat_face(b, f, loops);
    const std::complex<double> s = direction_of_s(flat.chord[0], face.loops[0].heading);
    const std::complex<double> unit = s / std::max(std::abs(s), 1e-300);
    const auto along = [&](const Vec2& p, std::size_t axis) {
        const std::complex<double> local = std::complex<double>(p.x(), p.y()) * std::conj(unit);
        return axis == 0 ? local.real() : local.imag();
    };
    for (std::size_t l = 1; l < face.loops.size(); ++l) {
        LogicalLoop& loop = face.loops[l];
        loop.heading = headings(loop.corner, 0);
        const double turn = std::arg(direction_of_s(flat.chord[l], loop.heading) * std::conj(unit));
        const int quarters = static_cast<int>(std::lround(turn / std::acos(0.0)));
        // chords of the loop are those of +s turned by `turn`: its first use has that heading
        loop.heading = headings(loop.corner, (quarters + 4) % 4);
        LoopLink link;
        for (std::size_t axis = 0; axis < 2; ++axis) {
            const auto& starts = flat.start[0];
            for (std::size_t i = 1; i < starts.size(); ++i) {
                if (along(starts[i], axis) < along(starts[link.anchor[axis]], axis)) {
                    link.anchor[axis] = i;
                }
            }
            const double way = along(flat.start[l][0], axis) - along(starts[link.anchor[axis]], axis);
            link.length[axis] = std::max(way, 1e-6 * std::abs(s));
        }
        face.links.push_back(link);
    }
}

/// Refuses a loop that cannot close whatever the numbers: along an axis all uses run the same way.
template <brep B>
void check_loops(const B& b, FaceId f, const LogicalFace& face) {
    for (const LogicalLoop& loop : face.loops) {
        for (int axis = 0; axis < 2; ++axis) {
            const auto along = std::find(loop.heading.begin(), loop.heading.end(), axis);
            const auto against = std::find(loop.heading.begin(), loop.heading.end(), axis + 2);
            if ((along == loop.heading.end()) != (against == loop.heading.end())) {
                const auto lone = (along == loop.heading.end() ? against : along) - loop.heading.begin();
                const EdgeId e = loop.uses[static_cast<std::size_t>(lone)].edge;
                const int tag = b.tag(2, f.index());
                throw UnmeshableError(ErrorCode::not_submappable,
                                      "face " + std::to_string(tag) +
                                          " is no union of rectangles: nothing runs opposite to edge " +
                                          std::to_string(b.tag(1, e.index())),
                                      {tag});
            }
        }
    }
}

/// Own position in the face's loop of the i-th half-edge of n as seen from outside.
[[nodiscard]] inline std::size_t own_corner(bool outward, std::size_t i, std::size_t n) {
    return outward ? i : (n - i) % n;
}

/// The same for the use itself.
[[nodiscard]] inline std::size_t own_use(bool outward, std::size_t i, std::size_t n) { return outward ? i : n - 1 - i; }

/// The face at position \p f of a solid's boundary with its classes.
template <brep B>
[[nodiscard]] LogicalFace logical_face(const B& b, const SolidBoundary& boundary, const SolidClasses& classes,
                                       std::size_t f) {
    const SolidBoundary::Face& face = boundary.faces[f];
    LogicalFace result;
    for (const std::size_t first : face.loops) {
        const std::vector<std::size_t> loop = boundary.loop_from(first);
        LogicalLoop logical{EdgeLoop(loop.size()), std::vector<CornerClass>(loop.size()), {}};
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const OrientedEdge use = boundary.half_edges[loop[i]].use;
            logical.uses[own_use(face.face.outward, i, loop.size())] = {use.edge, use.forward == face.face.outward};
            logical.corner[own_corner(face.face.outward, i, loop.size())] = classes.corner[loop[i]];
        }
        result.loops.push_back(std::move(logical));
    }
    orient_loops(b, face.face.face, result);
    check_loops(b, face.face.face, result);
    return result;
}

/// Directions of the sides of one solid, spread from the first face over all edges.
class SideSpreading {
public:
    SideSpreading(const SolidBoundary& boundary, const SolidClasses& classes, std::span<const LogicalFace> faces);

    [[nodiscard]] std::vector<LogicalSide> take();

private:
    /// Own heading of half-edge h, in the sense of the face's own loop.
    [[nodiscard]] int heading(std::size_t h) const;

    /// The face on the other side of half-edge \p h, as its own face implies it.
    [[nodiscard]] LogicalSide beyond(std::size_t h) const;

    const SolidBoundary& boundary_;
    const SolidClasses& classes_;
    std::span<const LogicalFace> faces_;
    std::vector<LogicalSide> sides_;
};

/// Turns i, j, k so that they run along x, y, z as far as possible.
template <brep B>
void align(const B& b, std::span<const LogicalFace> faces, std::vector<LogicalSide>& sides) {
    Eigen::Matrix3d along = Eigen::Matrix3d::Zero();  // row: logical axis, column: space
    for (const LogicalSide& side : sides) {
        for (const LogicalLoop& loop : faces[side.face.face.index()].loops) {
            for (std::size_t i = 0; i < loop.uses.size(); ++i) {
                const OrientedEdge use = loop.uses[i];
                const auto ends = b.edge_vertices(use.edge);
                const Vec3 chord = b.vertex_point(ends[1]) - b.vertex_point(ends[0]);
                const SignedAxis d = side.direction(loop.heading[i]);
                along.row(static_cast<Eigen::Index>(d.axis())) += d.sign() * (use.forward ? 1.0 : -1.0) * chord;
            }
        }
    }
    CubeTurn best;
    double score = -1.0;
    for (const CubeTurn& turn : cube_turns()) {
        double sum = 0.0;
        for (std::size_t a = 0; a < 3; ++a) {
            sum += turn.image[a].sign() *
                   along(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(turn.image[a].axis()));
        }
        if (sum > score + 1e-9 * along.norm()) {
            score = sum;
            best = turn;
        }
    }
    for (LogicalSide& side : sides) {
        side.s = best(side.s);
        side.t = best(side.t);
    }
}

}  // namespace detail

/// The logical shape of \p solids: the classes of all their angles (classify_solids()), axes for every face, signed
/// axes of the solid for the axes of its faces. Numbers of intervals are not looked at. Deterministic if the solver is.
/// Every edge has one logical direction, so closed edges and faces with a seam are refused as a rule: their loops lack
/// corners.
/// \throws UnmeshableError not_submappable with the reason and the user's tags of the faces concerned; InputError
/// non_manifold if the faces of a solid do not close it.
template <brep B, integer_solver Solver>
[[nodiscard]] SubmapModel recognise_submaps(const B& b, std::span<const SolidId> solids, const SubmapOptions& options,
                                            Solver&& solver) {
    std::vector<SolidBoundary> boundaries;
    for (const SolidId s : solids) {
        boundaries.push_back(solid_boundary(b, s));
    }
    const std::vector<SolidClasses> classes =
        classify_solids(b, std::span<const SolidBoundary>(boundaries), options, solver);
    SubmapModel result;
    result.as_in_space = !options.turns.empty();
    result.faces.resize(b.face_count());
    for (std::size_t s = 0; s < solids.size(); ++s) {
        for (std::size_t f = 0; f < boundaries[s].faces.size(); ++f) {
            LogicalFace& face = result.faces[boundaries[s].faces[f].face.face.index()];
            if (face.empty()) {
                face = detail::logical_face(b, boundaries[s], classes[s], f);
            }
        }
    }
    for (std::size_t s = 0; s < solids.size(); ++s) {
        detail::SideSpreading spreading(boundaries[s], classes[s], result.faces);
        result.solids.push_back({solids[s], spreading.take(), classes[s].deviation});
        detail::align(b, result.faces, result.solids.back().sides);
    }
    return result;
}

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/submap/submap_recognition-inl.hpp>
#endif
