// Writes bolt_plate_washer.step: a plate and a square washer of one outline, and a bolt through both.
// Gmsh's STEP writer keeps no names, so they are put into the PRODUCT entities afterwards.
#include <gmsh.h>

#include <array>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <string>

namespace {

constexpr double side = 30;
constexpr double radius = 5;

/// A square plate with a round hole from height z on.
int add_plate(double z, double thickness) {
    const int box = gmsh::model::occ::addBox(-side / 2, -side / 2, z, side, side, thickness);
    const int hole = gmsh::model::occ::addCylinder(0, 0, z, 0, 0, thickness, radius);
    gmsh::vectorpair result;
    std::vector<gmsh::vectorpair> map;
    gmsh::model::occ::cut({{3, box}}, {{3, hole}}, result, map);
    return result.at(0).second;
}

void write_shapes(const std::string& file) {
    gmsh::initialize(0, nullptr, false);
    gmsh::option::setNumber("General.Terminal", 0);
    gmsh::model::add("assembly");
    add_plate(0, 8);
    add_plate(8, 3);
    gmsh::model::occ::addCylinder(0, 0, -4, 0, 0, 20, radius);
    gmsh::model::occ::synchronize();
    gmsh::write(file);
    gmsh::finalize();
}

/// Replaces the names that the writer made up: "... 1" is the assembly, "... 1.1" its first solid.
void put_names(const std::string& file) {
    const std::string made_up = "'Open CASCADE STEP translator 7.6 1";
    const std::array<std::string, 4> names{"clamp", "plate", "washer", "bolt"};
    std::ifstream in(file);
    std::string text{std::istreambuf_iterator<char>(in), {}};
    in.close();
    for (std::size_t i = 0; i < names.size(); ++i) {
        const std::string old = made_up + (i == 0 ? "'" : "." + std::to_string(i) + "'");
        for (std::size_t at = text.find(old); at != std::string::npos; at = text.find(old)) {
            text.replace(at, old.size(), "'" + names[i] + "'");
        }
    }
    std::ofstream(file) << text;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) {
        std::puts("usage: make_assembly FILE.step");
        return 2;
    }
    write_shapes(argv[1]);
    put_names(argv[1]);
    return 0;
}
