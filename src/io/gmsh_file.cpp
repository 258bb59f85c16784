#include "formats.hpp"

#include <pavior/core/error.hpp>

#include "../common/gmsh_session.hpp"

#include <gmsh.h>

#include <algorithm>

namespace pavior::io {

namespace {

constexpr int gmsh_quad = 3;
constexpr int gmsh_hex = 5;

/// Runs \p body in a model of its own; whatever Gmsh throws becomes a FileError.
template <class Body>
auto in_scratch_model(const std::string& file, Body&& body) {
    const detail::GmshSession session;
    return detail::with_gmsh(
        [&] {
            const detail::GmshScratchModel model("pavior mesh file");
            return body();
        },
        [&](const std::string& message) { throw FileError(file, "Gmsh refuses it: " + message); });
}

/// Position of each node tag: tags may be sparse.
std::vector<std::int64_t> position_of_tag(const std::vector<std::size_t>& tags) {
    std::vector<std::int64_t> position(tags.empty() ? 0 : *std::max_element(tags.begin(), tags.end()) + 1, -1);
    for (std::size_t i = 0; i < tags.size(); ++i) {
        position[tags[i]] = static_cast<std::int64_t>(i);
    }
    return position;
}

void read_nodes(HexMeshData& data, std::vector<std::int64_t>& position) {
    std::vector<std::size_t> tags;
    std::vector<double> coordinates;
    std::vector<double> parameters;
    gmsh::model::mesh::getNodes(tags, coordinates, parameters, -1, -1, false, false);
    std::vector<std::size_t> order(tags.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
        order[i] = i;
    }
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return tags[a] < tags[b]; });
    std::vector<std::size_t> sorted;
    for (const std::size_t i : order) {
        sorted.push_back(tags[i]);
        data.mesh.nodes.emplace_back(coordinates[3 * i], coordinates[3 * i + 1], coordinates[3 * i + 2]);
    }
    position = position_of_tag(sorted);
}

/// Cells of one entity, with the number of its first physical group.
template <class Cells>
void read_cells(const std::string& file, const gmsh::vectorpair::value_type& entity, int type, Cells& cells,
                std::vector<std::int32_t>& groups, const std::vector<std::int64_t>& position) {
    std::vector<std::size_t> tags;
    std::vector<std::size_t> nodes;
    gmsh::model::mesh::getElementsByType(type, tags, nodes, entity.second);
    std::vector<int> physical;
    gmsh::model::getPhysicalGroupsForEntity(entity.first, entity.second, physical);
    constexpr std::size_t corners = std::tuple_size_v<typename Cells::value_type>;
    for (std::size_t e = 0; e < tags.size(); ++e) {
        typename Cells::value_type cell{};
        for (std::size_t k = 0; k < corners; ++k) {
            const std::size_t tag = nodes[corners * e + k];
            if (tag >= position.size() || position[tag] < 0) {
                throw FileError(file, "element " + std::to_string(tags[e]) + " names a node that does not exist");
            }
            cell[k] = static_cast<Index>(position[tag]);
        }
        cells.push_back(cell);
        groups.push_back(physical.empty() ? 0 : physical.front());
    }
}

void refuse_other_volumes(const std::string& file) {
    std::vector<int> types;
    gmsh::model::mesh::getElementTypes(types, 3);
    for (const int type : types) {
        if (type != gmsh_hex) {
            throw FileError(
                file, "holds volume elements of Gmsh type " + std::to_string(type) + ", not only linear hexahedra");
        }
    }
}

}  // namespace

HexMeshData read_gmsh(const std::string& file) {
    return in_scratch_model(file, [&] {
        gmsh::merge(file);
        refuse_other_volumes(file);
        HexMeshData data;
        std::vector<std::int64_t> position;
        read_nodes(data, position);
        gmsh::vectorpair entities;
        gmsh::model::getEntities(entities);
        for (const auto& entity : entities) {
            if (entity.first == 3) {
                read_cells(file, entity, gmsh_hex, data.mesh.hexes, data.hex_groups, position);
            } else if (entity.first == 2) {
                read_cells(file, entity, gmsh_quad, data.quads, data.quad_groups, position);
            }
        }
        gmsh::vectorpair physical;
        gmsh::model::getPhysicalGroups(physical);
        for (const auto& [dimension, number] : physical) {
            std::string name;
            gmsh::model::getPhysicalName(dimension, number, name);
            data.groups.push_back({dimension, number, name});
        }
        return data;
    });
}

}  // namespace pavior::io
