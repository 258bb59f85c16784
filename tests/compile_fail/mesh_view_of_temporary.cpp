// expect: lasting_array
#include <pavior/mesh/span_mesh.hpp>

#include <array>
#include <vector>

std::vector<std::array<double, 3>> nodes();

double x_of_the_first(const std::vector<std::array<int, 4>>& quads) {
    const std::vector<std::array<double, 3>> kept = nodes();
#ifdef MISUSE
    const pavior::QuadMeshView mesh{nodes(), quads};
#else
    const pavior::QuadMeshView mesh{kept, quads};
#endif
    return pavior::node(mesh, 0).x();
}
