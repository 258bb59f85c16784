#pragma once
/// \file
/// Poor meshes made better by layers of hexahedra under faces that meet smoothly.

#include <pavior/brep/solids_mesh.hpp>
#include <pavior/core/compiled.hpp>
#include <pavior/core/execution.hpp>
#include <pavior/part/any_model.hpp>
#include <pavior/smooth/pillow.hpp>

#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace pavior {

/// How pillow_solids() works. Lengths are in the unit of the model.
struct PillowSolidsOptions {
    double size = 0;       ///< wished length of mesh edges; above 0
    double angle = 150;    ///< boundary quads that meet at more degrees inside are smooth there; between 90 and 180
    double enough = 0.3;   ///< a mesh with this least scaled Jacobian is left alone; in (0, 1)
    /// Asked now and then; once true, no more is tried. Empty: never.
    std::function<bool()> out_of_time = {};
    Execution execution = sequential;
};

/// One way that was tried.
struct PillowAttempt {
    std::vector<FaceId> faces;              ///< the layer lies under these, ascending; none: nodes only slide
    PillowFault fault = PillowFault::none;  ///< why there is no layer
    double min_jacobian = -1;               ///< least scaled Jacobian, improved
};

struct PillowedSolids {
    double before = -1, after = -1;  ///< least scaled Jacobian
    std::vector<PillowAttempt> attempts;
    std::optional<std::size_t> taken;  ///< attempt whose mesh this is; nothing: the mesh is as it was
};

/// Inserts layers of hexahedra (pillow()) under faces whose quads of one hexahedron meet at more than options.angle: a
/// hexahedron with two quads on one smooth surface is flat there, whoever made it, and no place of its nodes changes
/// that. The layer lies under all faces that hang together smoothly or at concave edges, and leaves through the faces
/// beside them; where it cannot conform, faces beside it join, also those of solids that touch. Then improve_hexes(),
/// first with the boundary fixed, then with nodes that slide on faces and edges (EntityGuide), new nodes moved onto
/// theirs before. Sliding alone is tried first. The mesh changes only if its least scaled Jacobian rises and none of
/// what conformed does not conform any more.
/// \param mesh  conforming, with quads on all faces; quads of faces that meet smoothly may bear the name of one of them
/// (such nodes do not slide). In and out; old nodes, hexahedra and quads keep their places in the arrays.
/// Deterministic unless out_of_time() strikes; the same bytes for any number of threads.
/// O(n) where the mesh is good enough, or has no such hexahedra.
/// \throws InputError bad_option, size_mismatch, bad_index; Stopped; what the model throws
[[nodiscard]] PAVIOR_INLINE PillowedSolids pillow_solids(const AnyModel& b, SolidsMesh& mesh,
                                                         const PillowSolidsOptions& options);

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/part/pillow_solids-inl.hpp>
#endif
