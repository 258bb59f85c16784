// expect: quad_mesh
// Only quad meshes have boundary loops.
#include <pavior/mesh/boundary_loops.hpp>
#include <pavior/mesh/span_mesh.hpp>

#ifdef MISUSE
using Mesh = pavior::HexMesh;
#else
using Mesh = pavior::QuadMesh;
#endif

std::size_t loops(const Mesh& mesh) { return pavior::boundary_loops(mesh).size(); }
