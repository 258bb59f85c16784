#include "report_json.hpp"

#include <pavior/io/group_names.hpp>
#include <pavior/part/cad_deviation.hpp>

#include <optional>
#include <string>
#include <vector>

namespace pavior::detail {

using Json = nlohmann::json;

std::array<NamedMetric, 3> metrics(const HexQuality& quality) {
    return {{{"f_shape (Knupp)", "f_shape", &quality.f_shape},
             {"Shape (Verdict)", "verdict_shape", &quality.verdict_shape},
             {"scaled Jacobian (Verdict)", "scaled_jacobian", &quality.scaled_jacobian}}};
}

std::map<std::pair<int, int>, std::size_t> group_sizes(const HexMeshData& data) {
    std::map<std::pair<int, int>, std::size_t> sizes;
    for (const auto group : data.hex_groups) {
        ++sizes[{3, group}];
    }
    for (const auto group : data.quad_groups) {
        ++sizes[{2, group}];
    }
    return sizes;
}

namespace {

Json to_json(const Statistics& s) {
    return {{"min", s.min},         {"max", s.max}, {"mean", s.mean}, {"stddev", s.stddev},
            {"worst_hex", s.worst}, {"low", s.low}, {"high", s.high}, {"histogram", s.histogram}};
}

}  // namespace

Json to_json(const HexMeshData& data, const MeshCheck& check, std::optional<MeshFormat> format) {
    Json json{{"nodes", check.nodes},
              {"hexahedra", check.hexahedra},
              {"quads", data.quads.size()},
              {"valid", check.valid()},
              {"inverted", check.quality.inverted},
              {"volume", check.verify.volume},
              {"boundary_flux", check.verify.boundary_flux}};
    json["faults"] = Json::array();
    for (const Finding& finding : check.verify.findings()) {
        json["faults"].push_back({{"fault", to_string(finding.fault)}, {"count", finding.count}, {"ids", finding.ids}});
    }
    if (check.quality.f_shape.count > 0) {
        for (const NamedMetric& metric : metrics(check.quality)) {
            json["quality"][metric.key] = to_json(*metric.statistics);
        }
    }
    json["groups"] = Json::array();
    std::map<std::pair<int, int>, std::string> written;
    for (const MeshGroup& group : format ? names_in_file(data, *format) : std::vector<MeshGroup>()) {
        written[{group.dimension, group.number}] = group.name;
    }
    for (const auto& [group, size] : group_sizes(data)) {
        Json entry{{"dimension", group.first},
                   {"number", group.second},
                   {"name", group_name(data, group.first, group.second)},
                   {"cells", size}};
        if (format) {
            entry["written_as"] = written[group];
        }
        json["groups"].push_back(std::move(entry));
    }
    return json;
}

Json to_json(const CadDeviation& deviation) {
    const auto number = [](const std::optional<double>& value) { return value ? Json(*value) : Json(); };
    return {{"volume", deviation.volume},
            {"cad_volume", number(deviation.cad_volume)},
            {"relative_volume", number(deviation.relative_volume())},
            {"distance", number(deviation.distance)},
            {"distance_in_sizes", number(deviation.distance_in_sizes())},
            {"size", deviation.size}};
}

}  // namespace pavior::detail
