#include "plc.hpp"
#include "shells.hpp"

#include <algorithm>
#include <cmath>

namespace pavior::detail {

namespace {

/// Triangles of a shell that are looked at for the widest way across its cavity.
constexpr std::size_t most_tries = 64;

}  // namespace

std::vector<Vec3> cavity_points(std::span<const Vec3> nodes, std::span<const TriCorners> triangles) {
    const TriangleTree tree(nodes, triangles);
    const Shells shells = find_shells(tree, triangles);
    std::vector<std::vector<std::size_t>> members(shells.first.size());
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        members[shells.of[t]].push_back(t);
    }
    std::vector<Vec3> points;
    for (std::size_t s = 0; s < members.size(); ++s) {
        if (shells.outwards[s] != 0) {
            continue;
        }
        double widest = 0.0;
        Vec3 middle = Vec3::Zero();
        const std::size_t step = std::max<std::size_t>(members[s].size() / most_tries, 1);
        for (std::size_t i = 0; i < members[s].size(); i += step) {
            const std::size_t t = members[s][i];
            const double width = tree.clearance(t);
            if (std::isfinite(width) && width > widest) {
                widest = width;
                middle = tree.centre(t) + 0.5 * width * tree.unit_normal(t);
            }
        }
        if (widest > 0.0) {
            points.push_back(middle);
        }
    }
    return points;
}

}  // namespace pavior::detail
