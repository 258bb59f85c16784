// Writes elbow.step: a pipe elbow with straight legs, a flange with four bolt holes at each end, and a bore. Every face
// is a cap or a side of a path that goes straight, round a quarter of a circle, and straight on.
#include <gmsh.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace occ = gmsh::model::occ;

namespace {

constexpr double bend = 3;  // radius of the path

/// A disc of radius r, moved by (x, y) in the plane z = 0, which is the start of the path. The path sets out along +z.
gmsh::vectorpair disc(double x, double y, double r) { return {{2, occ::addDisk(x, y, 0, r, r)}}; }

/// The solid that a disc leaves from the start of the path, or from the end of its bend, length straight on.
std::pair<int, int> leg(const gmsh::vectorpair& start, bool first, double length) {
    if (!first) {  // the bend turns about the line x = bend, z = 0
        occ::rotate(start, bend, 0, 0, 0, 1, 0, std::numbers::pi / 2);
    }
    gmsh::vectorpair out;
    occ::extrude(start, first ? 0 : length, 0, first ? -length : 0, out);
    return out.at(1);
}

gmsh::vectorpair pipe(double r) {
    gmsh::vectorpair out;
    occ::revolve(disc(0, 0, r), bend, 0, 0, 0, 1, 0, std::numbers::pi / 2, out);
    gmsh::vectorpair whole;
    std::vector<gmsh::vectorpair> map;
    occ::fuse({out.at(1)}, {leg(disc(0, 0, r), true, 2), leg(disc(0, 0, r), false, 2.5)}, whole, map);
    return whole;
}

/// Discs of radius r at the far ends of the legs, thick.
gmsh::vectorpair at_ends(double x, double y, double r, double thickness) {
    gmsh::vectorpair result{leg(disc(x, y, r), true, thickness), leg(disc(x, y, r), false, thickness)};
    occ::translate({result[0]}, 0, 0, thickness - 2);
    occ::translate({result[1]}, 2.5 - thickness, 0, 0);
    return result;
}

}  // namespace

int main() {
    gmsh::initialize();
    gmsh::option::setNumber("General.Terminal", 0);
    gmsh::vectorpair whole;
    std::vector<gmsh::vectorpair> map;
    occ::fuse(pipe(1), at_ends(0, 0, 2.2, 0.6), whole, map);
    gmsh::vectorpair holes = pipe(0.7);
    for (int i = 0; i < 4; ++i) {
        const double angle = std::numbers::pi * (0.25 + 0.5 * i);
        for (const auto& hole : at_ends(1.6 * std::cos(angle), 1.6 * std::sin(angle), 0.25, 0.6)) {
            holes.push_back(hole);
        }
    }
    gmsh::vectorpair elbow;
    occ::cut(whole, holes, elbow, map);
    occ::synchronize();
    gmsh::write("elbow.step");
    gmsh::finalize();
}
