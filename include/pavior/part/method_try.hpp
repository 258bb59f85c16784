#pragma once
/// \file
/// The decision of mesh_part() as data: what was tried on which solids, and what came of it.

#include <pavior/brep/brep.hpp>
#include <pavior/mesh/grouped_mesh.hpp>
#include <pavior/part/part_options.hpp>

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
    std::size_t hexahedra = 0;
    double min_jacobian = -1;                  ///< least scaled Jacobian
    std::vector<std::string> warnings, notes;  ///< notes: how it was done, a line or more each
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

}  // namespace pavior
