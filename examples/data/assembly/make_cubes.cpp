// Writes cubes_27.brep: three by three by three cubes that share faces. Some columns have a round hole
// through all three levels, some a square pocket from above, some a slot in the middle level.
#include <gmsh.h>

#include <optional>
#include <vector>

namespace {

constexpr double side = 4;

/// What is cut from the cube at (i, j, k), if anything.
std::optional<int> add_tool(int i, int j, int k) {
    const double x = side * i;
    const double y = side * j;
    const double z = side * k;
    if ((i + j) % 3 == 1) {
        return gmsh::model::occ::addCylinder(x + side / 2, y + side / 2, z, 0, 0, side, 1);
    }
    if ((i + j) % 3 == 2 && k == 2) {
        return gmsh::model::occ::addBox(x + 1, y + 1, z + 2, 2, 2, 2);
    }
    if ((i + j) % 3 == 0 && k == 1 && i != j) {
        return gmsh::model::occ::addBox(x, y, z + 2, 2, side, 2);
    }
    return std::nullopt;
}

}  // namespace

int main() {
    gmsh::initialize(0, nullptr, false);
    gmsh::option::setNumber("General.Terminal", 0);
    gmsh::vectorpair solids;
    std::vector<gmsh::vectorpair> map;
    for (int cube = 0; cube < 27; ++cube) {
        const int i = cube % 3;
        const int j = cube / 3 % 3;
        const int k = cube / 9;
        gmsh::vectorpair result{{3, gmsh::model::occ::addBox(side * i, side * j, side * k, side, side, side)}};
        if (const std::optional<int> tool = add_tool(i, j, k)) {
            const gmsh::vectorpair box = result;
            gmsh::model::occ::cut(box, {{3, *tool}}, result, map);
        }
        solids.insert(solids.end(), result.begin(), result.end());
    }
    gmsh::vectorpair shared;
    gmsh::model::occ::fragment({solids.front()}, {solids.begin() + 1, solids.end()}, shared, map);
    gmsh::model::occ::synchronize();
    gmsh::write("cubes_27.brep");
    gmsh::finalize();
}
