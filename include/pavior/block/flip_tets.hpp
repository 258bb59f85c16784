#pragma once
/// \file
/// Tetrahedra connected otherwise, so that the hexahedra they are split into are better.

#include <pavior/core/compiled.hpp>
#include <pavior/mesh/tagged_mesh.hpp>

#include <cstddef>
#include <stop_token>
#include <vector>

namespace pavior {

struct FlipOptions {
    /// Tetrahedra whose hexahedra reach this scaled Jacobian are left alone, in (0, 1].
    double sufficient = 0.35;
    int rounds = 8;             ///< over all tetrahedra that are not sufficient
    std::stop_token stop = {};  ///< ends the call by Stopped
};

/// Tetrahedra on the same nodes.
struct FlippedTets {
    std::vector<TetCorners> tets;
    std::vector<Index> origin;  ///< for each a tetrahedron of the input that it overlaps, of the same part of the solid
    std::size_t flips = 0;
    /// Least scaled Jacobian of the split, of tetrahedra with two tagged triangles at more than 150 degrees a
    /// thousandth of it; 1 without tetrahedra.
    double before = 1, after = 1;
};

/// Removes inner faces and edges of \p tets where the tetrahedra that take their place have a better worst split
/// (split_tets(), as it is before any node is moved): two tetrahedra become three, n round an edge (3 to 8) 2 (n - 2),
/// in the way of all that is best. Fewer tetrahedra then share sharp edges and corners. The tagged triangles, which
/// must include the boundary, remain as they are, and so do all edges on them. Two of them on one tetrahedron that
/// meet at more than 150 degrees are avoided: the middle of their edge could not be moved onto a smooth surface. All
/// tetrahedra stay positive, the minimum (`before`, `after`) does not fall. O(n log n) for a few poor ones among n.
/// Deterministic, thread-safe.
/// \throws InputError bad_option, bad_index (of a node); Stopped
[[nodiscard]] PAVIOR_INLINE FlippedTets flip_tets(const TaggedTetMesh& tets, const FlipOptions& options = {});

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/block/flip_tets-inl.hpp>
#endif
