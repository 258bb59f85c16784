#pragma once
/// \file
/// What mesh_part() and mesh_file() return: a mesh, and the decision as data.

#include <pavior/brep/brep.hpp>
#include <pavior/brep/node_entities.hpp>
#include <pavior/core/compiled.hpp>
#include <pavior/decompose/solid_cut.hpp>
#include <pavior/mesh/grouped_mesh.hpp>
#include <pavior/mesh/mesh_check.hpp>
#include <pavior/part/cad_deviation.hpp>
#include <pavior/part/part_options.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pavior {

/// How a try ended.
enum class TryOutcome : std::uint8_t {
    mesh,       ///< a valid mesh
    invalid,    ///< a mesh that is not
    refused,    ///< no mesh; the reason says why
    timed_out,  ///< ended at its limit
    died,       ///< a crash, or no memory
    not_tried,  ///< not needed, or no time left
};

/// The stable name of \p outcome, as written here.
[[nodiscard]] constexpr std::string_view to_string(TryOutcome outcome) noexcept {
    switch (outcome) {
        case TryOutcome::mesh: return "mesh";
        case TryOutcome::invalid: return "invalid";
        case TryOutcome::refused: return "refused";
        case TryOutcome::timed_out: return "timed_out";
        case TryOutcome::died: return "died";
        case TryOutcome::not_tried: return "not_tried";
    }
    return "unknown";
}

/// How one method fared on some solids.
struct MethodTry {
    PartMethod method = PartMethod::submap;
    TryOutcome outcome = TryOutcome::not_tried;
    std::string reason;      ///< why there is no valid mesh, or none at all
    std::vector<int> faces;  ///< ascending tags of the faces that the reason names
    double seconds = 0;
    /// Of outcomes mesh and invalid, dropped where another mesh is taken. Groups are the tags of solids and faces.
    HexMeshData data;
    std::vector<SolidId> hex_solid;  ///< one a hexahedron of data
    std::vector<FaceId> quad_face;   ///< one a quad of data
    std::size_t hexahedra = 0;
    double min_jacobian = -1;                  ///< least scaled Jacobian
    CadDeviation deviation;                    ///< of the mesh from the solids
    std::vector<std::string> warnings, notes;  ///< notes: how it was done, a line or more each
    std::vector<SolidCut> cuts;                ///< through the solids of the model, before they were meshed
    std::string report;                        ///< what Kernels::describe made of the method's own reports

    [[nodiscard]] bool has_mesh() const { return outcome == TryOutcome::mesh || outcome == TryOutcome::invalid; }
};

/// What was tried on solids that hang together, in order, and which of it was taken.
struct PartDecision {
    std::vector<SolidId> solids;
    std::vector<MethodTry> tries;
    std::optional<std::size_t> taken;  ///< a valid mesh, else an invalid one, else nothing
    bool out_of_time = false;

    [[nodiscard]] bool valid() const { return taken && tries[*taken].outcome == TryOutcome::mesh; }
};

/// Hexahedra of a model, what they belong to, and how they came about.
struct PartMesh {
    /// All meshes that were taken. Group numbers of hexahedra are tags of solids, those of quads tags of faces; quads
    /// are the mesh of the faces, counter-clockwise seen from outside.
    HexMeshData data;
    std::vector<SolidId> hex_solid;       ///< of the model, one a hexahedron of data
    std::vector<FaceId> quad_face;        ///< of the model, one a quad of data
    std::vector<PartDecision> decisions;  ///< one for each group of solids that touch
    MeshCheck check;                      ///< of data
    /// For each node of data the entity of the model that it lies on, and its parameters there; of valid meshes only.
    NodeEntities entities;
    std::vector<std::string> warnings;  ///< of the model as a whole; each try has its own
    CadDeviation deviation;             ///< of data from all solids that have a mesh
    double seconds = 0;

    /// Whether every solid has a mesh.
    [[nodiscard]] bool complete() const {
        return std::all_of(decisions.begin(), decisions.end(), [](const auto& d) { return d.taken.has_value(); });
    }
    /// Whether every solid has one that is valid, and all together are.
    [[nodiscard]] bool valid() const {
        return !decisions.empty() && check.valid() &&
               std::all_of(decisions.begin(), decisions.end(), [](const auto& d) { return d.valid(); });
    }
};

/// \throws InputError bad_option: sizes that are not positive (size may be 0), a time limit that is negative, an angle
/// that is not between 1 and 90 degrees
PAVIOR_INLINE void check_options(const PartOptions& options);

/// Why there is no valid mesh: a line for each try on each group that has none; empty for a valid mesh.
[[nodiscard]] PAVIOR_INLINE std::string reason_of(const PartMesh& part);

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/part/part_mesh-inl.hpp>
#endif
