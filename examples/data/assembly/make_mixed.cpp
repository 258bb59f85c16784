// Writes mixed_methods.brep: a plate with a blind hole, which only a many-to-many sweep can mesh; beside it a block
// with steps in three directions, which can only be submapped; on it a bracket with a hole and a cone, one-to-one
// sweeps in different directions. Faces are shared.
#include <gmsh.h>

#include <vector>

namespace occ = gmsh::model::occ;

namespace {

int cut(int from, const gmsh::vectorpair& tools) {
    gmsh::vectorpair result;
    std::vector<gmsh::vectorpair> map;
    occ::cut({{3, from}}, tools, result, map);
    return result.at(0).second;
}

}  // namespace

int main() {
    gmsh::initialize();
    gmsh::option::setNumber("General.Terminal", 0);
    const int plate = cut(occ::addBox(0, 0, 0, 6, 6, 2), {{3, occ::addCylinder(2.2, 2, 1, 0, 0, 1, 1)}});
    const int block = cut(occ::addBox(6, 0, 0, 4, 6, 4), {{3, occ::addBox(8, 0, 2, 2, 2, 2)},
                                                          {3, occ::addBox(8.6, 4, 0, 1.4, 2, 1.2)},
                                                          {3, occ::addBox(6, 3.6, 2.8, 1.2, 2.4, 1.2)}});
    const int bracket =
        cut(occ::addBox(0.4, 4, 2, 2.4, 1.5, 2.4),
            {{3, occ::addBox(1.8, 4, 3.2, 2, 1.5, 2)}, {3, occ::addCylinder(1.1, 4, 3.6, 0, 1.5, 0, 0.35)}});
    const int post = occ::addCone(4.5, 4.2, 2, 0, 0, 2, 0.9, 0.6);
    gmsh::vectorpair shared;
    std::vector<gmsh::vectorpair> map;
    occ::fragment({{3, plate}}, {{3, block}, {3, bracket}, {3, post}}, shared, map);
    occ::synchronize();
    gmsh::write("mixed_methods.brep");
    gmsh::finalize();
}
