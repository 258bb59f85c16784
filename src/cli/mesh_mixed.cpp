#include "grouped.hpp"
#include "mesh_methods.hpp"
#include "refining.hpp"

#include <pavior/cad/cap_mesh.hpp>
#include <pavior/cad/region_quads.hpp>
#include <pavior/imprint/imprint.hpp>
#include <pavior/part/mixed_solids.hpp>

namespace pavior::cli {

using Json = nlohmann::json;

namespace {

std::string_view name_of(SolidMethod method) {
    switch (method) {
        case SolidMethod::submap: return to_string(MeshMethod::submap);
        case SolidMethod::sweep: return to_string(MeshMethod::sweep);
        case SolidMethod::multi_sweep: return to_string(MeshMethod::multi_sweep);
    }
    return "unknown";
}

}  // namespace

void try_mixed(const GmshBrep& model, std::span<const SolidId> solids, const MeshCommand& command,
               const std::function<bool()>& out_of_time, MethodTry& result) {
    MixedOptions options;
    options.size = mesh_size(model, command);
    options.execution = Execution{command.threads};
    MixedSolids mesh = with_finer_sizes(options.size, result.warnings, [&](double size, int min_loop) {
        options.size = size;
        options.min_loop = min_loop;
        return mixed_solids(model, solids, options, imprint, solve_shortly, GmshRegionMesher{}, GmshCapMesher{&model},
                            out_of_time);
    });
    result.details["solids"] = Json::array();
    for (const auto& [solid, method] : mesh.methods) {
        const int tag = model.tag(3, solid.index());
        result.details["solids"].push_back({{"solid", tag}, {"method", name_of(method)}});
        result.notes.push_back("solid " + std::to_string(tag) + ": " + std::string(name_of(method)));
    }
    result.data = grouped(model, solids, mesh);
}

}  // namespace pavior::cli
