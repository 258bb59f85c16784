#pragma once
/// \file
/// Cuts through solids as data: surfaces, what they are for, and what is left of a model after them.

#include <pavior/brep/brep.hpp>
#include <pavior/math/point.hpp>

#include <concepts>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace pavior {

/// A whole plane.
struct CutPlane {
    Vec3 point, normal;  ///< normal of length 1
};

/// The part of a plane on one side of a line in it.
struct CutHalfPlane {
    Vec3 point, along;  ///< of the line; along of length 1
    Vec3 into;          ///< of length 1, perpendicular to the line: where the half-plane lies
};

/// A cylinder without ends.
struct CutCylinder {
    Vec3 point, direction;  ///< of its axis; direction of length 1
    double radius = 0;
    Vec3 seam;  ///< of length 1, perpendicular to the axis: where a kernel that needs a seam puts it
};

/// A segment or an arc of less than a half circle on faces, which it divides; the solid stays whole.
struct CutCurve {
    Vec3 from, middle, to;  ///< middle: of the arc, or of the segment
};

using CutSurface = std::variant<CutPlane, CutHalfPlane, CutCylinder>;

/// Why an analyst would cut there.
enum class CutReason : std::uint8_t {
    blend_foot,    ///< where a concave blend ends, perpendicular to the face that it ends at
    concave_edge,  ///< a face goes on beyond a concave edge
    junction,      ///< saddle planes of cylinders whose axes meet
    axis_plane,    ///< through an axis
    round_hole,    ///< a cylinder round a hole
    slab,          ///< two planes on either side of a hole
    step,          ///< the plane of a face, or of a circle, goes on
    between,       ///< between holes of different directions
    square,        ///< four lines along a round face, where a structured mesh turns
};

/// The stable name of \p reason, in words.
[[nodiscard]] constexpr std::string_view to_string(CutReason reason) noexcept {
    switch (reason) {
        case CutReason::blend_foot: return "foot of a blend";
        case CutReason::concave_edge: return "concave edge";
        case CutReason::junction: return "junction of cylinders";
        case CutReason::axis_plane: return "plane through an axis";
        case CutReason::round_hole: return "cylinder round a hole";
        case CutReason::slab: return "slab round a hole";
        case CutReason::step: return "step";
        case CutReason::between: return "between holes";
        case CutReason::square: return "round faces as squares";
    }
    return "unknown";
}

/// Surfaces that cut one solid together, each as far as it runs inside that solid, or curves that divide its faces.
struct SolidCut {
    SolidId solid;  ///< of the pieces that the cuts before this one left
    std::vector<CutSurface> surfaces;
    CutReason reason = CutReason::step;
    std::vector<CutCurve> curves = {};
};

/// P is solid_pieces if it holds what cuts left of the solids of a model, as a model of its own, whose solids share the
/// faces between them: *p.model is a brep, p.solid says, by solid of that, which solid it is a piece of.
template <class P>
concept solid_pieces = std::movable<P> && brep<std::remove_cvref_t<decltype(*std::declval<const P&>().model)>> &&
    requires(const P& p) {
    { p.solid } -> std::convertible_to<const std::vector<SolidId>&>;
};

/// C is a solid_cutter that makes pieces P if c(cuts), of a span of SolidCut, is what is left of one and the same
/// model after the cuts in their order (none: the model itself), an optional P: nothing where a cut does not divide
/// its solid, or, with curves alone, its faces, leaves slivers, or the CAD kernel fails. Every solid without a cut is
/// one piece. Deterministic.
template <class C, class P>
concept solid_cutter = solid_pieces<P> && requires(C& cut, std::span<const SolidCut> cuts) {
    { cut(cuts) } -> std::convertible_to<std::optional<P>>;
};

}  // namespace pavior
