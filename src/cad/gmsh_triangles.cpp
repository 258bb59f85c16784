#include "gmsh_triangles.hpp"

#include "../common/byte_arrays.hpp"
#include "../common/child_process.hpp"
#include "gmsh_mesh.hpp"
#include "gmsh_model.hpp"
#include "gmsh_options.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>

namespace pavior::detail {

namespace {

double model_diagonal() { return bounding_box().extent().norm(); }

bool is_plane(int face) {
    std::string kind;
    gmsh::model::getType(2, face, kind);
    return kind == "Plane";
}

/// A way to ask Gmsh for triangles.
struct Recipe {
    int algorithm = 6;      ///< 5 Delaunay, 6 frontal
    double least = 0.02;    ///< length of an edge, at least, in parts of the chord
    bool curvature = true;  ///< sizes follow the curvature, else one size holds everywhere
};

void generate(const Recipe& recipe, double size, double least, int per_turn) {
    GmshOptions options;
    set_mesh_options(options, size, least, per_turn);
    gmsh::model::mesh::clear();
    for (const int face : entities_of(2)) {
        constexpr int initial_only = 3;
        gmsh::model::mesh::setAlgorithm(2, face, size > 0.0 || !is_plane(face) ? recipe.algorithm : initial_only);
    }
    gmsh::model::mesh::generate(2);
}

/// Largest distance of edge middles and triangle centres from the faces they belong to. Plane faces have none.
double largest_chord() {
    const std::map<std::size_t, Vec3> nodes = mesh_nodes();
    double worst = 0.0;
    for (const int face : entities_of(2)) {
        if (is_plane(face)) {
            continue;
        }
        std::vector<double> probes;
        const auto probe = [&](const Vec3& x) { probes.insert(probes.end(), x.data(), x.data() + 3); };
        const std::vector<std::size_t> corners = elements(triangle_type, face);
        std::set<std::pair<std::size_t, std::size_t>> edges;
        for (std::size_t i = 0; i < corners.size(); i += 3) {
            const std::array<Vec3, 3> x{nodes.at(corners[i]), nodes.at(corners[i + 1]), nodes.at(corners[i + 2])};
            probe((x[0] + x[1] + x[2]) / 3.0);
            for (std::size_t k = 0; k < 3; ++k) {
                const std::size_t next = (k + 1) % 3;
                if (edges.insert(std::minmax(corners[i + k], corners[i + next])).second) {
                    probe((x[k] + x[next]) / 2.0);
                }
            }
        }
        std::vector<double> closest;
        std::vector<double> parameters;
        on_entity(2, face, [&] { gmsh::model::getClosestPoint(2, face, probes, closest, parameters); });
        for (std::size_t i = 0; i < std::min(probes.size(), closest.size()); i += 3) {
            worst = std::max(worst, std::hypot(probes[i] - closest[i], probes[i + 1] - closest[i + 1],
                                               probes[i + 2] - closest[i + 2]));
        }
    }
    return worst;
}

void check_meshed() {
    std::set<int> empty;
    for (const int face : entities_of(2)) {
        if (elements(triangle_type, face).empty()) {
            empty.insert(face);
        }
    }
    if (!empty.empty()) {
        fail_at("Gmsh could not triangulate it", empty);
    }
}

/// Meshes ever finer until the chord is met, which is returned.
double mesh_by(const Recipe& recipe, const TriangulationOptions& options) {
    const double wanted = wanted_chord(options);
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
    fail_at("the distance of triangles from curved faces stays at " + std::to_string(reached) + ", above " +
            std::to_string(wanted));
}

/// Whether a face has a point where its parameters are degenerate: the tip of a cone, the pole of a sphere.
bool has_tip(int face) {
    const std::vector<int> curves = boundary_of(2, face);
    return std::any_of(curves.begin(), curves.end(), [](int curve) {
        std::array<double, 6> box{};
        gmsh::model::getBoundingBox(1, std::abs(curve), box[0], box[1], box[2], box[3], box[4], box[5]);
        return Vec3(box[3] - box[0], box[4] - box[1], box[5] - box[2]).norm() < 1e-6 * model_diagonal();
    });
}

/// The mesh that Gmsh holds.
RawSurface gmsh_mesh(double chord) {
    RawSurface raw;
    raw.chord = chord;
    raw.nodes = mesh_nodes();
    for (const int face : entities_of(2)) {
        raw.faces[face] = elements(triangle_type, face);
    }
    for (const int curve : entities_of(1)) {
        raw.curves[curve] = elements(line_type, curve);
    }
    for (const int vertex : entities_of(0)) {
        if (const auto node = vertex_node(vertex)) {
            raw.vertices[vertex] = *node;
        }
    }
    gmsh::model::mesh::clear();
    return raw;
}

void add_lists(const std::map<int, std::vector<std::size_t>>& lists, ByteWriter& writer) {
    std::vector<int> tags;
    for (const auto& [tag, list] : lists) {
        tags.push_back(tag);
    }
    writer.add(tags);
    for (const auto& [tag, list] : lists) {
        writer.add(list);
    }
}

std::map<int, std::vector<std::size_t>> get_lists(ByteReader& reader) {
    std::vector<int> tags;
    reader.get(tags);
    std::map<int, std::vector<std::size_t>> lists;
    for (const int tag : tags) {
        reader.get(lists[tag]);
    }
    return lists;
}

std::string to_bytes(const RawSurface& raw) {
    std::vector<std::size_t> names;
    std::vector<Vec3> points;
    for (const auto& [name, x] : raw.nodes) {
        names.push_back(name);
        points.push_back(x);
    }
    std::vector<std::array<std::size_t, 2>> vertices;
    for (const auto& [tag, name] : raw.vertices) {
        vertices.push_back({static_cast<std::size_t>(tag), name});
    }
    ByteWriter writer;
    writer.add(names);
    writer.add(points);
    writer.add(vertices);
    writer.add(std::array{raw.chord});
    add_lists(raw.faces, writer);
    add_lists(raw.curves, writer);
    return writer.take();
}

RawSurface raw_surface(const std::string& bytes) {
    ByteReader reader(bytes);
    std::vector<std::size_t> names;
    std::vector<Vec3> points;
    std::vector<std::array<std::size_t, 2>> vertices;
    std::vector<double> chord;
    reader.get(names);
    reader.get(points);
    reader.get(vertices);
    reader.get(chord);
    RawSurface raw;
    for (std::size_t i = 0; i < names.size(); ++i) {
        raw.nodes.emplace(names[i], points[i]);
    }
    for (const auto& [tag, name] : vertices) {
        raw.vertices.emplace(static_cast<int>(tag), name);
    }
    raw.chord = chord.at(0);
    raw.faces = get_lists(reader);
    raw.curves = get_lists(reader);
    return raw;
}

}  // namespace

double wanted_chord(const TriangulationOptions& options) {
    return options.chord > 0.0 ? options.chord : model_diagonal() / 200.0;
}

/// By the first recipe that works. At the tips of faces Gmsh may refine for ever: there the work is done in a process
/// with a limit of time, far above what it takes where it ends at all.
RawSurface gmsh_triangles(const TriangulationOptions& options) {
    std::set<int> tips;
    bool cones = false;
    for (const int face : entities_of(2)) {
        if (!is_plane(face) && has_tip(face)) {
            std::string kind;
            gmsh::model::getType(2, face, kind);
            cones = cones || kind == "Cone";
            tips.insert(face);
        }
    }
    const Recipe usual;
    if (tips.empty()) {
        return gmsh_mesh(mesh_by(usual, options));
    }
    const Recipe delaunay{5, 0.2, true}, even{5, 0.2, false}, even_frontal{6, 0.2, false};
    std::vector<Recipe> recipes{delaunay, even, even_frontal, usual};
    if (!cones) {
        std::rotate(recipes.begin(), recipes.end() - 1, recipes.end());
    }
    const double seconds = 6.0 + 0.2 * static_cast<double>(entities_of(2).size());
    for (const Recipe& recipe : recipes) {
        const auto task = [&] { return to_bytes(gmsh_mesh(mesh_by(recipe, options))); };
        const ChildAnswer answer = run_in_child(task, {.seconds = seconds});
        if (answer.end == ChildAnswer::End::answered) {
            return raw_surface(answer.bytes);
        }
    }
    fail_at("Gmsh finds no end to the triangles round the tip or pole", tips);
}

}  // namespace pavior::detail
