#include "mesh_bytes.hpp"

#include <pavior/core/assert.hpp>

#include <cstdint>
#include <cstring>
#include <type_traits>

namespace pavior::cli {

namespace {

class Writer {
public:
    template <class Array>
    void add(const Array& array) {
        using Value = typename Array::value_type;
        static_assert(std::is_trivially_copyable_v<Value> || std::is_same_v<Value, Vec3>);
        const std::uint64_t count = array.size();
        bytes_.append(reinterpret_cast<const char*>(&count), sizeof count);
        bytes_.append(reinterpret_cast<const char*>(array.data()), array.size() * sizeof(Value));
    }
    [[nodiscard]] std::string take() { return std::move(bytes_); }

private:
    std::string bytes_;
};

class Reader {
public:
    explicit Reader(const std::string& bytes) : bytes_(bytes) {}

    template <class Array>
    void get(Array& array) {
        std::uint64_t count = 0;
        copy(&count, sizeof count);
        array.resize(count);
        copy(array.data(), array.size() * sizeof(typename Array::value_type));
    }

private:
    void copy(void* to, std::size_t size) {
        PAVIOR_ASSERT(at_ + size <= bytes_.size());
        std::memcpy(to, bytes_.data() + at_, size);
        at_ += size;
    }

    const std::string& bytes_;
    std::size_t at_ = 0;
};

using Json = nlohmann::json;

}  // namespace

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
              {"details", result.details},
              {"groups", Json::array()}};
    for (const MeshGroup& group : data.groups) {
        json["groups"].push_back({group.dimension, group.number, group.name});
    }
    Writer writer;
    writer.add(Json::to_cbor(json));
    writer.add(data.mesh.nodes);
    writer.add(data.mesh.hexes);
    writer.add(data.quads);
    writer.add(data.hex_groups);
    writer.add(data.quad_groups);
    return writer.take();
}

MethodTry try_from_bytes(const std::string& bytes) {
    Reader reader(bytes);
    std::vector<std::uint8_t> head;
    reader.get(head);
    const Json json = Json::from_cbor(head);
    MethodTry result;
    result.method = static_cast<MeshMethod>(json["method"].get<int>());
    result.outcome = static_cast<MethodTry::Outcome>(json["outcome"].get<int>());
    result.reason = json["reason"];
    result.faces = json["faces"].get<std::vector<int>>();
    result.seconds = json["seconds"];
    result.min_jacobian = json["min_jacobian"];
    result.hexahedra = json["hexahedra"];
    result.warnings = json["warnings"].get<std::vector<std::string>>();
    result.notes = json["notes"].get<std::vector<std::string>>();
    result.details = json["details"];
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

}  // namespace pavior::cli
