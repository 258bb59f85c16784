#pragma once
// Exact signs. Internal to the tetra component; CGAL's kernel stays in the source file.

#include <pavior/math/point.hpp>

#include <array>

namespace pavior::detail {

using Triangle = std::array<Vec3, 3>;

/// Sign of det(b - a, c - a, d - a), exact.
[[nodiscard]] int orientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

/// True if the three points lie on one line, exact.
[[nodiscard]] bool collinear(const Vec3& a, const Vec3& b, const Vec3& c);

/// True if two triangles that are not degenerate have a point in common, exact.
[[nodiscard]] bool intersect(const Triangle& a, const Triangle& b);

/// True if the segment pq and a triangle that is not degenerate have a point in common, exact.
[[nodiscard]] bool intersect(const Vec3& p, const Vec3& q, const Triangle& triangle);

/// For d in the plane of a b c: true if c and d lie strictly on the same side of the line ab, exact.
[[nodiscard]] bool same_side(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

}  // namespace pavior::detail
