#pragma once
/// \file
/// Solids that are extrusions in one direction, piece by piece: caps at any heights, sides along the direction. Plain
/// data and the geometry that goes with it, without CAD.

#include <pavior/many_to_many/plane_arrangement.hpp>

#include <array>
#include <concepts>
#include <cstddef>
#include <vector>

namespace pavior {

/// A right-handed orthonormal frame whose third axis is the direction of extrusion. The origin is that of space.
struct ExtrusionFrame {
    Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), direction = Vec3::UnitZ();

    [[nodiscard]] Vec3 to_frame(const Vec3& p) const { return {p.dot(x), p.dot(y), p.dot(direction)}; }
    [[nodiscard]] Vec3 to_space(const Vec3& q) const { return q[0] * x + q[1] * y + q[2] * direction; }
};

/// A curve that is nowhere parallel to the direction: an edge of a cap, or of a side.
struct ExtrudedCurve {
    std::array<Index, 2> vertices{no_index, no_index};  ///< in ExtrudedBody::vertices, equal for a closed curve
    double size = 0;                                    ///< wished length of its mesh edges; 0: the general one
    int tag = 0;                                        ///< by which users know it
    bool given = false;  ///< it joins two nodes of a mesh that is given: one interval, no more
    int face = 0;        ///< tag of the face on which it is a line of a given mesh, and no edge; 0: it is an edge
};

/// An edge along the direction whose nodes are given.
struct ExtrudedRib {
    std::vector<Index> vertices;  ///< in ExtrudedBody::vertices, ascending by height; the first is the end of a curve
};

/// Two vertices between which there is exactly one layer: neighbours in a mesh that is given.
struct ExtrudedStep {
    Index low = no_index, high = no_index;  ///< in ExtrudedBody::vertices
    int tag = 0;                            ///< of the face, 0: of none
};

/// A face that is a graph over the plane normal to the direction.
struct ExtrudedCap {
    std::vector<Index> curves;  ///< of its boundary, in any order; one that it passes twice appears twice
    Index below = no_index, above = no_index;  ///< solids on its two sides, no_index: none
    int tag = 0;
};

/// A face parallel to the direction.
struct ExtrudedSide {
    std::vector<Index> curves;  ///< of its boundary, without those parallel to the direction
    int tag = 0;
};

/// All coordinates are those of the frame: two in the plane, and the height along the direction. A mesh that is given
/// on a face is part of the body: its edges across the direction are curves (those inside a cap are named twice there,
/// those inside a side by no side), its edges along it are steps.
struct ExtrudedBody {
    ExtrusionFrame frame;
    std::vector<Vec3> vertices;
    std::vector<ExtrudedCurve> curves;
    PlaneCurves plane;  ///< the curves projected into the plane, as polylines
    std::vector<ExtrudedCap> caps;
    std::vector<ExtrudedSide> sides;
    std::vector<ExtrudedRib> ribs;    ///< only those with given nodes
    std::vector<ExtrudedStep> steps;  ///< of a mesh that is given
};

/// G is an extruded_geometry if, for a const G& g, it evaluates the curves and caps of a body, in the frame:
/// 1. g.curve_point(curve, near) is convertible to Vec3: the point of the curve whose projection is next to `near` in
///    the plane;
/// 2. g.cap_height(cap, at) is convertible to double: the height of the surface of the cap over `at`, which lies in the
///    cap or next to it.
template <class G>
concept extruded_geometry = requires(const G& g, Index id, const Vec2& at) {
    { g.curve_point(id, at) } -> std::convertible_to<Vec3>;
    { g.cap_height(id, at) } -> std::convertible_to<double>;
};

/// A view of any extruded_geometry, to which it keeps a reference; models extruded_geometry. A call costs what the
/// geometry takes and an indirect call.
class AnyExtrudedGeometry {
public:
    template <class G>
    requires(!std::same_as<G, AnyExtrudedGeometry> && extruded_geometry<G>)
        AnyExtrudedGeometry(const G& geometry)  // NOLINT: a geometry is passed as it is
        : geometry_(&geometry),
          curve_point_([](const void* g, Index id, const Vec2& near) -> Vec3 {
              return static_cast<const G*>(g)->curve_point(id, near);
          }),
          cap_height_([](const void* g, Index id, const Vec2& at) -> double {
              return static_cast<const G*>(g)->cap_height(id, at);
          }) {}

    [[nodiscard]] Vec3 curve_point(Index curve, const Vec2& near) const { return curve_point_(geometry_, curve, near); }
    [[nodiscard]] double cap_height(Index cap, const Vec2& at) const { return cap_height_(geometry_, cap, at); }

private:
    const void* geometry_;
    Vec3 (*curve_point_)(const void*, Index, const Vec2&);
    double (*cap_height_)(const void*, Index, const Vec2&);
};

}  // namespace pavior
