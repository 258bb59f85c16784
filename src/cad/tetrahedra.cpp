#include <pavior/cad/tetrahedra.hpp>

#include <pavior/core/error.hpp>
#include <pavior/core/stop.hpp>
#include <pavior/mesh/cells.hpp>

#include "../common/byte_arrays.hpp"
#include "../common/child_process.hpp"
#include "gmsh_mesh.hpp"
#include "gmsh_model.hpp"
#include "gmsh_options.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <unordered_map>
#include <utility>

namespace pavior {

namespace {

void check_sizes(const TetSizes& sizes) {
    const auto positive = [](double value) { return value > 0 && std::isfinite(value); };
    const auto all_positive = [&](const auto& lengths) {
        return std::all_of(lengths.begin(), lengths.end(), [&](const auto& entry) { return positive(entry.second); });
    };
    const bool near = std::all_of(sizes.near.begin(), sizes.near.end(),
                                  [&](const TetSizeAt& at) { return positive(at.size) && at.point.allFinite(); });
    if (!near || !(sizes.growth >= 0) || !positive(sizes.size) || !positive(sizes.least) || sizes.per_turn < 3 ||
        sizes.variant < 0 || !all_positive(sizes.edge) || !all_positive(sizes.face) || !all_positive(sizes.solid) ||
        !(sizes.seconds >= 0)) {
        throw InputError(ErrorCode::bad_option,
                         "lengths must be positive, 3 edges or more a turn, no negative variant");
    }
}

/// What of the model bounds the solids.
struct Scope {
    std::vector<FaceId> faces;               ///< ascending
    std::vector<EdgeId> edges;               ///< between different faces, ascending
    std::vector<EdgeId> all_edges;           ///< seams, too
    std::vector<VertexId> vertices;          ///< ascending
    std::map<FaceId, double> face_size;      ///< of those that have one of their own or by their solids
    std::map<EdgeId, double> edge_size;      ///< likewise
    std::map<VertexId, double> vertex_size;  ///< least of the edges
};

double least_of(const std::map<FaceId, double>& sizes, const std::set<FaceId>& faces, double other) {
    double least = std::numeric_limits<double>::infinity();
    for (const FaceId f : faces) {
        const auto own = sizes.find(f);
        least = std::min(least, own == sizes.end() ? other : own->second);
    }
    return least;
}

Scope scope_of(const GmshBrep& model, std::span<const SolidId> solids, const TetSizes& sizes) {
    Scope scope;
    std::set<FaceId> faces;
    std::set<VertexId> vertices;
    std::map<EdgeId, std::set<FaceId>> edge_faces;
    std::map<FaceId, double> by_solid;
    for (const SolidId solid : solids) {
        if (!solid.valid() || solid.index() >= model.solid_count()) {
            throw InputError(ErrorCode::bad_index, "solid " + std::to_string(solid.value) + " does not exist",
                             {solid.value});
        }
        const auto own = sizes.solid.find(solid);
        const double size = own == sizes.solid.end() ? sizes.size : own->second;
        for (const OrientedFace& f : model.solid_faces(solid)) {
            faces.insert(f.face);
            const auto [at, first] = by_solid.emplace(f.face, size);
            at->second = std::min(at->second, size);
            for (const EdgeLoop& loop : model.face_loops(f.face)) {
                for (const OrientedEdge& use : loop) {
                    edge_faces[use.edge].insert(f.face);
                }
            }
        }
    }
    for (const FaceId f : faces) {
        const auto own = sizes.face.find(f);
        scope.face_size[f] = own == sizes.face.end() ? by_solid.at(f) : own->second;
    }
    scope.faces.assign(faces.begin(), faces.end());
    for (const auto& [edge, around] : edge_faces) {
        scope.all_edges.push_back(edge);
        if (around.size() > 1) {
            scope.edges.push_back(edge);
        }
        std::map<FaceId, double> given;
        for (const FaceId f : around) {
            if (const auto own = sizes.face.find(f); own != sizes.face.end()) {
                given.insert(*own);
            }
        }
        const auto own = sizes.edge.find(edge);
        double size = least_of(by_solid, around, sizes.size);
        if (!given.empty()) {
            size = std::numeric_limits<double>::infinity();
            for (const auto& [f, length] : given) {
                size = std::min(size, length);
            }
        }
        size = own == sizes.edge.end() ? size : own->second;
        scope.edge_size[edge] = size;
        for (const VertexId v : model.edge_vertices(edge)) {
            vertices.insert(v);
            const auto [at, first] = scope.vertex_size.emplace(v, size);
            at->second = std::min(at->second, size);
        }
    }
    scope.vertices.assign(vertices.begin(), vertices.end());
    return scope;
}

/// Sizes by entity while it lives; Gmsh takes the least of this and what curvature asks for.
class SizeCallback {
public:
    SizeCallback(const GmshBrep& model, const Scope& scope, const TetSizes& sizes) {
        if (sizes.edge.empty() && sizes.face.empty() && sizes.solid.empty() && sizes.near.empty()) {
            return;
        }
        std::array<std::map<int, double>, 4> by_tag;
        const auto fill = [&](std::size_t dimension, const auto& lengths) {
            for (const auto& [id, length] : lengths) {
                by_tag[dimension][model.gmsh_tag(static_cast<int>(dimension), id.index())] = length;
            }
        };
        fill(0, scope.vertex_size);
        fill(1, scope.edge_size);
        fill(2, scope.face_size);
        fill(3, sizes.solid);
        gmsh::model::mesh::setSizeCallback([by_tag, sizes](int dimension, int tag, double x, double y, double z) {
            double size = sizes.size;
            if (dimension >= 0 && dimension <= 3) {
                const auto& lengths = by_tag[static_cast<std::size_t>(dimension)];
                const auto own = lengths.find(tag);
                size = own == lengths.end() ? size : own->second;
            }
            for (const TetSizeAt& at : sizes.near) {
                size = std::min(size, at.size + sizes.growth * (at.point - Vec3(x, y, z)).norm());
            }
            return size;
        });
        set_ = true;
    }
    SizeCallback(const SizeCallback&) = delete;
    SizeCallback& operator=(const SizeCallback&) = delete;
    ~SizeCallback() {
        if (set_) {
            try {
                gmsh::model::mesh::removeSizeCallback();
            } catch (...) {  // it was set
            }
        }
    }

private:
    bool set_ = false;
};

double largest_size(const TetSizes& sizes) {
    double largest = sizes.size;
    const auto look = [&](const auto& lengths) {
        for (const auto& [id, length] : lengths) {
            largest = std::max(largest, length);
        }
    };
    look(sizes.edge);
    look(sizes.face);
    look(sizes.solid);
    return largest;
}

void generate(const GmshBrep& model, std::span<const SolidId> solids, const Scope& scope, const TetSizes& sizes) {
    detail::GmshOptions options;
    detail::set_mesh_options(options, largest_size(sizes), std::min(sizes.least, sizes.size), sizes.per_turn);
    options.set("Mesh.MeshOnlyVisible", 1);
    constexpr std::array<int, 3> algorithms{6, 5, 1};  // frontal, Delaunay, adaptive
    options.set("Mesh.Algorithm", algorithms[static_cast<std::size_t>(sizes.variant) % algorithms.size()]);
    options.set("Mesh.Algorithm3D", 1);
    options.set("Mesh.Optimize", 1);
    options.set("Mesh.OptimizeNetgen", 0);
    gmsh::vectorpair all;
    gmsh::model::getEntities(all);
    gmsh::model::setVisibility(all, 0);
    gmsh::vectorpair wanted;
    for (const SolidId solid : solids) {
        wanted.emplace_back(3, model.gmsh_tag(3, solid.index()));
    }
    gmsh::model::setVisibility(wanted, 1, true);
    const SizeCallback callback(model, scope, sizes);
    gmsh::model::mesh::clear();
    gmsh::model::mesh::generate(3);
}

/// Reads the mesh of the current model.
class Collector {
public:
    Collector(const GmshBrep& model, std::span<const SolidId> solids, const Scope& scope)
        : model_(model), solids_(solids), scope_(scope) {}

    SolidsTets run() {
        collect_tets();
        collect_triangles();
        for (const EdgeId e : scope_.edges) {
            const std::vector<std::size_t> nodes = detail::elements(detail::line_type, model_.gmsh_tag(1, e.index()));
            for (std::size_t i = 0; i + 1 < nodes.size(); i += 2) {
                result_.tets.edges.push_back({{number(nodes[i]), number(nodes[i + 1])}, e.value});
            }
        }
        for (const VertexId v : scope_.vertices) {
            const auto node = detail::vertex_node(model_.gmsh_tag(0, v.index()));
            if (node && number_.contains(*node)) {
                result_.tets.vertices.push_back({number_.at(*node), v.value});
            }
        }
        return std::move(result_);
    }

private:
    [[noreturn]] static void fail(const std::string& what) { throw Error(ErrorCode::cad_failure, what); }

    [[nodiscard]] Index number(std::size_t tag) const {
        const auto at = number_.find(tag);
        if (at == number_.end()) {
            fail("a node of the boundary is in no tetrahedron");
        }
        return at->second;
    }

    void collect_tets() {
        std::vector<std::size_t> corners;
        for (const SolidId solid : solids_) {
            const int tag = model_.gmsh_tag(3, solid.index());
            const std::vector<std::size_t> own = detail::elements(detail::tet_type, tag);
            if (own.empty()) {
                fail("Gmsh made no tetrahedra in solid " + std::to_string(model_.tag(3, solid.index())));
            }
            corners.insert(corners.end(), own.begin(), own.end());
            result_.tet_solid.insert(result_.tet_solid.end(), own.size() / 4, solid);
        }
        const std::map<std::size_t, Vec3> points = detail::mesh_nodes();
        for (const std::size_t tag : std::set<std::size_t>(corners.begin(), corners.end())) {
            number_.emplace(tag, static_cast<Index>(result_.tets.mesh.nodes.size()));
            result_.tets.mesh.nodes.push_back(points.at(tag));
        }
        for (std::size_t i = 0; i < corners.size(); i += 4) {
            TetCorners c{number(corners[i]), number(corners[i + 1]), number(corners[i + 2]), number(corners[i + 3])};
            const auto& at = result_.tets.mesh.nodes;
            const double volume = (at[c[1]] - at[c[0]]).cross(at[c[2]] - at[c[0]]).dot(at[c[3]] - at[c[0]]);
            if (volume < 0) {
                std::swap(c[2], c[3]);
            }
            if (!(std::abs(volume) > 0)) {
                fail("Gmsh made a tetrahedron without volume");
            }
            result_.tets.mesh.tets.push_back(c);
        }
    }

    static TriCorners sorted(TriCorners c) {
        std::sort(c.begin(), c.end());
        return c;
    }

    /// Those of faces, turned outwards, in the order of the faces. Every other side of a tetrahedron must have another
    /// tetrahedron behind it.
    void collect_triangles() {
        std::vector<std::pair<TriCorners, std::size_t>> by_nodes;
        auto& triangles = result_.tets.triangles;
        for (const FaceId f : scope_.faces) {
            const std::vector<std::size_t> corners =
                detail::elements(detail::triangle_type, model_.gmsh_tag(2, f.index()));
            for (std::size_t i = 0; i + 2 < corners.size(); i += 3) {
                const TriCorners c{number(corners[i]), number(corners[i + 1]), number(corners[i + 2])};
                by_nodes.emplace_back(sorted(c), triangles.size());
                triangles.push_back({c, f.value});
            }
        }
        std::sort(by_nodes.begin(), by_nodes.end());
        std::vector<char> turned(triangles.size(), 0);
        std::vector<TriCorners> inner;
        for (const TetCorners& tet : result_.tets.mesh.tets) {
            for (const auto& local : tet_faces) {
                TriCorners c;
                for (std::size_t k = 0; k < 3; ++k) {
                    c[k] = tet[static_cast<std::size_t>(local[k])];
                }
                const TriCorners key = sorted(c);
                const auto found = std::lower_bound(by_nodes.begin(), by_nodes.end(), std::pair(key, std::size_t{0}));
                if (found == by_nodes.end() || found->first != key) {
                    inner.push_back(key);
                } else if (std::exchange(turned[found->second], 1) == 0) {
                    triangles[found->second].nodes = c;
                }
            }
        }
        std::sort(inner.begin(), inner.end());
        bool paired = inner.size() % 2 == 0;
        for (std::size_t i = 0; i + 1 < inner.size() && paired; i += 2) {
            paired = inner[i] == inner[i + 1] && (i + 2 == inner.size() || inner[i + 2] != inner[i]);
        }
        if (!paired || std::count(turned.begin(), turned.end(), 0) > 0) {
            fail("Gmsh's tetrahedra do not end at the faces");
        }
    }

    const GmshBrep& model_;
    std::span<const SolidId> solids_;
    const Scope& scope_;
    std::unordered_map<std::size_t, Index> number_;
    SolidsTets result_;
};

/// Calls visit(array) for each array.
template <class Tets, class Visit>
void for_arrays(Tets& made, Visit&& visit) {
    visit(made.tets.mesh.nodes);
    visit(made.tets.mesh.tets);
    visit(made.tets.triangles);
    visit(made.tets.edges);
    visit(made.tets.vertices);
    visit(made.tet_solid);
}

std::string to_bytes(const SolidsTets& made) {
    detail::ByteWriter writer;
    for_arrays(made, [&](const auto& array) { writer.add(array); });
    return writer.take();
}

SolidsTets from_bytes(const std::string& bytes) {
    detail::ByteReader reader(bytes);
    SolidsTets made;
    for_arrays(made, [&](auto& array) { reader.get(array); });
    return made;
}

}  // namespace

SolidsTets tetrahedra_of(const GmshBrep& model, std::span<const SolidId> solids, const TetSizes& sizes) {
    check_sizes(sizes);
    const Scope scope = scope_of(model, solids, sizes);
    const auto make = [&] {
        return detail::with_gmsh(
            [&] {
                const detail::GmshModel::Current current(model.gmsh_model());
                generate(model, solids, scope, sizes);
                return to_bytes(Collector(model, solids, scope).run());
            },
            [](const std::string& message) { throw Error(ErrorCode::cad_failure, "Gmsh: " + message); });
    };
    using End = detail::ChildAnswer::End;
    const detail::ChildAnswer answer = detail::run_in_child(make, {.seconds = sizes.seconds, .stop = sizes.stop});
    switch (answer.end) {
        case End::answered: return from_bytes(answer.bytes);
        case End::stopped: throw Stopped();
        case End::timed_out: throw Error(ErrorCode::cad_failure, "Gmsh made no tetrahedra in time");
        default: break;
    }
    throw Error(ErrorCode::cad_failure, answer.end == End::threw ? answer.reason : "Gmsh " + answer.reason);
}

}  // namespace pavior
