#pragma once
/// \file
/// Curves in a plane cut by each other: vertices, edges, cells, and the way of each curve through them. Plain data; who
/// computes it is another matter (imprint/imprint.hpp).

#include <pavior/core/index.hpp>
#include <pavior/math/point.hpp>

#include <array>
#include <concepts>
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace pavior {

/// Polylines: curve c is points[offsets[c]] .. points[offsets[c + 1] - 1], at least two of them; the first and the last
/// coincide for a closed curve.
struct PlaneCurves {
    std::vector<Vec2> points;
    std::vector<std::size_t> offsets{0};

    [[nodiscard]] std::size_t size() const { return offsets.size() - 1; }
    [[nodiscard]] std::span<const Vec2> operator[](std::size_t curve) const {
        return std::span(points).subspan(offsets[curve], offsets[curve + 1] - offsets[curve]);
    }
    /// Appends one curve.
    void add(std::span<const Vec2> curve) {
        points.insert(points.end(), curve.begin(), curve.end());
        offsets.push_back(points.size());
    }
};

/// An edge of an arrangement run from its first to its last vertex, or back.
struct OrientedPlaneEdge {
    Index edge = no_index;
    bool forward = true;

    friend constexpr auto operator<=>(const OrientedPlaneEdge&, const OrientedPlaneEdge&) = default;
};

/// A polyline between two vertices that meets the rest of the arrangement only there.
struct PlaneEdge {
    std::array<Index, 2> vertices{no_index, no_index};  ///< first and last, equal for a closed edge
    std::vector<Vec2> points;                           ///< both ends included
    std::array<Index, 2> cells{no_index, no_index};     ///< on the left and on the right; no_index: the outside
};

/// A bounded open region without a vertex or an edge inside. The outer loop comes first and runs counter-clockwise,
/// the others clockwise: the cell lies on the left. A loop may pass a vertex twice where the cell touches itself.
struct PlaneCell {
    std::vector<std::vector<OrientedPlaneEdge>> loops;
    Vec2 inside = Vec2::Zero();  ///< a point of the cell
};

struct PlaneArrangement {
    std::vector<Vec2> vertices;
    std::vector<PlaneEdge> edges;
    std::vector<PlaneCell> cells;
    std::vector<std::vector<OrientedPlaneEdge>> routes;  ///< of each curve; empty where it shrank to a vertex
    std::vector<std::array<Index, 2>> ends;              ///< of each curve: the vertices of its first and last point
};

/// Tolerances of an arrangement, lengths in the unit of the curves.
struct ImprintOptions {
    /// Curves closer than this are drawn twice rather than different: more than twice the chord error of the polylines.
    double coincident = 0;
    /// One a curve: two curves closer than the smaller of their tolerances become one after that; points move by about
    /// as much. Values below `coincident` count as that.
    std::vector<double> merge;
};

/// F computes arrangements: f(curves, options) is convertible to a PlaneArrangement in which no vertex is closer than
/// the tolerance to another vertex or to an edge that does not end there.
template <class F>
concept plane_imprinter = requires(F&& f, const PlaneCurves& curves, const ImprintOptions& options) {
    { f(curves, options) } -> std::convertible_to<PlaneArrangement>;
};

/// Any plane_imprinter that can be copied, behind one type; std::ref() of one that cannot.
using PlaneImprinter = std::function<PlaneArrangement(const PlaneCurves& curves, const ImprintOptions& options)>;

}  // namespace pavior
