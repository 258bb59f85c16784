// expect: satisf.*point_like
#include <pavior/mesh/span_mesh.hpp>

#include <array>
#include <vector>

#ifdef MISUSE
using Point = std::array<double, 2>;
#else
using Point = std::array<double, 3>;
#endif

double z_of_the_first(const std::vector<Point>& nodes, const std::vector<std::array<int, 4>>& quads) {
    const pavior::QuadMeshView<Point, std::array<int, 4>> mesh{nodes, quads};
    return pavior::node(mesh, 0).z();
}
