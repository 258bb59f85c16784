// Writes cubes_27.brep: three by three by three cubes that share faces. Some columns have a round hole
// through all three levels, some a square pocket from above, some a slot in the middle level. In cubes_27_unlike.brep
// no column is alike on its three levels: holes end on pockets, slots and whole cubes.
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

/// The same with other tools in all cubes of a column.
std::optional<int> add_unlike_tool(int i, int j, int k) {
    const double x = side * i;
    const double y = side * j;
    const double z = side * k;
    switch ((i + 3 * j + 9 * k) % 4) {
        case 1: return gmsh::model::occ::addCylinder(x + side / 2, y + side / 2, z, 0, 0, side, 1);
        case 2: return gmsh::model::occ::addBox(x + 1, y + 1, z + 2, 2, 2, 2);
        case 3: return gmsh::model::occ::addBox(x, y + 1.3, z + 2.5, side, 1.4, 1.5);
        default: return std::nullopt;
    }
}

template <class AddTool>
void write_cubes(AddTool add, const char* file) {
    gmsh::vectorpair solids;
    std::vector<gmsh::vectorpair> map;
    for (int cube = 0; cube < 27; ++cube) {
        const int i = cube % 3;
        const int j = cube / 3 % 3;
        const int k = cube / 9;
        gmsh::vectorpair result{{3, gmsh::model::occ::addBox(side * i, side * j, side * k, side, side, side)}};
        if (const std::optional<int> tool = add(i, j, k)) {
            const gmsh::vectorpair box = result;
            gmsh::model::occ::cut(box, {{3, *tool}}, result, map);
        }
        solids.insert(solids.end(), result.begin(), result.end());
    }
    gmsh::vectorpair shared;
    gmsh::model::occ::fragment({solids.front()}, {solids.begin() + 1, solids.end()}, shared, map);
    gmsh::model::occ::synchronize();
    gmsh::write(file);
    gmsh::clear();
}

}  // namespace

int main() {
    gmsh::initialize(0, nullptr, false);
    gmsh::option::setNumber("General.Terminal", 0);
    write_cubes(add_tool, "cubes_27.brep");
    write_cubes(add_unlike_tool, "cubes_27_unlike.brep");
    gmsh::finalize();
}
