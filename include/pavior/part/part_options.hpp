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

/// How solids that touch become hexahedra. mixed: each by its own of the first three.
enum class PartMethod : std::uint8_t { submap, sweep, multi_sweep, mixed, block };

/// The stable name of \p method: "submap", "sweep", "multi-sweep", "mixed", "block".
[[nodiscard]] constexpr std::string_view to_string(PartMethod method) noexcept {
    switch (method) {
        case PartMethod::submap: return "submap";
        case PartMethod::sweep: return "sweep";
        case PartMethod::multi_sweep: return "multi-sweep";
        case PartMethod::mixed: return "mixed";
        case PartMethod::block: return "block";
    }
    return "unknown";
}

/// Lengths are in the unit of the model, seconds are wall time. Tags are the numbers by which users of the CAD file
/// know the entities (brep::tag).
struct PartOptions {
    double size = 0;                        ///< wished length of mesh edges; 0: diagonal / 12
    std::map<int, double> edge_size = {};   ///< other lengths, by tag of the edge; goes before everything else
    std::map<int, double> face_size = {};   ///< by tag of the face: for its edges, the smallest of the faces at an edge
    std::map<int, double> solid_size = {};  ///< by tag of the solid: where no face size applies, the smallest of these
    /// The same by the names of faces and solids in the file; each must name some. Blocks know one size only: they are
    /// refused where others are asked for.
    std::map<std::string, double> named_size = {};
    /// Curved edges turn by at most so many degrees from one mesh edge to the next, whatever the size; 1 to 90.
    double max_angle = 30;
    /// Of files with several solids: CadOptions::imprint_tolerance. mesh_file() reads the file with
    /// it; volumes and boundary nodes may be as far off as it admits.
    double imprint_tolerance = 0;
    /// Mesh also slices thinner than a hundredth of the size that are left where solids cut each other, which
    /// mesh_file() and mesh_model() refuse otherwise.
    bool allow_slices = false;
    /// Tried in this order; empty: all, in the order of PartMethod.
    std::vector<PartMethod> methods = {};
    /// Nothing more is tried once a valid mesh has a least scaled Jacobian of this.
    double sufficient = 0.2;
    bool node_entities = true;  ///< fill PartMesh::entities: some evaluations of the model for each boundary node
    double seconds = 60;  ///< limit for each solid; 0: none. A method that others follow may use half of what is left
    Execution execution = sequential;  ///< its stop token ends the call by Stopped
    Progress progress = {};            ///< never runs backwards

    [[nodiscard]] bool local_sizes() const {
        return !edge_size.empty() || !face_size.empty() || !solid_size.empty() || !named_size.empty();
    }
};

}  // namespace pavior
