#pragma once
/// \file
/// The door: hexahedra for all solids of a model, each group that hangs together by the method that suits it.

#include <pavior/core/compiled.hpp>
#include <pavior/part/any_model.hpp>
#include <pavior/part/kernels.hpp>
#include <pavior/part/part_mesh.hpp>
#include <pavior/part/part_options.hpp>

#include <functional>
#include <span>

namespace pavior {

/// Meshes the solids of \p model, any brep, with \p kernels, everything in this process: solids that touch are decided
/// on together (decide()), conforming; the meshes of the groups come one after the other.
/// Limits of time are kept as far as the methods ask for them: foreign code runs on. mesh_file() of pavior::part runs
/// each try in a process that is ended.
/// Deterministic if model and kernels are and no limit of time strikes; the same bytes for any number of threads.
/// \throws InputError bad_option (sizes, names). What cannot be meshed throws nothing: see PartMesh::decisions.
[[nodiscard]] PAVIOR_INLINE PartMesh mesh_part(const AnyModel& model, const PartOptions& options,
                                               const Kernels& kernels);

namespace detail {

/// Makes a try with options whose names are resolved; \p seconds as for PartAttempt.
using GroupAttempt = std::function<MethodTry(PartMethod method, std::span<const SolidId> solids,
                                             const PartOptions& options, double seconds)>;

/// mesh_part() by another way to make a try.
[[nodiscard]] PAVIOR_INLINE PartMesh mesh_groups(const AnyModel& model, const PartOptions& options,
                                                 const GroupAttempt& attempt);

}  // namespace detail

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/part/mesh_part-inl.hpp>
#endif
