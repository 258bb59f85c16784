#include "predicates.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/intersections.h>

namespace pavior::detail {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;

Point to_point(const Vec3& x) { return {x.x(), x.y(), x.z()}; }

Kernel::Triangle_3 to_triangle(const Triangle& t) { return {to_point(t[0]), to_point(t[1]), to_point(t[2])}; }

}  // namespace

int orientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    return static_cast<int>(CGAL::orientation(to_point(a), to_point(b), to_point(c), to_point(d)));
}

bool collinear(const Vec3& a, const Vec3& b, const Vec3& c) {
    return CGAL::collinear(to_point(a), to_point(b), to_point(c));
}

bool intersect(const Triangle& a, const Triangle& b) { return CGAL::do_intersect(to_triangle(a), to_triangle(b)); }

bool intersect(const Vec3& p, const Vec3& q, const Triangle& triangle) {
    return CGAL::do_intersect(Kernel::Segment_3(to_point(p), to_point(q)), to_triangle(triangle));
}

bool same_side(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    return CGAL::coplanar_orientation(to_point(a), to_point(b), to_point(c), to_point(d)) == CGAL::POSITIVE;
}

}  // namespace pavior::detail
