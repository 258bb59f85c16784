#pragma once
/// \file
/// Solids cut into pieces that other methods mesh together.

#include <pavior/core/compiled.hpp>
#include <pavior/decompose/cut_search.hpp>
#include <pavior/decompose/piece_methods.hpp>
#include <pavior/decompose/solid_cut.hpp>
#include <pavior/part/any_model.hpp>
#include <pavior/part/kernels.hpp>
#include <pavior/part/part_mesh.hpp>

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace pavior {

/// Meshes some pieces by one method: mesh(method, pieces, solids of their model); an invalid mesh or none is told by
/// the outcome.
using PieceMesher =
    std::function<MethodTry(PartMethod method, const ModelPieces& pieces, std::span<const SolidId> solids)>;

/// A mesh of solids that were cut.
struct DecomposedSolids {
    CutSearch search;
    MethodTry mesh;                     ///< of the pieces, told of the solids and faces of the model; none was made if
                                        ///< its outcome is not TryOutcome::mesh
    std::vector<PieceMethods> methods;  ///< one for each piece
};

/// Searches cuts of \p solids (best_cuts()) after which \p mesh makes a valid mesh of all pieces by submap, sweep or
/// the mixed method. Quads between pieces of one solid are left out, hexahedra and quads belong to the solids and
/// faces of \p model. Nothing is tried once out_of_time() is true. Deterministic if the callables are.
/// \throws Stopped; what \p cut and \p mesh throw
[[nodiscard]] PAVIOR_INLINE DecomposedSolids decompose_solids(const AnyModel& model, std::span<const SolidId> solids,
                                                              const SolidCutter& cut, const IntegerSolver& solver,
                                                              const PieceMesher& mesh,
                                                              const std::function<bool()>& out_of_time,
                                                              const CutSearchOptions& options = {});

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/part/decompose_solids-inl.hpp>
#endif
