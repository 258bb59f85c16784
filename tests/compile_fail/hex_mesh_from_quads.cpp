// expect: satisf.*hex_mesh
#include <pavior/mesh/span_mesh.hpp>

pavior::HexCorners first() {
#ifdef MISUSE
    const pavior::QuadMesh mesh;
#else
    const pavior::HexMesh mesh;
#endif
    return pavior::hex(mesh, 0);
}
