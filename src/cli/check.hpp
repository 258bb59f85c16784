#pragma once

#include <pavior/io/mesh_file.hpp>
#include <pavior/mesh/quality.hpp>
#include <pavior/mesh/verify_hexes.hpp>

#include <nlohmann/json.hpp>

#include <iosfwd>

namespace pavior::cli {

/// Everything that the program says about a mesh.
struct MeshCheck {
    HexReport verify;
    HexQuality quality;
    std::size_t nodes = 0, hexahedra = 0;

    [[nodiscard]] bool valid() const { return verify.ok() && quality.inverted == 0; }
};

[[nodiscard]] MeshCheck check_mesh(const HexMeshData& data, Execution execution);

/// Table of counts, conformity and groups, and a histogram a metric.
void print_check(std::ostream& out, const HexMeshData& data, const MeshCheck& check);

[[nodiscard]] nlohmann::json to_json(const HexMeshData& data, const MeshCheck& check);

}  // namespace pavior::cli
