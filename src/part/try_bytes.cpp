#include "try_bytes.hpp"

#include "../common/mesh_bytes.hpp"
#include "../report/report_json.hpp"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <optional>
#include <string>

namespace pavior::detail {

using Json = nlohmann::json;

namespace {

Json number_or_null(const std::optional<double>& value) { return value ? Json(*value) : Json(); }

std::optional<double> optional_number(const Json& json) {
    return json.is_null() ? std::nullopt : std::optional(json.get<double>());
}

Json to_json_numbers(const CadDeviation& deviation) {
    return {deviation.volume, number_or_null(deviation.cad_volume), number_or_null(deviation.distance),
            deviation.between, deviation.size};
}

CadDeviation deviation_of(const Json& json) {
    return {json[0].get<double>(), optional_number(json[1]), optional_number(json[2]), json[3].get<double>(),
            json[4].get<double>()};
}

Vec3 point_of(const Json& json) { return {json[0].get<double>(), json[1].get<double>(), json[2].get<double>()}; }

CutSurface surface_of(const Json& json) {
    const std::string kind = json["kind"];
    if (kind == "plane") {
        return CutPlane{point_of(json["point"]), point_of(json["normal"])};
    }
    if (kind == "half-plane") {
        return CutHalfPlane{point_of(json["point"]), point_of(json["along"]), point_of(json["into"])};
    }
    return CutCylinder{point_of(json["point"]), point_of(json["direction"]), json["radius"].get<double>(),
                       point_of(json["seam"])};
}

SolidCut cut_of(const Json& json) {
    SolidCut cut{{json["solid"].get<std::int32_t>()}, {}, CutReason::step};
    for (const CutReason reason :
         {CutReason::blend_foot, CutReason::concave_edge, CutReason::junction, CutReason::axis_plane,
          CutReason::round_hole, CutReason::slab, CutReason::step, CutReason::between, CutReason::square}) {
        cut.reason = json["reason"] == to_string(reason) ? reason : cut.reason;
    }
    for (const Json& surface : json["surfaces"]) {
        cut.surfaces.push_back(surface_of(surface));
    }
    for (const Json& curve : json.value("curves", Json::array())) {
        cut.curves.push_back({point_of(curve[0]), point_of(curve[1]), point_of(curve[2])});
    }
    return cut;
}

}  // namespace

std::string to_bytes(const MethodTry& result) {
    Json cuts = Json::array();
    for (const SolidCut& cut : result.cuts) {
        cuts.push_back(to_json(cut));
    }
    const Json json{{"method", static_cast<int>(result.method)},
                    {"outcome", static_cast<int>(result.outcome)},
                    {"reason", result.reason},
                    {"faces", result.faces},
                    {"seconds", result.seconds},
                    {"min_jacobian", result.min_jacobian},
                    {"hexahedra", result.hexahedra},
                    {"warnings", result.warnings},
                    {"notes", result.notes},
                    {"report", result.report},
                    {"cuts", cuts},
                    {"deviation", to_json_numbers(result.deviation)}};
    ByteWriter writer;
    writer.add(Json::to_cbor(json));
    add_mesh(writer, result.data);
    writer.add(result.hex_solid);
    writer.add(result.quad_face);
    return writer.take();
}

MethodTry try_from_bytes(const std::string& bytes) {
    ByteReader reader(bytes);
    std::vector<std::uint8_t> head;
    reader.get(head);
    const Json json = Json::from_cbor(head);
    MethodTry result;
    result.method = static_cast<PartMethod>(json["method"].get<int>());
    result.outcome = static_cast<TryOutcome>(json["outcome"].get<int>());
    result.reason = json["reason"];
    result.faces = json["faces"].get<std::vector<int>>();
    result.seconds = json["seconds"];
    result.min_jacobian = json["min_jacobian"];
    result.hexahedra = json["hexahedra"];
    result.warnings = json["warnings"].get<std::vector<std::string>>();
    result.notes = json["notes"].get<std::vector<std::string>>();
    result.report = json["report"];
    for (const Json& cut : json["cuts"]) {
        result.cuts.push_back(cut_of(cut));
    }
    result.deviation = deviation_of(json["deviation"]);
    result.data = get_mesh(reader);
    reader.get(result.hex_solid);
    reader.get(result.quad_face);
    return result;
}

}  // namespace pavior::detail
