#pragma once
/// \file
/// The last resort: hexahedra for solids of any shape, from tetrahedra split in four.

#include <pavior/brep/node_entities.hpp>
#include <pavior/brep/solids_mesh.hpp>
#include <pavior/brep/solids_tets.hpp>
#include <pavior/core/compiled.hpp>
#include <pavior/core/execution.hpp>
#include <pavior/part/any_model.hpp>
#include <pavior/part/kernels.hpp>
#include <pavior/part/part_options.hpp>

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace pavior {

/// How split_solids() works. Lengths are in the unit of the model.
struct SplitOptions {
    double size = 0;           ///< wished length of the edges of hexahedra, half of those of tetrahedra; above 0
    double max_angle = 30;     ///< curved edges turn by at most so many degrees a mesh edge where `size` admits it
    LocalLengths local = {};   ///< other lengths, by tags
    double sufficient = 0.2;   ///< no other tetrahedra are tried once the least scaled Jacobian is this
    double max_hexahedra = 0;  ///< tetrahedra that make more are too many; 0: no limit
    double seconds = 0;        ///< limit, of which some is left for what follows; 0: none
    Execution execution = sequential;
};

/// One set of tetrahedra and what came of it.
struct SplitAttempt {
    TetSizes sizes;
    std::size_t tets = 0;
    double split_jacobian = -1;  ///< least scaled Jacobian as split, nodes on straight edges
    double min_jacobian = -1;    ///< in the end
    std::size_t off = 0;         ///< boundary nodes that had to stay off their faces and edges
    std::string error;           ///< why there is no mesh
};

/// Hexahedra of solids, each of them valid.
struct SplitSolids : SolidsMesh {
    std::vector<NodeEntity> on;  ///< what each node lies on; boundary nodes that are off count as vertices without id
    std::vector<SplitAttempt> attempts;
    std::size_t taken = 0;     ///< attempt whose mesh this is
    bool out_of_time = false;  ///< more would have been tried
    std::string limit;         ///< what the least scaled Jacobian is at; empty where it is sufficient
};

/// Meshes \p solids, which may touch and then conform: tetrahedra by \p mesher, flipped (flip_tets()), each split in
/// four (split_tets()), boundary nodes moved onto their faces and edges, then improve_hexes(), first with a fixed
/// boundary, then with nodes that slide. Nodes move as far as all hexahedra stay positive, again when there is more
/// room; the mesh is valid at any time, as the split tetrahedra are. Where the result is not sufficient, or \p mesher
/// fails, other sizes follow, also shorter ones where the solids are thin. The best counts: sufficient, all nodes on
/// the model, least scaled Jacobian, in this order. Deterministic if the model and the mesher are and no limit of time
/// strikes; the same bytes for any number of threads.
/// \throws InputError bad_option; UnmeshableError tetrahedra_failed with the reason of each attempt; Stopped; what the
/// model throws
[[nodiscard]] PAVIOR_INLINE SplitSolids split_solids(const AnyModel& b, std::span<const SolidId> solids,
                                                     const SplitOptions& options, const TetMesher& mesher);

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/part/split_solids-inl.hpp>
#endif
