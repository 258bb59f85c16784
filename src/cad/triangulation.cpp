#include <pavior/cad/triangulation.hpp>

#include <pavior/cad/gmsh_brep.hpp>
#include <pavior/core/error.hpp>

#include "gmsh_import.hpp"
#include "gmsh_triangles.hpp"
#include "model_bytes.hpp"
#include "raw_surface.hpp"
#include "surface_triangles.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace pavior {

namespace {

void check_options(const TriangulationOptions& options) {
    const auto limit = [](double value) { return value >= 0.0 && std::isfinite(value); };
    if (!limit(options.size) || !limit(options.chord) || !limit(options.element_size) || options.per_turn < 3 ||
        options.per_turn > 10000 || !(options.longest > 0.0)) {
        throw InputError(ErrorCode::bad_option,
                         "size, chord and element_size must be 0 or positive, per_turn between 3 and 10000, longest "
                         "positive");
    }
}

double diagonal_of(std::span<const int> solids) {
    Box<> box;
    for (const int solid : solids) {
        box.add(detail::bounding_box(3, solid));
    }
    return box.extent().norm();
}

/// The options with the chord that they ask for at these solids of the current model.
TriangulationOptions with_chord(TriangulationOptions options, std::span<const int> solids) {
    const double diagonal = diagonal_of(solids);
    if (options.chord == 0.0) {
        options.chord = diagonal / 200;
    }
    if (options.element_size > 0.0) {
        options.chord = std::min(options.chord, std::max(0.05 * options.element_size, diagonal / 2000));
    }
    return options;
}

/// The faces of the solids with these tags, by position.
std::vector<std::size_t> faces_of(const detail::Topology& topology, std::span<const int> solids) {
    std::set<std::size_t> faces;
    for (const detail::SolidData& solid : topology.solids) {
        if (std::find(solids.begin(), solids.end(), solid.tag) != solids.end()) {
            for (const OrientedFace& f : solid.faces) {
                faces.insert(f.face.index());
            }
        }
    }
    return {faces.begin(), faces.end()};
}

/// Nodes by their numbers.
detail::RawSurface raw_surface(const detail::Topology& topology, const detail::SurfaceTriangles& made) {
    detail::RawSurface raw;
    raw.chord = made.chord;
    for (std::size_t i = 0; i < made.nodes.size(); ++i) {
        raw.nodes.emplace_hint(raw.nodes.end(), i, made.nodes[i]);
    }
    for (std::size_t f = 0; f < made.faces.size(); ++f) {
        for (const TriCorners& c : made.faces[f]) {
            auto& corners = raw.faces[topology.faces[f].tag];
            corners.insert(corners.end(), c.begin(), c.end());
        }
    }
    for (std::size_t e = 0; e < made.edges.size(); ++e) {
        auto& ends = raw.curves[topology.edges[e].tag];
        for (std::size_t i = 0; i + 1 < made.edges[e].size(); ++i) {
            ends.insert(ends.end(), {made.edges[e][i], made.edges[e][i + 1]});
        }
    }
    for (std::size_t v = 0; v < topology.vertex_tags.size(); ++v) {
        raw.vertices.emplace(topology.vertex_tags[v], v);
    }
    return raw;
}

/// Few triangles, between the nodes of edges; nothing where that does not work out.
std::optional<CadTriangulation> few_triangles(const detail::GmshModel& model, const detail::Topology& topology,
                                              std::span<const int> solids, const TriangulationOptions& options) {
    const std::vector<std::size_t> faces = faces_of(topology, solids);
    detail::SurfaceLimits limits{options.chord, options.per_turn, options.longest, diagonal_of(solids) / 100};
    constexpr int attempts = 4;
    for (int attempt = 0; attempt < attempts; ++attempt) {
        const auto made = detail::surface_triangles(model, topology, faces, limits);
        if (!made) {
            return std::nullopt;
        }
        if (made->chord <= options.chord) {
            try {
                return detail::surface_of(raw_surface(topology, *made), solids);
            } catch (const Error&) {  // triangles that use an edge twice
                limits.chord *= 0.5;
                limits.per_turn *= 2;
                continue;
            }
        }
        limits.chord *= std::max(0.1, 0.9 * options.chord / made->chord);
    }
    return std::nullopt;
}

bool has_curved_face() {
    const std::vector<int> faces = detail::entities_of(2);
    return std::any_of(faces.begin(), faces.end(), [](int face) {
        std::string kind;
        gmsh::model::getType(2, face, kind);
        return kind != "Plane";
    });
}

/// The solids of the current model with these tags. Without topology, or where a size is asked for, by Gmsh's mesher.
CadTriangulation triangulated(const detail::GmshModel& model, const detail::Topology* topology,
                              std::span<const int> solids, const TriangulationOptions& given) {
    const TriangulationOptions options = with_chord(given, solids);
    if (topology != nullptr && options.size == 0.0 && has_curved_face()) {
        if (auto few = few_triangles(model, *topology, solids, options)) {
            return std::move(*few);
        }
    }
    return detail::surface_of(detail::gmsh_triangles(options), solids);
}

/// Nothing for a model that can be triangulated, but whose edges do not close in parameter planes.
std::optional<detail::Topology> topology_of(const detail::GmshModel& model) {
    try {
        return detail::read_topology(model);
    } catch (const Error&) {
        return std::nullopt;
    }
}

/// Tags of the file instead of Gmsh's own after the solids were intersected, and what there is to tell of these.
void tell_solids(const detail::GmshModel& model, const detail::SolidPieces& pieces,
                 const std::function<void()>& populate, const detail::Topology& topology, CadTriangulation& result) {
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
            const bool several = detail::entities_of(3).size() > 1;
            detail::SolidPieces pieces;
            const detail::EntityNames names =
                several ? detail::imprint_solids(model, populate, file, 0.0, &pieces) : detail::read_names(file);
            std::optional<detail::Topology> topology;
            if (several) {
                topology = detail::read_topology(model);
            } else if (has_curved_face()) {
                topology = topology_of(model);
            }
            CadTriangulation result =
                triangulated(model, topology ? &*topology : nullptr, detail::entities_of(3), options);
            for (const auto& [entity, name] : names) {
                if (entity.first == 2) {
                    result.surface.face_names[entity.second] = name;
                }
            }
            if (several) {
                tell_solids(model, pieces, populate, *topology, result);
            }
            return result;
        },
        [&](const std::string& message) { throw Error(ErrorCode::cad_failure, file.string() + ": " + message); });
}

/// In a process that may crash or never come back. Nothing if that met an error of ours: it comes once more when the
/// work is done here, with its code and ids.
std::optional<CadTriangulation> read_and_mesh_in_child(const std::filesystem::path& file,
                                                       const TriangulationOptions& options) {
    const auto task = [&] {
        try {
            return detail::to_bytes(read_and_mesh(file, options));
        } catch (const Error&) {
            return std::string();
        }
    };
    const std::string bytes = detail::try_reading(file, task, options.trial_seconds, options.stop);
    return bytes.empty() ? std::nullopt : std::optional(detail::triangulation_from_bytes(bytes));
}

}  // namespace

CadTriangulation triangulate_solids(const std::filesystem::path& file, const TriangulationOptions& options) {
    check_options(options);
    detail::check_cad_file(file);
    if (options.trial_seconds > 0.0) {
        if (auto made = read_and_mesh_in_child(file, options)) {
            return std::move(*made);
        }
    }
    const detail::Hush hush;
    return read_and_mesh(file, options);
}

namespace {

CadTriangulation triangulate_tags(const GmshBrep& model, std::span<const int> solids,
                                  const TriangulationOptions& options) {
    check_options(options);
    const detail::Hush hush;
    return detail::with_gmsh(
        [&] {
            const detail::GmshModel::Current current(model.gmsh_model());
            return triangulated(model.gmsh_model(), &model.topology(), solids, options);
        },
        [&](const std::string& message) { throw Error(ErrorCode::cad_failure, message); });
}

}  // namespace

CadTriangulation triangulate_solids(const GmshBrep& model, const TriangulationOptions& options) {
    std::vector<int> solids;
    for (std::size_t s = 0; s < model.solid_count(); ++s) {
        solids.push_back(model.gmsh_tag(3, s));
    }
    return triangulate_tags(model, solids, options);
}

CadTriangulation triangulate_solid(const GmshBrep& model, SolidId solid, const TriangulationOptions& options) {
    const int tag = model.gmsh_tag(3, solid.index());
    return triangulate_tags(model, std::span(&tag, 1), options);
}

TaggedSurface triangulate(const std::filesystem::path& file, const TriangulationOptions& options) {
    CadTriangulation made = triangulate_solids(file, options);
    if (!made.inner_facets.empty()) {
        std::set<int> faces;
        for (const TaggedTriangle& triangle : made.inner_facets) {
            faces.insert(triangle.tag);
        }
        detail::fail_at("there are faces between solids", faces);
    }
    return std::move(made.surface);
}

}  // namespace pavior
