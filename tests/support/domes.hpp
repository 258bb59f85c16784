#pragma once
// Solids with caps round the pole of their surface or across its seam, made with the CAD kernel behind Gmsh.
#include "support/occ_solids.hpp"

#include <array>
#include <cmath>
#include <numbers>

namespace pavior::test {

enum class Dome { sphere, lens, prism, ring, revolved, cone };
inline constexpr std::array all_domes{Dome::sphere, Dome::lens, Dome::prism, Dome::ring, Dome::revolved, Dome::cone};

/// What two solids have in common.
inline gmsh::vectorpair common(int a, int b) {
    gmsh::vectorpair result;
    std::vector<gmsh::vectorpair> map;
    occ::intersect({{3, a}}, {{3, b}}, result, map);
    return result;
}

/// Turns the profile (radius, height), which begins and ends at the axis, a full turn round it. Curve \p spline of the
/// profile has inner points; -1: none.
inline void revolve_profile(const std::vector<std::array<double, 2>>& corners, int spline,
                            const std::vector<std::array<double, 2>>& inner) {
    std::vector<int> points, curves;
    for (const auto& [r, z] : corners) {
        points.push_back(occ::addPoint(r, 0, z));
    }
    for (std::size_t i = 0; i < points.size(); ++i) {
        const int next = points[(i + 1) % points.size()];
        if (static_cast<int>(i) != spline) {
            curves.push_back(occ::addLine(points[i], next));
            continue;
        }
        std::vector<int> along{points[i]};
        for (const auto& [r, z] : inner) {
            along.push_back(occ::addPoint(r, 0, z));
        }
        along.push_back(next);
        curves.push_back(occ::addBSpline(along));
    }
    const int face = occ::addPlaneSurface({occ::addCurveLoop(curves)});
    gmsh::vectorpair out;
    occ::revolve({{2, face}}, 0, 0, 0, 0, 0, 1, 2 * std::numbers::pi, out);
    occ::remove({{2, face}});
}

/// Makes the solid in the current model; the number of its faces.
inline std::size_t make_dome(Dome dome) {
    switch (dome) {
        case Dome::sphere:  // a cylinder under the cap of a sphere
            common(occ::addSphere(0, 0, 0, 3), occ::addCylinder(0, 0, 0, 0, 0, 5, 2));
            return 3;
        case Dome::lens: {  // between two spheres: a pole in both caps
            const int shell = cut(occ::addSphere(0, 0, 0, 4), {{3, occ::addSphere(0, 0, 0, 3)}});
            common(shell, occ::addCylinder(0, 0, 0, 0, 0, 5, 1.5));
            return 3;
        }
        case Dome::prism:  // a square prism under a sphere
            common(occ::addSphere(0, 0, 0, 3), occ::addBox(-1.2, -1.2, 0, 2.4, 2.4, 5));
            return 6;
        case Dome::ring: {  // a hole along the axis: no pole, but the seam
            const int whole = common(occ::addSphere(0, 0, 0, 3), occ::addCylinder(0, 0, 0, 0, 0, 5, 2)).at(0).second;
            cut(whole, {{3, occ::addCylinder(0, 0, -1, 0, 0, 7, 0.8)}});
            return 4;
        }
        case Dome::revolved:  // a spline turned about its end
            revolve_profile({{0, 0}, {1, 0}, {1, 1}, {0, 1.5}}, 2, {{0.8, 1.3}, {0.4, 1.5}});
            return 3;
        case Dome::cone: revolve_profile({{0, 0.3}, {1, 0}, {1, 1}, {0, 1.5}}, -1, {}); return 3;  // two tips
    }
    return 0;
}

}  // namespace pavior::test
