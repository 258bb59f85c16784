#pragma once
// From what an engine returned to a mesh that keeps its promises. Internal to the tetra component.

#include "problem.hpp"

namespace pavior::detail {

/// A mesh, and how flat its flattest tetrahedron is: altitude by longest edge, at most about 0.8.
struct Assembled {
    TaggedTetMesh mesh;
    double flattest = 0.0;
};

/// Turns tetrahedra positive, drops those in cavities, finds the triangles of the boundary with their tags, puts the
/// nodes of the surface first, and checks all of it.
/// \throws Error(tetrahedra_failed) saying which promise the engine broke
[[nodiscard]] Assembled assemble(const Problem& problem, const RawTets& raw);

}  // namespace pavior::detail
