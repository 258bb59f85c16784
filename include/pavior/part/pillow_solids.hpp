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
    double size = 0;      ///< wished length of mesh edges; above 0
    double angle = 150;   ///< boundary quads that meet at more degrees inside are smooth there; between 90 and 180
    double enough = 0.3;  ///< a mesh with this least scaled Jacobian is left alone; in (0, 1)
    /// Asked now and then; once true, no more is tried. Empty: never.
    std::function<bool()> out_of_time = {};
    Execution execution = sequential;
};

/// One way that was tried.
struct PillowAttempt {
    std::vector<FaceId> faces;              ///< the layer lies under these, ascending; none: nodes only slide
    bool apart = false;                     ///< each solid has a layer of its own
    PillowFault fault = PillowFault::none;  ///< why there is no layer
    double min_jacobian = -1;               ///< least scaled Jacobian, improved
};

struct PillowedSolids {
    double before = -1, after = -1;  ///< least scaled Jacobian
    std::vector<PillowAttempt> attempts;
    std::optional<std::size_t> taken;  ///< attempt whose mesh this is; nothing: the mesh is as it was
};

/// Raises the least scaled Jacobian of a mesh, by the first of these that gives enough, else by the best:
/// 1. layers of hexahedra (pillow()) under faces whose quads of one hexahedron meet at more than options.angle: a
///    hexahedron with two quads on one smooth surface is flat there, and no place of its nodes changes that;
/// 2. nodes that slide on faces and edges (EntityGuide), those that are nearly there moved onto them before
/// (settle_nodes()); 3. layers under the faces at the worst hexahedra. A layer lies under all faces that hang together
/// smoothly or at concave edges, and leaves through the faces beside them; where it cannot conform, faces beside it
/// join. Of several solids one layer goes through all, else each gets its own, also under faces that it shares.
/// improve_hexes() follows, first with the boundary fixed, then sliding as in 2. The mesh changes only if the minimum
/// rises, for a layer by 0.02 at least, and a mesh with a layer only counts if verify_hexes() finds no fault.
/// \param mesh  conforming, with quads on all faces; of faces that meet smoothly quads may bear the name of another one
/// (nodes that settle_nodes() leaves off their face are held). In and out; old nodes, hexahedra and quads
/// keep their places in the arrays.
/// Deterministic unless out_of_time() strikes; the same bytes for any number of threads.
/// O(n) where the mesh is good enough, or has no such hexahedra.
/// \throws InputError bad_option, size_mismatch, bad_index; Stopped; what the model throws
[[nodiscard]] PAVIOR_INLINE PillowedSolids pillow_solids(const AnyModel& b, SolidsMesh& mesh,
                                                         const PillowSolidsOptions& options);

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/part/pillow_solids-inl.hpp>
#endif
