#include "report_json.hpp"

#include <pavior/block/block_solid.hpp>
#include <pavior/part/kernels.hpp>

namespace pavior::detail {

namespace {

using Json = nlohmann::json;

Json marking_json(const SheetReport& report) {
    Json json{{"valid", report.valid},
              {"propagation", report.propagation == Propagation::full ? "full" : "stop"},
              {"grouping", report.grouping == Grouping::exact ? "exact" : "blended"},
              {"rounds", report.rounds},
              {"tries", report.tries}};
    json["sheets"] = Json::array();
    for (const Sheet& sheet : report.sheets) {
        json["sheets"].push_back({{"kind", to_string(sheet.kind)}, {"curves", sheet.curves}, {"faces", sheet.faces}});
    }
    return json;
}

Json violations_json(const DualReport& report) {
    Json json = Json::array();
    for (const DualViolation& violation : report.violations) {
        Json ids = Json::array();
        for (const Index id : violation.ids) {
            if (id != no_index) {
                ids.push_back(id);
            }
        }
        json.push_back({{"fault", to_string(violation.fault)}, {"ids", ids}, {"text", describe(violation)}});
    }
    return json;
}

Json blocks_json(const SolidBlocks& solid) {
    const BlockReport& report = solid.report.blocks;
    return {{"blocks", report.blocks},
            {"nodes", report.nodes()},
            {"vertices", report.vertices},
            {"chains", report.chains},
            {"patches", report.patches},
            {"cells", report.cells},
            {"sheets", report.sheets},
            {"boundary_quads", report.boundary_quads},
            {"euler", report.euler},
            {"conforming", report.conforming()},
            {"min_scaled_jacobian", solid.placement.min_jacobian},
            {"moved_nodes", solid.placement.moved},
            {"inverted", solid.placement.inverted}};
}

Json refinement_json(const RefinedBlocks& fine) {
    Json json{{"untangling", to_json(fine.untangling)}, {"inverted_blocks", fine.inverted_blocks}};
    json["sheets"] = Json::array();
    for (const SheetIntervals& sheet : fine.sheets) {
        json["sheets"].push_back({{"intervals", sheet.intervals},
                                  {"edges", sheet.edges},
                                  {"shortest", sheet.shortest},
                                  {"longest", sheet.longest},
                                  {"mean", sheet.mean},
                                  {"turning", sheet.turning}});
    }
    return json;
}

}  // namespace

Json to_json(const BlockReference& input, const SolidBlocks& solid) {
    const BlockSolidReport& report = solid.report;
    Json json{{"status", to_string(report.status)}, {"marking", marking_json(report.marking)}};
    json["reference"] = {{"nodes", input.mesh.nodes.size()},
                         {"tetrahedra", input.mesh.tets.size()},
                         {"nodes_cut", solid.reference.nodes.size()},
                         {"tetrahedra_cut", solid.reference.tets.size()},
                         {"layer_faces", solid.reference.layers.size()}};
    json["violations"] = violations_json(report.dual);
    json["blocks"] = report.dual.valid() ? blocks_json(solid) : Json();  // there are none of an invalid dual
    if (solid.fine) {
        json["refinement"] = refinement_json(*solid.fine);
    }
    json["times"] = {{"read", input.read_seconds},        {"tetrahedra", input.tetra_seconds},
                     {"marking", report.marking_seconds}, {"dual", report.dual_seconds},
                     {"dualize", report.dualize_seconds}, {"place", report.place_seconds},
                     {"refine", report.refine_seconds}};
    return json;
}

}  // namespace pavior::detail
