#include "tet_mesh_formats.hpp"

#include <pavior/core/error.hpp>

#include "../common/gmsh_session.hpp"

#include <gmsh.h>

#include <algorithm>
#include <array>
#include <unordered_map>
#include <utility>

namespace pavior::io {

namespace {

/// Gmsh's element types and their dimensions.
constexpr int point_type = 15;
constexpr int line_type = 1;
constexpr int triangle_type = 2;
constexpr int tet_type = 4;

class GmshTets {
public:
    explicit GmshTets(const std::string& file) : file_(file) {}

    RawTetMesh read() {
        read_nodes();
        gmsh::vectorpair entities;
        gmsh::model::getEntities(entities);
        for (const auto& [dimension, tag] : entities) {
            refuse_others(dimension, tag);
            switch (dimension) {
                case 0: read_cells(dimension, tag, point_type, mesh_.points); break;
                case 1: read_cells(dimension, tag, line_type, mesh_.lines); break;
                case 2: read_cells(dimension, tag, triangle_type, mesh_.triangles); break;
                default: read_cells(dimension, tag, tet_type, mesh_.tets); break;
            }
        }
        return std::move(mesh_);
    }

private:
    /// In the order of their tags.
    void read_nodes() {
        std::vector<std::size_t> tags;
        std::vector<double> coordinates;
        std::vector<double> parameters;
        gmsh::model::mesh::getNodes(tags, coordinates, parameters, -1, -1, false, false);
        std::vector<std::size_t> order(tags.size());
        for (std::size_t i = 0; i < order.size(); ++i) {
            order[i] = i;
        }
        std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return tags[a] < tags[b]; });
        for (const std::size_t i : order) {
            position_.emplace(tags[i], static_cast<Index>(mesh_.nodes.size()));
            mesh_.nodes.emplace_back(coordinates[3 * i], coordinates[3 * i + 1], coordinates[3 * i + 2]);
        }
    }

    void refuse_others(int dimension, int tag) const {
        constexpr std::array<int, 4> wanted{point_type, line_type, triangle_type, tet_type};
        std::vector<int> types;
        gmsh::model::mesh::getElementTypes(types, dimension, tag);
        for (const int type : types) {
            if (type != wanted[static_cast<std::size_t>(dimension)]) {
                throw FileError(file_, "holds elements of Gmsh type " + std::to_string(type) +
                                           ", not only linear tetrahedra, triangles, lines and points");
            }
        }
    }

    template <class Corners>
    void read_cells(int dimension, int entity, int type, TaggedCells<Corners>& cells) {
        std::vector<std::size_t> tags;
        std::vector<std::size_t> nodes;
        gmsh::model::mesh::getElementsByType(type, tags, nodes, entity);
        std::vector<int> physical;
        gmsh::model::getPhysicalGroupsForEntity(dimension, entity, physical);
        constexpr std::size_t size = std::tuple_size_v<Corners>;
        for (std::size_t e = 0; e < tags.size(); ++e) {
            Corners corners{};
            for (std::size_t k = 0; k < size; ++k) {
                const auto at = position_.find(nodes[size * e + k]);
                if (at == position_.end()) {
                    throw FileError(file_, "element " + std::to_string(tags[e]) + " names a node that does not exist",
                                    {static_cast<std::int64_t>(tags[e])});
                }
                corners[k] = at->second;
            }
            cells.add(corners, physical.empty() ? entity : physical.front(), static_cast<std::int64_t>(tags[e]));
        }
    }

    const std::string& file_;
    RawTetMesh mesh_;
    std::unordered_map<std::size_t, Index> position_;
};

}  // namespace

RawTetMesh read_gmsh_tets(const std::string& file) {
    const detail::GmshSession session;
    return detail::with_gmsh(
        [&] {
            const detail::GmshScratchModel model("pavior tetrahedra file");
            gmsh::merge(file);
            return GmshTets(file).read();
        },
        [&](const std::string& message) { throw FileError(file, "Gmsh refuses it: " + message); });
}

}  // namespace pavior::io
