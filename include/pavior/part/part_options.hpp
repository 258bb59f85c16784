#pragma once
/// \file
/// What may be asked of mesh_part() and mesh_file().

#include <pavior/core/execution.hpp>
#include <pavior/core/progress.hpp>

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace pavior {

/// How solids that touch become hexahedra. mixed: each by its own of the first three. decompose: cut into pieces that
/// these mesh together. split: the last resort, tetrahedra split in four each.
enum class PartMethod : std::uint8_t { submap, sweep, multi_sweep, mixed, block, split, decompose };

/// The stable name of \p method: "submap", "sweep", "multi-sweep", "mixed", "block", "split", "decompose".
[[nodiscard]] constexpr std::string_view to_string(PartMethod method) noexcept {
    switch (method) {
        case PartMethod::submap: return "submap";
        case PartMethod::sweep: return "sweep";
        case PartMethod::multi_sweep: return "multi-sweep";
        case PartMethod::mixed: return "mixed";
        case PartMethod::block: return "block";
        case PartMethod::split: return "split";
        case PartMethod::decompose: return "decompose";
    }
    return "unknown";
}

/// Lengths for some entities, in the unit of the model: by the user's tags (brep::tag), or by names in the file.
struct LocalLengths {
    std::map<int, double> edge = {};   ///< goes before everything else
    std::map<int, double> face = {};   ///< for its edges; the smallest of the faces at an edge
    std::map<int, double> solid = {};  ///< where no face length applies; the smallest of the solids at an edge
    /// For all faces and solids of that name.
    std::map<std::string, double> named = {};

    [[nodiscard]] bool empty() const { return edge.empty() && face.empty() && solid.empty() && named.empty(); }
    friend bool operator==(const LocalLengths&, const LocalLengths&) = default;
};

/// Lengths are in the unit of the model, seconds are wall time. Tags are the numbers by which users of the CAD file
/// know the entities (brep::tag).
struct PartOptions {
    double size = 0;          ///< wished length of mesh edges; 0: diagonal / 12
    LocalLengths local = {};  ///< others for some edges, faces and solids
    /// Curved edges turn by at most so many degrees from one mesh edge to the next, whatever the size; 1 to 90.
    double max_angle = 30;
    /// Of files with several solids: CadOptions::imprint_tolerance. mesh_file() reads the file with
    /// it; volumes and boundary nodes may be as far off as it admits.
    double imprint_tolerance = 0;
    /// Mesh also slices thinner than a hundredth of the size that are left where solids cut each other, which
    /// mesh_file() and mesh_model() refuse otherwise.
    bool allow_slices = false;
    double max_hexahedra = 0;  ///< refused where more are to be expected by volume and size; 0: no limit
    /// Tried in this order; empty: submap, sweep, multi_sweep, mixed, decompose, block, then the last resort.
    std::vector<PartMethod> methods = {};
    /// With `methods` empty, cut solids into pieces that the first four methods mesh together.
    bool decompose = true;
    /// With `methods` empty, split what no method meshes validly: a mesh for every closed solid, of more and of poorer
    /// hexahedra; and what none meshes with `sufficient`, if that helps. A third of the time is kept for it.
    bool last_resort = true;
    /// Nothing more is tried once a valid mesh has a least scaled Jacobian of this.
    double sufficient = 0.2;
    bool node_entities = true;  ///< fill PartMesh::entities: some evaluations of the model for each boundary node
    double seconds = 60;  ///< limit for each solid; 0: none. A method that others follow may use half of what is left
    double call_seconds = 0;           ///< limit of the whole call; solids not yet meshed share what is left. 0: none
    Execution execution = sequential;  ///< its stop token ends the call by Stopped
    Progress progress = {};            ///< never runs backwards
};

}  // namespace pavior
