#pragma once

#include "commands.hpp"

#include <pavior/cad/gmsh_brep.hpp>
#include <pavior/core/error.hpp>
#include <pavior/io/mesh_file.hpp>

#include <nlohmann/json.hpp>

#include <cstddef>
#include <functional>
#include <iosfwd>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace pavior::cli {

/// The name of \p method on the command line.
[[nodiscard]] std::string_view to_string(MeshMethod method);

/// How one method fared on some solids.
struct MethodTry {
    enum class Outcome { mesh, invalid, refused, timed_out, died, not_tried };

    MeshMethod method = MeshMethod::submap;
    Outcome outcome = Outcome::not_tried;
    std::string reason;      ///< why there is no valid mesh
    std::vector<int> faces;  ///< tags of the faces that the reason names
    double seconds = 0;
    HexMeshData data;  ///< of outcomes mesh and invalid; dropped where another mesh is taken
    std::size_t hexahedra = 0;
    double min_jacobian = -1;                  ///< least scaled Jacobian
    std::vector<std::string> warnings, notes;  ///< notes: further lines for --explain
    nlohmann::json details = nlohmann::json::object();

    [[nodiscard]] bool has_mesh() const { return outcome == Outcome::mesh || outcome == Outcome::invalid; }
};

[[nodiscard]] std::string_view to_string(MethodTry::Outcome outcome);

/// What the method makes of the solids; errors of any kind end in the outcome.
/// \p out_of_time may be asked now and then.
[[nodiscard]] MethodTry try_method(MeshMethod method, const GmshBrep& model, std::span<const SolidId> solids,
                                   const MeshCommand& command, const std::function<bool()>& out_of_time);

/// The same in a child process that is killed after \p seconds (0: no limit).
[[nodiscard]] MethodTry try_method_in_child(MeshMethod method, const GmshBrep& model, std::span<const SolidId> solids,
                                            const MeshCommand& command, double seconds);

/// What was tried on solids that hang together, in order, and which of it was taken.
struct MeshDecision {
    std::vector<SolidId> solids;
    std::vector<MethodTry> tries;
    std::optional<std::size_t> taken;  ///< a valid mesh, else an invalid one, else nothing
    bool out_of_time = false;

    [[nodiscard]] bool valid() const { return taken && tries[*taken].outcome == MethodTry::Outcome::mesh; }
};

/// Tries one method after the other, or only the one that the command names.
[[nodiscard]] MeshDecision decide(const GmshBrep& model, std::vector<SolidId> solids, const MeshCommand& command);

/// "solid 3" or "solids 1, 2".
[[nodiscard]] std::string solids_text(const GmshBrep& model, std::span<const SolidId> solids);

void print_tree(std::ostream& out, const GmshBrep& model, const MeshCommand& command,
                std::span<const MeshDecision> decisions);
[[nodiscard]] nlohmann::json to_json(const GmshBrep& model, const MeshDecision& decision);

}  // namespace pavior::cli
