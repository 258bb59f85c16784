#include "check.hpp"

#include <algorithm>
#include <array>
#include <iomanip>
#include <map>
#include <ostream>
#include <sstream>

namespace pavior::cli {

namespace {

using Json = nlohmann::json;

struct NamedMetric {
    const char* title;
    const char* key;
    const Statistics* statistics;
};

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

void print_histogram(std::ostream& out, const NamedMetric& metric) {
    constexpr std::size_t width = 50;
    const Statistics& s = *metric.statistics;
    const std::size_t most = *std::max_element(s.histogram.begin(), s.histogram.end());
    out << "\n" << metric.title << "\n";
    for (std::size_t bin = 0; bin < s.histogram.size(); ++bin) {
        const double step = (s.high - s.low) / static_cast<double>(s.histogram.size());
        const double low = s.low + step * static_cast<double>(bin);
        const std::size_t count = s.histogram[bin];
        const std::size_t bar =
            count == 0 ? 0 : std::max<std::size_t>(1, count * width / std::max<std::size_t>(most, 1));
        out << "  " << std::fixed << std::setprecision(2) << std::setw(5) << low << " .. " << std::setw(5) << low + step
            << std::setw(10) << count << "  " << std::string(bar, '#') << "\n";
    }
}

Json to_json(const Statistics& s) {
    return {{"min", s.min},         {"max", s.max}, {"mean", s.mean}, {"stddev", s.stddev},
            {"worst_hex", s.worst}, {"low", s.low}, {"high", s.high}, {"histogram", s.histogram}};
}

}  // namespace

MeshCheck check_mesh(const HexMeshData& data, Execution execution) {
    MeshCheck check;
    check.nodes = data.mesh.nodes.size();
    check.hexahedra = data.mesh.hexes.size();
    check.verify = verify_hexes(data.mesh);
    const bool readable = check.verify.find(MeshFault::id_out_of_range) == nullptr;
    if (readable && check.hexahedra > 0) {
        check.quality = hex_quality(data.mesh, {.execution = execution});
    }
    return check;
}

void print_check(std::ostream& out, const HexMeshData& data, const MeshCheck& check) {
    std::ostringstream text;
    text << "nodes        " << check.nodes << "\nhexahedra    " << check.hexahedra << "\nquads        "
         << data.quads.size() << "\ninverted     " << check.quality.inverted << "\nvolume       "
         << std::setprecision(15) << check.verify.volume << "\nconforming   " << (check.verify.ok() ? "yes" : "no")
         << "\n";
    if (!check.verify.ok()) {
        text << "faults:\n" << check.verify.text() << "\n";
    }
    if (check.quality.f_shape.count > 0) {
        text << "\n"
             << std::left << std::setw(28) << "metric" << std::right << std::setw(10) << "min" << std::setw(10)
             << "mean" << std::setw(10) << "max" << std::setw(10) << "stddev"
             << "  worst hexahedron\n";
        for (const NamedMetric& metric : metrics(check.quality)) {
            const Statistics& s = *metric.statistics;
            text << std::left << std::setw(28) << metric.title << std::right << std::fixed << std::setprecision(4)
                 << std::setw(10) << s.min << std::setw(10) << s.mean << std::setw(10) << s.max << std::setw(10)
                 << s.stddev << "  " << s.worst << "\n";
        }
        for (const NamedMetric& metric : metrics(check.quality)) {
            print_histogram(text, metric);
        }
    }
    if (const auto sizes = group_sizes(data); !sizes.empty()) {
        text << "\ngroups\n";
        for (const auto& [group, size] : sizes) {
            text << "  " << (group.first == 3 ? "volume " : "surface") << std::setw(6) << group.second << std::setw(10)
                 << size << "  " << group_name(data, group.first, group.second) << "\n";
        }
    }
    out << text.str();
}

Json to_json(const HexMeshData& data, const MeshCheck& check) {
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
    for (const auto& [group, size] : group_sizes(data)) {
        json["groups"].push_back({{"dimension", group.first},
                                  {"number", group.second},
                                  {"name", group_name(data, group.first, group.second)},
                                  {"cells", size}});
    }
    return json;
}

}  // namespace pavior::cli
