#pragma once
/// \file
/// An extruded body from polygons at levels, without CAD.

#include <pavior/core/compiled.hpp>
#include <pavior/many_to_many/extruded_body.hpp>

#include <cstddef>
#include <vector>

namespace pavior {

/// A cap of a body: a region of the plane at a level. Heights are level + slope . point.
struct PolygonCap {
    std::vector<std::vector<Vec2>> loops;  ///< closed polygons, the first point not repeated; either sense
    double level = 0;
    Vec2 slope = Vec2::Zero();
    Index below = no_index, above = no_index;  ///< solids on its two sides, no_index: none
};

struct PolygonBodyOptions {
    ExtrusionFrame frame;
    /// Points where a polygon turns by more than this are nodes of the mesh, degrees; between them it is a smooth curve
    /// that is divided anew. 0: all points are nodes.
    double corner_angle = 20;
};

/// The caps of solids as an extruded body with its geometry. Models extruded_geometry. Tags are positions in the list
/// of caps and numbers of curves. The body names no sides, so multi_sweep() leaves them unnamed, and a merging
/// tolerance is not checked against walls and slots that it would close: set MultiSweepOptions::merge below their
/// width.
class PolygonBody {
public:
    /// \throws InputError empty_input (a cap without loops, a loop of fewer than three points), not_finite,
    /// duplicate_node (a point in the place of the one before it, up to rounding; ids: cap, loop, point)
    explicit PolygonBody(std::vector<PolygonCap> caps, const PolygonBodyOptions& options = {});

    [[nodiscard]] const ExtrudedBody& body() const { return body_; }

    [[nodiscard]] double cap_height(Index cap, const Vec2& at) const {
        return caps_[cap].level + caps_[cap].slope.dot(at);
    }
    [[nodiscard]] Vec3 curve_point(Index curve, const Vec2& near) const;

private:
    void check(std::size_t c) const;

    Index add_vertex(Index cap, const Vec2& at) {
        body_.vertices.emplace_back(at[0], at[1], cap_height(cap, at));
        return static_cast<Index>(body_.vertices.size() - 1);
    }

    void add_loop(Index cap, const std::vector<Vec2>& loop, double corner_angle, ExtrudedCap& result);

    std::vector<PolygonCap> caps_;
    ExtrudedBody body_;
    std::vector<Index> cap_of_curve_;
};

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/many_to_many/polygon_body-inl.hpp>
#endif
