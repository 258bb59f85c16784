#pragma once

#include "meshed.hpp"

#include <pavior/glpk/solve_program.hpp>

#include <optional>

namespace pavior::cli {

/// Each method by itself: fills MethodTry::data, details, warnings and notes. \throws Error saying why there is no mesh
void try_submap(const GmshBrep& model, std::span<const SolidId> solids, const MeshCommand& command, MethodTry& result);
void try_sweep(const GmshBrep& model, std::span<const SolidId> solids, const MeshCommand& command, MethodTry& result);
void try_multi_sweep(const GmshBrep& model, std::span<const SolidId> solids, const MeshCommand& command,
                     const std::function<bool()>& out_of_time, MethodTry& result);
void try_mixed(const GmshBrep& model, std::span<const SolidId> solids, const MeshCommand& command,
               const std::function<bool()>& out_of_time, MethodTry& result);
void try_block(const GmshBrep& model, std::span<const SolidId> solids, const MeshCommand& command, MethodTry& result);

/// Raises the least scaled Jacobian of MethodTry::data where it is low, also by sliding nodes on plane faces and along
/// edges between such; nodes on curved faces and on vertices stay.
void improve_poor_mesh(const GmshBrep& model, const MeshCommand& command, MethodTry& result);

/// The solver of integer programs of a sweep: good within 0.1 %, at most ten seconds.
[[nodiscard]] inline IntegerSolution solve_shortly(const IntegerProgram& program) { return solve(program, {10, 1e-3}); }

struct Plane {
    Vec3 point, normal;  ///< unit normal, the face's own
};

/// The plane of a face, nothing for curved ones.
[[nodiscard]] std::optional<Plane> plane_of(const GmshBrep& model, FaceId face);

/// The wished length of mesh edges.
[[nodiscard]] inline double mesh_size(const GmshBrep& model, const MeshCommand& command) {
    return command.size > 0 ? command.size : model.diagonal() / 12;
}

}  // namespace pavior::cli
