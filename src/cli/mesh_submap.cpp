#include "grouped.hpp"
#include "mesh_methods.hpp"
#include "swept.hpp"

#include <pavior/glpk/solve_program.hpp>
#include <pavior/submap/submap_model.hpp>

#include <sstream>

namespace pavior::cli {

using Json = nlohmann::json;

void try_submap(const GmshBrep& model, std::span<const SolidId> solids, const MeshCommand& command, MethodTry& result) {
    IntervalOptions intervals;
    intervals.size = mesh_size(model, command);
    SubmappedMesh mesh = submap_model(model, solids, intervals, GlpkSolver{});
    Json& json = result.details;
    json["solids"] = Json::array();
    for (const SubmapSolidReport& solid : mesh.solids) {
        json["solids"].push_back({{"solid", model.tag(3, solid.solid.index())},
                                  {"hexahedra", solid.hex_count},
                                  {"low", solid.low},
                                  {"high", solid.high},
                                  {"deviation_degrees", solid.deviation},
                                  {"smooth", cli::to_json(solid.smooth)}});
        std::ostringstream note;
        note << "box of the lattice " << solid.high[0] - solid.low[0] << " x " << solid.high[1] - solid.low[1] << " x "
             << solid.high[2] - solid.low[2] << ", angles within " << solid.deviation << " degrees of their class";
        result.notes.push_back(note.str());
    }
    result.data = grouped(model, solids, mesh);
}

}  // namespace pavior::cli
