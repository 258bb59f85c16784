#pragma once
/// \file
/// A patch of triangles as the image of a convex polygon.

#include <pavior/block/detail/triangle_locator.hpp>
#include <pavior/core/compiled.hpp>
#include <pavior/mesh/cells.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace pavior {

/// A disc of triangles and its sides.
struct PatchDisc {
    std::vector<Vec3> points;
    std::vector<TriCorners> triangles;      ///< all oriented alike
    std::vector<std::vector<Index>> sides;  ///< >= 3; side s: points from corner s to corner s + 1, both included,
                                            ///< the inside to the left as the triangles see it
};

/// A one-to-one map of a convex polygon onto a disc of triangles: corners to corners, sides to sides by arc length.
/// A planar disc with straight sides and convex corners is its own polygon: the map is then a rigid motion. Others are
/// unrolled by mean value coordinates \cite floater2003 onto a polygon inscribed in a circle with sides of the lengths
/// of the disc's; its triangles are first refined, so that the map is smooth, but stay the same surface.
class PatchMap {
public:
    PatchMap() = default;
    /// \param enough  triangles at least in the refined disc
    /// \throws InputError size_mismatch (fewer than three sides), bad_index (points that do not exist), invalid_dual
    ///         (the sides are not the boundary of the triangles, or these are no disc). O(n^1.5) time, O(n log n)
    ///         memory.
    explicit PatchMap(const PatchDisc& disc, std::size_t enough = 200);

    /// Corners of the polygon, counter-clockwise; corner s is that of the disc.
    [[nodiscard]] std::span<const Vec2> polygon() const { return polygon_; }
    /// The point of side \p s at the fraction \p t of its length.
    [[nodiscard]] Vec2 side(std::size_t s, double t) const;
    /// True if the map is a rigid motion.
    [[nodiscard]] bool rigid() const { return rigid_; }

    /// The point of the patch at \p uv. Outside of the polygon: of the nearest triangle. O(1) as a rule.
    [[nodiscard]] Vec3 at(const Vec2& uv) const;
    /// The triangle of the disc as given that holds \p uv; the lowest if several do.
    [[nodiscard]] Index triangle_at(const Vec2& uv) const { return origin_[plane_.locate(uv).triangle]; }

    /// The place of the surface point nearest to \p x. O(n).
    [[nodiscard]] Vec2 nearest(const Vec3& x) const;
    /// Centroid of the triangles by area; it need not lie on them.
    [[nodiscard]] Vec3 centroid() const;
    /// The mean of the corners of the polygon: always inside.
    [[nodiscard]] Vec2 middle() const;

private:
    struct Frame {
        Vec3 origin = Vec3::Zero(), u = Vec3::UnitX(), v = Vec3::UnitY(), normal = Vec3::UnitZ();
    };
    /// Frame of the mean plane, the triangles counter-clockwise seen against the normal.
    [[nodiscard]] static Frame plane_frame(const PatchDisc& disc);

    [[nodiscard]] Vec2 flat(const Vec3& p) const {
        return {(p - frame_.origin).dot(frame_.u), (p - frame_.origin).dot(frame_.v)};
    }

    /// Sets polygon_ and says yes if the disc is planar, its sides straight and its corners convex.
    [[nodiscard]] bool find_polygon(const PatchDisc& disc);

    [[nodiscard]] bool convex() const;

    bool rigid_ = false;
    Frame frame_;
    std::vector<Vec2> polygon_;
    std::vector<Vec3> points_;
    std::vector<Index> origin_;      // triangle of the disc as given
    detail::TriangleLocator plane_;  // the triangles in the polygon
};

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/block/patch_map-inl.hpp>
#endif
