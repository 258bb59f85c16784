#include <pavior/cad/triangulation.hpp>

#include <pavior/cad/gmsh_brep.hpp>
#include <pavior/core/error.hpp>

#include "../common/child_process.hpp"
#include "gmsh_import.hpp"
#include "gmsh_model.hpp"
#include "gmsh_options.hpp"
#include "orient_shells.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <unordered_map>
#include <utility>

namespace pavior {

namespace {

constexpr int line_type = 1;
constexpr int triangle_type = 2;

gmsh::vectorpair entities(int dimension) {
    gmsh::vectorpair list;
    gmsh::model::getEntities(list, dimension);
    return list;
}

/// Tags of what bounds an entity, seams twice.
std::vector<int> boundary(int dimension, int tag) {
    gmsh::vectorpair list;
    gmsh::model::getBoundary({{dimension, tag}}, list, false, false, false);
    std::vector<int> tags;
    for (const auto& entity : list) {
        tags.push_back(entity.second);
    }
    return tags;
}

[[noreturn]] void fail(const std::string& message, const std::set<int>& faces = {}) {
    std::string text = message;
    for (const int face : faces) {
        text += (face == *faces.begin() ? ": face " : ", ") + std::to_string(face);
    }
    throw Error(ErrorCode::cad_failure, text, Error::Ids(faces.begin(), faces.end()));
}

void check_options(const TriangulationOptions& options) {
    const auto limit = [](double value) { return value >= 0.0 && std::isfinite(value); };
    if (!limit(options.size) || !limit(options.chord) || options.per_turn < 3 || options.per_turn > 10000) {
        throw InputError(ErrorCode::bad_option, "size and chord must be 0 or positive, per_turn between 3 and 10000");
    }
}

double model_diagonal() { return detail::bounding_box().extent().norm(); }

bool is_plane(int face) {
    std::string kind;
    gmsh::model::getType(2, face, kind);
    return kind == "Plane";
}

// ---- meshing ------------------------------------------------------------------------------------------------------

/// A way to ask Gmsh for triangles.
struct Recipe {
    int algorithm = 6;      ///< 5 Delaunay, 6 frontal
    double least = 0.02;    ///< length of an edge, at least, in parts of the chord
    bool curvature = true;  ///< sizes follow the curvature, else one size holds everywhere
};

void generate(const Recipe& recipe, double size, double least, int per_turn) {
    detail::GmshOptions options;
    detail::set_mesh_options(options, size, least, per_turn);
    gmsh::model::mesh::clear();
    for (const auto& face : entities(2)) {
        constexpr int initial_only = 3;
        gmsh::model::mesh::setAlgorithm(2, face.second,
                                        size > 0.0 || !is_plane(face.second) ? recipe.algorithm : initial_only);
    }
    gmsh::model::mesh::generate(2);
}

/// Elements of one type on an entity: node tags, so many an element.
std::vector<std::size_t> elements(int type, int tag) {
    std::vector<std::size_t> names;
    std::vector<std::size_t> nodes;
    gmsh::model::mesh::getElementsByType(type, names, nodes, tag);
    return nodes;
}

/// Coordinates by node tag.
std::map<std::size_t, Vec3> mesh_nodes() {
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

/// Largest distance of edge middles and triangle centres from the faces they belong to. Plane faces have none.
double largest_chord() {
    const std::map<std::size_t, Vec3> nodes = mesh_nodes();
    double worst = 0.0;
    for (const auto& face : entities(2)) {
        if (is_plane(face.second)) {
            continue;
        }
        std::vector<double> probes;
        const auto probe = [&](const Vec3& x) { probes.insert(probes.end(), x.data(), x.data() + 3); };
        const std::vector<std::size_t> corners = elements(triangle_type, face.second);
        for (std::size_t i = 0; i < corners.size(); i += 3) {
            const std::array<Vec3, 3> x{nodes.at(corners[i]), nodes.at(corners[i + 1]), nodes.at(corners[i + 2])};
            probe((x[0] + x[1] + x[2]) / 3.0);
            for (std::size_t k = 0; k < 3; ++k) {
                probe((x[k] + x[(k + 1) % 3]) / 2.0);
            }
        }
        std::vector<double> closest;
        std::vector<double> parameters;
        detail::on_entity(2, face.second,
                          [&] { gmsh::model::getClosestPoint(2, face.second, probes, closest, parameters); });
        for (std::size_t i = 0; i < std::min(probes.size(), closest.size()); i += 3) {
            worst = std::max(worst, std::hypot(probes[i] - closest[i], probes[i + 1] - closest[i + 1],
                                               probes[i + 2] - closest[i + 2]));
        }
    }
    return worst;
}

void check_meshed() {
    std::set<int> empty;
    for (const auto& face : entities(2)) {
        if (elements(triangle_type, face.second).empty()) {
            empty.insert(face.second);
        }
    }
    if (!empty.empty()) {
        fail("Gmsh could not triangulate it", empty);
    }
}

/// Meshes ever finer until the chord is met, which is returned.
double mesh_by(const Recipe& recipe, const TriangulationOptions& options) {
    const double wanted = options.chord > 0.0 ? options.chord : model_diagonal() / 200.0;
    // What is smaller than the chord by far need not be round: the tip of a cone would get triangles without end.
    const double edge = recipe.least * wanted;
    const double least = options.size > 0.0 ? std::min(edge, 0.1 * options.size) : edge;
    int per_turn = recipe.curvature ? options.per_turn : 0;
    double size = recipe.curvature ? options.size : 10.0 * wanted;
    if (!recipe.curvature && options.size > 0.0) {
        size = std::min(size, options.size);
    }
    double reached = 0.0;
    for (int attempt = 0; attempt < 10; ++attempt) {
        generate(recipe, size, least, per_turn);
        check_meshed();
        reached = largest_chord();
        if (reached <= wanted) {
            return reached;
        }
        const double factor = std::clamp(std::sqrt(reached / wanted), 1.2, 4.0);
        per_turn = static_cast<int>(std::min(1e4, std::ceil(factor * per_turn)));
        size = recipe.curvature ? size : size / factor;
    }
    fail("the distance of triangles from curved faces stays at " + std::to_string(reached) + ", above " +
         std::to_string(wanted));
}

/// Whether a face has a point where its parameters are degenerate: the tip of a cone, the pole of a sphere.
bool has_tip(int face) {
    const std::vector<int> curves = boundary(2, face);
    return std::any_of(curves.begin(), curves.end(), [](int curve) {
        std::array<double, 6> box{};
        gmsh::model::getBoundingBox(1, std::abs(curve), box[0], box[1], box[2], box[3], box[4], box[5]);
        return Vec3(box[3] - box[0], box[4] - box[1], box[5] - box[2]).norm() < 1e-6 * model_diagonal();
    });
}

/// mesh_by() the first recipe that works. At the tips of faces Gmsh may refine for ever: there each recipe is first
/// tried in a process with a limit of time, far above what it takes where it ends at all.
double mesh_model(const TriangulationOptions& options) {
    std::set<int> tips;
    bool cones = false;
    for (const auto& face : entities(2)) {
        if (!is_plane(face.second) && has_tip(face.second)) {
            std::string kind;
            gmsh::model::getType(2, face.second, kind);
            cones = cones || kind == "Cone";
            tips.insert(face.second);
        }
    }
    const Recipe usual;
    if (tips.empty()) {
        return mesh_by(usual, options);
    }
    const Recipe delaunay{5, 0.2, true}, even{5, 0.2, false}, even_frontal{6, 0.2, false};
    std::vector<Recipe> recipes{delaunay, even, even_frontal, usual};
    if (!cones) {
        std::rotate(recipes.begin(), recipes.end() - 1, recipes.end());
    }
    const double seconds = 6.0 + 0.2 * static_cast<double>(entities(2).size());
    for (const Recipe& recipe : recipes) {
        const auto trial = [&] {
            static_cast<void>(mesh_by(recipe, options));
            return std::string();
        };
        if (detail::run_in_child(trial, {.seconds = seconds}).end == detail::ChildAnswer::End::answered) {
            return mesh_by(recipe, options);
        }
    }
    fail("Gmsh finds no end to the triangles round the tip or pole", tips);
}

// ---- reading the mesh ---------------------------------------------------------------------------------------------

/// A face with its triangles, and the solids that it bounds.
struct Face {
    std::vector<std::size_t> corners;  ///< node tags, three a triangle
    std::vector<int> solids;
};

class Collector {
public:
    CadTriangulation run() {
        for (const auto& face : entities(2)) {
            faces_[face.second].corners = elements(triangle_type, face.second);
        }
        for (const auto& solid : entities(3)) {
            for (const int face : boundary(3, solid.second)) {
                faces_.at(face).solids.push_back(solid.second);
            }
        }
        collect_nodes();
        for (const auto& solid : entities(3)) {
            collect_solid(solid.second);
        }
        collect_curves();
        return std::move(result_);
    }

private:
    void collect_nodes() {
        std::set<std::size_t> used;
        for (const auto& [tag, face] : faces_) {
            if (!face.solids.empty()) {
                used.insert(face.corners.begin(), face.corners.end());
            }
        }
        const std::map<std::size_t, Vec3> nodes = mesh_nodes();
        for (const std::size_t tag : used) {
            number_.emplace(tag, static_cast<Index>(result_.surface.mesh.nodes.size()));
            result_.surface.mesh.nodes.push_back(nodes.at(tag));
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
        const std::vector<std::size_t> open = detail::orient_shells(result_.surface.mesh.nodes, triangles);
        if (!open.empty()) {
            std::set<int> names;
            for (const std::size_t t : open) {
                names.insert(tags[t]);
            }
            fail("the triangles of solid " + std::to_string(solid) + " do not close", names);
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
            for (const int curve : face.solids.empty() ? std::vector<int>() : boundary(2, tag)) {
                faces_of[curve].insert(tag);
            }
        }
        std::map<int, std::set<int>> curves_at;
        for (const auto& [curve, faces] : faces_of) {
            if (faces.size() < 2) {
                continue;
            }
            const std::vector<std::size_t> nodes = elements(line_type, curve);
            for (std::size_t i = 0; i + 1 < nodes.size(); i += 2) {
                if (number_.contains(nodes[i]) && number_.contains(nodes[i + 1])) {
                    result_.surface.edges.push_back({{number_.at(nodes[i]), number_.at(nodes[i + 1])}, curve});
                }
            }
            for (const int vertex : boundary(1, curve)) {
                curves_at[vertex].insert(curve);
            }
        }
        for (const auto& [vertex, curves] : curves_at) {
            std::vector<std::size_t> tags;
            std::vector<double> x;
            std::vector<double> parameters;
            gmsh::model::mesh::getNodes(tags, x, parameters, 0, vertex, false, false);
            if (curves.size() > 1 && tags.size() == 1 && number_.contains(tags[0])) {
                result_.surface.vertices.push_back({number_.at(tags[0]), vertex});
            }
        }
    }

    std::map<int, Face> faces_;
    std::unordered_map<std::size_t, Index> number_;
    CadTriangulation result_;
};

CadTriangulation collected(double chord) {
    CadTriangulation result = Collector().run();
    result.chord = chord;
    for (const auto& solid : entities(3)) {
        double volume = 0;
        gmsh::model::occ::getMass(3, solid.second, volume);
        result.volume += volume;
    }
    return result;
}

/// Tags of the file instead of Gmsh's own after the solids were intersected, and what there is to tell of these.
void tell_solids(const detail::GmshModel& model, const detail::SolidPieces& pieces,
                 const std::function<void()>& populate, CadTriangulation& result) {
    const detail::Topology topology = detail::read_topology(model);
    const auto tags = detail::file_tags(model, topology, pieces, populate, 1e-6 * topology.diagonal);
    result.imprint = detail::imprint_report(model, topology, pieces, 1e-4 * topology.diagonal);
    std::array<std::map<int, int>, 3> in_file;
    for (std::size_t i = 0; i < topology.vertices.size(); ++i) {
        in_file[0].emplace(topology.vertex_tags[i], tags[0][i].front());
    }
    for (std::size_t i = 0; i < topology.edges.size(); ++i) {
        in_file[1].emplace(topology.edges[i].tag, tags[1][i].front());
    }
    for (std::size_t i = 0; i < topology.faces.size(); ++i) {
        in_file[2].emplace(topology.faces[i].tag, tags[2][i].front());
    }
    const auto rename = [&](std::size_t dim, std::int32_t& tag) {
        const auto found = in_file[dim].find(tag);
        tag = found == in_file[dim].end() ? tag : found->second;
    };
    for (std::int32_t& tag : result.surface.face_tags) {
        rename(2, tag);
    }
    for (TaggedTriangle& triangle : result.inner_facets) {
        rename(2, triangle.tag);
    }
    for (auto& [tag, name] : std::exchange(result.surface.face_names, {})) {
        std::int32_t in_the_file = tag;
        rename(2, in_the_file);
        result.surface.face_names.emplace(in_the_file, std::move(name));
    }
    for (TaggedEdge& edge : result.surface.edges) {
        rename(1, edge.tag);
    }
    for (TaggedNode& vertex : result.surface.vertices) {
        rename(0, vertex.tag);
    }
}

CadTriangulation read_and_mesh(const std::filesystem::path& file, const TriangulationOptions& options) {
    const detail::GmshSession session;
    return detail::with_gmsh(
        [&] {
            const detail::GmshModel model;
            const detail::GmshModel::Current current(model);
            const auto populate = [&] { detail::import_file(file); };
            populate();
            const bool several = entities(3).size() > 1;
            detail::SolidPieces pieces;
            const detail::EntityNames names =
                several ? detail::imprint_solids(model, populate, file, 0.0, &pieces) : detail::read_names(file);
            CadTriangulation result = collected(mesh_model(options));
            for (const auto& [entity, name] : names) {
                if (entity.first == 2) {
                    result.surface.face_names[entity.second] = name;
                }
            }
            if (several) {
                tell_solids(model, pieces, populate, result);
            }
            return result;
        },
        [&](const std::string& message) { throw Error(ErrorCode::cad_failure, file.string() + ": " + message); });
}

/// Errors that the child met come once more when the work is done here; what is left are crashes and endless loops.
void try_first(const std::filesystem::path& file, const TriangulationOptions& options) {
    const auto trial = [&] {
        try {
            static_cast<void>(read_and_mesh(file, options));
        } catch (const Error&) {  // what the caller is to see, with its code and ids
        }
    };
    detail::try_reading(file, trial, options.trial_seconds, options.stop);
}

}  // namespace

CadTriangulation triangulate_solids(const std::filesystem::path& file, const TriangulationOptions& options) {
    check_options(options);
    detail::check_cad_file(file);
    if (options.trial_seconds > 0.0) {
        try_first(file, options);
    }
    const detail::Hush hush;
    return read_and_mesh(file, options);
}

CadTriangulation triangulate_solids(const GmshBrep& model, const TriangulationOptions& options) {
    check_options(options);
    const detail::Hush hush;
    return detail::with_gmsh(
        [&] {
            const detail::GmshModel::Current current(model.gmsh_model());
            CadTriangulation result = collected(mesh_model(options));
            gmsh::model::mesh::clear();
            return result;
        },
        [&](const std::string& message) { throw Error(ErrorCode::cad_failure, message); });
}

TaggedSurface triangulate(const std::filesystem::path& file, const TriangulationOptions& options) {
    CadTriangulation made = triangulate_solids(file, options);
    if (!made.inner_facets.empty()) {
        std::set<int> faces;
        for (const TaggedTriangle& triangle : made.inner_facets) {
            faces.insert(triangle.tag);
        }
        fail("there are faces between solids", faces);
    }
    return std::move(made.surface);
}

}  // namespace pavior
