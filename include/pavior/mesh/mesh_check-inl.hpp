#pragma once

#include <pavior/mesh/mesh_check.hpp>

namespace pavior {

PAVIOR_INLINE MeshCheck check_mesh(const HexMesh& mesh, Execution execution) {
    MeshCheck check;
    check.nodes = mesh.nodes.size();
    check.hexahedra = mesh.hexes.size();
    check.verify = verify_hexes(mesh);
    const bool readable = check.verify.find(MeshFault::id_out_of_range) == nullptr;
    if (readable && check.hexahedra > 0) {
        check.quality = hex_quality(mesh, {.execution = execution});
    }
    return check;
}

}  // namespace pavior
