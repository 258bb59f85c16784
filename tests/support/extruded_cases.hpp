#pragma once
// Bodies from polygons at levels, and what the tests of the many-to-many sweep need to mesh them.

#include <pavior/glpk/solve_program.hpp>
#include <pavior/imprint/imprint.hpp>
#include <pavior/many_to_many/polygon_body.hpp>

#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

namespace pavior::test {

inline std::vector<Vec2> box(double x0, double y0, double x1, double y1) {
    return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

inline std::vector<Vec2> disc(double x, double y, double radius, std::size_t n = 64) {
    std::vector<Vec2> points;
    for (std::size_t i = 0; i < n; ++i) {
        const double angle = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(n);
        points.emplace_back(x + radius * std::cos(angle), y + radius * std::sin(angle));
    }
    return points;
}

inline PolygonCap bottom(double level, std::vector<std::vector<Vec2>> loops) {
    return {std::move(loops), level, Vec2::Zero(), no_index, 0};
}
inline PolygonCap top(double level, std::vector<std::vector<Vec2>> loops) {
    return {std::move(loops), level, Vec2::Zero(), 0, no_index};
}

/// Two steps: 4 x 2 at the bottom, heights 1 and 2. Volume 12.
inline std::vector<PolygonCap> steps() {
    return {bottom(0, {box(0, 0, 4, 2)}), top(1, {box(2, 0, 4, 2)}), top(2, {box(0, 0, 2, 2)})};
}

/// The arrangement of a body, nothing merged.
inline PlaneArrangement arranged(const PolygonBody& body) { return imprint(body.body().plane, {1e-6, {}}); }

inline IntegerSolution solved(const IntegerProgram& program) { return solve(program, {10, 1e-3}); }

}  // namespace pavior::test
