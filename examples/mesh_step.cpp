// A STEP file to hexahedra, with a report: mesh_step PART.step MESH.vtu [SIZE]
#include <pavior/io/mesh_file.hpp>
#include <pavior/part/mesh_file.hpp>

#include <cstdio>
#include <cstdlib>

int main(int argc, char** argv) {
    if (argc < 3)
        return 2;
    const pavior::PartMesh part = pavior::mesh_file(argv[1], {.size = argc > 3 ? std::atof(argv[3]) : 0});
    if (part.valid())
        pavior::write_mesh(argv[2], part.data);
    std::printf("%zu hexahedra, least scaled Jacobian %.3f\n%s", part.check.hexahedra,
                part.check.quality.scaled_jacobian.min, reason_of(part).c_str());
    return part.valid() ? 0 : 1;
}
