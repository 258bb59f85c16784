#include "raw_surface.hpp"

#include "gmsh_model.hpp"
#include "orient_shells.hpp"

#include <pavior/core/error.hpp>

#include <algorithm>
#include <cstdint>
#include <unordered_map>
#include <utility>

namespace pavior::detail {

namespace {

/// A face with its triangles, and the solids that it bounds.
struct Face {
    std::span<const std::size_t> corners;  ///< names of nodes, three a triangle
    std::vector<int> solids;
};

class Collector {
public:
    Collector(const RawSurface& raw, std::span<const int> solids) : raw_(raw), solids_(solids) {}

    CadTriangulation run() {
        for (const int solid : solids_) {
            for (const int face : boundary_of(3, solid)) {
                Face& own = faces_[face];
                own.corners = raw_.faces.at(face);
                own.solids.push_back(solid);
            }
        }
        collect_nodes();
        for (const int solid : solids_) {
            collect_solid(solid);
            double volume = 0;
            gmsh::model::occ::getMass(3, solid, volume);
            result_.volume += volume;
        }
        collect_curves();
        result_.chord = raw_.chord;
        return std::move(result_);
    }

private:
    void collect_nodes() {
        std::set<std::size_t> used;
        for (const auto& [tag, face] : faces_) {
            used.insert(face.corners.begin(), face.corners.end());
        }
        for (const std::size_t name : used) {
            number_.emplace(name, static_cast<Index>(result_.surface.mesh.nodes.size()));
            result_.surface.mesh.nodes.push_back(raw_.nodes.at(name));
        }
    }

    void collect_solid(int solid) {
        std::vector<TriCorners> triangles;
        std::vector<int> tags;
        for (const auto& [tag, face] : faces_) {
            // Twice in one solid: a wall inside it, without an outer side.
            if (std::count(face.solids.begin(), face.solids.end(), solid) != 1) {
                continue;
            }
            for (std::size_t i = 0; i < face.corners.size(); i += 3) {
                triangles.push_back(
                    {number_.at(face.corners[i]), number_.at(face.corners[i + 1]), number_.at(face.corners[i + 2])});
                tags.push_back(tag);
            }
        }
        const std::vector<std::size_t> open = orient_shells(result_.surface.mesh.nodes, triangles);
        if (!open.empty()) {
            std::set<int> names;
            for (const std::size_t t : open) {
                names.insert(tags[t]);
            }
            fail_at("the triangles of solid " + std::to_string(solid) + " do not close", names);
        }
        for (std::size_t t = 0; t < triangles.size(); ++t) {
            const std::vector<int>& solids = faces_.at(tags[t]).solids;
            if (solids.size() == 1) {
                result_.surface.mesh.triangles.push_back(triangles[t]);
                result_.surface.face_tags.push_back(tags[t]);
            } else if (solids.front() == solid) {
                result_.inner_facets.push_back({triangles[t], tags[t]});
            }
        }
        collect_walls(solid);
    }

    void collect_walls(int solid) {
        for (const auto& [tag, face] : faces_) {
            if (std::count(face.solids.begin(), face.solids.end(), solid) < 2) {
                continue;
            }
            for (std::size_t i = 0; i < face.corners.size(); i += 3) {
                result_.inner_facets.push_back(
                    {{number_.at(face.corners[i]), number_.at(face.corners[i + 1]), number_.at(face.corners[i + 2])},
                     tag});
            }
        }
    }

    /// Curves that part different faces, and the vertices where they end.
    void collect_curves() {
        std::map<int, std::set<int>> faces_of;
        for (const auto& [tag, face] : faces_) {
            for (const int curve : boundary_of(2, tag)) {
                faces_of[curve].insert(tag);
            }
        }
        std::map<int, std::set<int>> curves_at;
        for (const auto& [curve, faces] : faces_of) {
            if (faces.size() < 2) {
                continue;
            }
            const auto own = raw_.curves.find(curve);
            const std::span<const std::size_t> nodes =
                own == raw_.curves.end() ? std::span<const std::size_t>() : own->second;
            for (std::size_t i = 0; i + 1 < nodes.size(); i += 2) {
                if (number_.contains(nodes[i]) && number_.contains(nodes[i + 1])) {
                    result_.surface.edges.push_back({{number_.at(nodes[i]), number_.at(nodes[i + 1])}, curve});
                }
            }
            for (const int vertex : boundary_of(1, curve)) {
                curves_at[vertex].insert(curve);
            }
        }
        for (const auto& [vertex, curves] : curves_at) {
            const auto own = raw_.vertices.find(vertex);
            if (curves.size() > 1 && own != raw_.vertices.end() && number_.contains(own->second)) {
                result_.surface.vertices.push_back({number_.at(own->second), vertex});
            }
        }
    }

    const RawSurface& raw_;
    std::span<const int> solids_;
    std::map<int, Face> faces_;
    std::unordered_map<std::size_t, Index> number_;
    CadTriangulation result_;
};

}  // namespace

std::vector<int> boundary_of(int dimension, int tag) {
    gmsh::vectorpair list;
    gmsh::model::getBoundary({{dimension, tag}}, list, false, false, false);
    std::vector<int> tags;
    for (const auto& entity : list) {
        tags.push_back(entity.second);
    }
    return tags;
}

std::vector<int> entities_of(int dimension) {
    gmsh::vectorpair list;
    gmsh::model::getEntities(list, dimension);
    std::vector<int> tags;
    for (const auto& entity : list) {
        tags.push_back(entity.second);
    }
    return tags;
}

CadTriangulation surface_of(const RawSurface& raw, std::span<const int> solids) { return Collector(raw, solids).run(); }

void fail_at(const std::string& message, const std::set<int>& faces) {
    std::string text = message;
    for (const int face : faces) {
        text += (face == *faces.begin() ? ": face " : ", ") + std::to_string(face);
    }
    throw Error(ErrorCode::cad_failure, text, Error::Ids(faces.begin(), faces.end()));
}

}  // namespace pavior::detail
