// expect: satisf.*vertex_mesh
#include <pavior/mesh/span_mesh.hpp>

#include <cstddef>
#include <vector>

struct Unknown {};

std::size_t count() {
#ifdef MISUSE
    const Unknown mesh;
#else
    const std::vector<pavior::Vec3> mesh;
#endif
    return pavior::node_count(mesh);
}
