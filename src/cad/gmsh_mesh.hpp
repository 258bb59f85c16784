#pragma once
// The mesh that the current Gmsh model holds. Internal to the cad component.

#include <pavior/math/point.hpp>

#include <gmsh.h>

#include <cstddef>
#include <map>
#include <optional>
#include <vector>

namespace pavior::detail {

/// Gmsh's element types.
inline constexpr int line_type = 1;
inline constexpr int triangle_type = 2;
inline constexpr int tet_type = 4;

/// Elements of one type on an entity: node tags, so many an element.
inline std::vector<std::size_t> elements(int type, int tag) {
    std::vector<std::size_t> names;
    std::vector<std::size_t> nodes;
    gmsh::model::mesh::getElementsByType(type, names, nodes, tag);
    return nodes;
}

/// Coordinates by node tag.
inline std::map<std::size_t, Vec3> mesh_nodes() {
    std::vector<std::size_t> tags;
    std::vector<double> x;
    std::vector<double> parameters;
    gmsh::model::mesh::getNodes(tags, x, parameters, -1, -1, false, false);
    std::map<std::size_t, Vec3> nodes;
    for (std::size_t i = 0; i < tags.size(); ++i) {
        nodes.emplace(tags[i], Vec3(x[3 * i], x[3 * i + 1], x[3 * i + 2]));
    }
    return nodes;
}

/// The node on a vertex, if there is one.
inline std::optional<std::size_t> vertex_node(int vertex) {
    std::vector<std::size_t> tags;
    std::vector<double> x;
    std::vector<double> parameters;
    gmsh::model::mesh::getNodes(tags, x, parameters, 0, vertex, false, false);
    return tags.size() == 1 ? std::optional(tags[0]) : std::nullopt;
}

}  // namespace pavior::detail
