#include "try_bytes.hpp"

#include "../common/byte_arrays.hpp"

#include <nlohmann/json.hpp>

#include <cstdint>

namespace pavior::detail {

using Json = nlohmann::json;

std::string to_bytes(const MethodTry& result) {
    const HexMeshData& data = result.data;
    Json json{{"method", static_cast<int>(result.method)},
              {"outcome", static_cast<int>(result.outcome)},
              {"reason", result.reason},
              {"faces", result.faces},
              {"seconds", result.seconds},
              {"min_jacobian", result.min_jacobian},
              {"hexahedra", result.hexahedra},
              {"warnings", result.warnings},
              {"notes", result.notes},
              {"report", result.report},
              {"groups", Json::array()}};
    for (const MeshGroup& group : data.groups) {
        json["groups"].push_back({group.dimension, group.number, group.name});
    }
    ByteWriter writer;
    writer.add(Json::to_cbor(json));
    writer.add(data.mesh.nodes);
    writer.add(data.mesh.hexes);
    writer.add(data.quads);
    writer.add(data.hex_groups);
    writer.add(data.quad_groups);
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
    HexMeshData& data = result.data;
    for (const Json& group : json["groups"]) {
        data.groups.push_back({group[0].get<int>(), group[1].get<int>(), group[2].get<std::string>()});
    }
    reader.get(data.mesh.nodes);
    reader.get(data.mesh.hexes);
    reader.get(data.quads);
    reader.get(data.hex_groups);
    reader.get(data.quad_groups);
    return result;
}

}  // namespace pavior::detail
