#pragma once

#include <pavior/core/error.hpp>
#include <pavior/core/stop.hpp>
#include <pavior/mesh/edge_table.hpp>
#include <pavior/mesh/mesh_check.hpp>
#include <pavior/mesh/outward_quads.hpp>
#include <pavior/part/detail/hex_jacobian.hpp>
#include <pavior/part/entity_guide.hpp>
#include <pavior/part/pillow_solids.hpp>
#include <pavior/part/settle_nodes.hpp>
#include <pavior/smooth/improve_hexes.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <set>
#include <utility>

namespace pavior {

namespace detail {

/// The quads round some hexahedra, and at which angles they meet inside.
class PillowSkin {
public:
    /// \param inside  a flag a hexahedron; empty: all
    PillowSkin(const SolidsMesh& mesh, std::span<const char> inside, double angle) : mesh_(mesh), angle_(angle) {
        const auto faces = faces_under_quads(mesh.mesh, mesh.quads);
        const auto taken = [&](const HexFace& f) {
            return f.hex != no_index && (inside.empty() || inside[f.hex] != 0);
        };
        std::vector<QuadCorners> corners;
        for (std::size_t q = 0; q < mesh.quads.size(); ++q) {
            if (taken(faces[q][0]) != taken(faces[q][1])) {
                const HexFace& own = faces[q][taken(faces[q][0]) ? 0 : 1];
                quads_.push_back(q);
                hexes_.push_back(own.hex);
                corners.push_back(hex_face(mesh.mesh.hexes[own.hex], own.face));
            }
        }
        const EdgeTable edges(mesh.mesh.nodes.size(), corners.size(), [&](Index q) { return corners[q]; });
        edges.for_each([&](Index low, Index high, std::span<const EdgeTable::Use> uses) {
            if (uses.size() == 2) {
                meet(low, high, {uses[0].quad, uses[1].quad}, corners);
            }
        });
        std::sort(smooth_.begin(), smooth_.end());
        smooth_.erase(std::unique(smooth_.begin(), smooth_.end()), smooth_.end());
    }

    /// Faces with quads of one hexahedron that meet smoothly, where its scaled Jacobian is below \p enough.
    [[nodiscard]] std::set<FaceId> flat_faces(double enough) const {
        std::set<FaceId> result;
        for (const auto& [hex, f, g] : flat_) {
            if (scaled_jacobian(mesh_.mesh, hex) < enough) {
                result.insert({f, g});
            }
        }
        return result;
    }
    /// Adds the faces that hang together with those in the set, smoothly or at concave edges.
    void close(std::set<FaceId>& faces) const {
        std::vector<FaceId> open(faces.begin(), faces.end());
        while (!open.empty()) {
            const FaceId f = open.back();
            open.pop_back();
            for (auto at = std::lower_bound(smooth_.begin(), smooth_.end(), std::pair(f, FaceId{}));
                 at != smooth_.end() && at->first == f; ++at) {
                if (faces.insert(at->second).second) {
                    open.push_back(at->second);
                }
            }
        }
    }
    /// Adds the faces at some nodes. \return whether there are others than those in the set
    bool add_at(std::span<const Index> nodes, std::set<FaceId>& faces) const {
        const std::size_t before = faces.size();
        for (const std::size_t q : quads_) {
            for (const Index i : mesh_.quads[q]) {
                if (std::binary_search(nodes.begin(), nodes.end(), i)) {
                    faces.insert(mesh_.quad_face[q]);
                }
            }
        }
        return faces.size() > before;
    }
    [[nodiscard]] std::vector<std::size_t> quads_on(const std::set<FaceId>& faces) const {
        std::vector<std::size_t> result;
        for (const std::size_t q : quads_) {
            if (faces.contains(mesh_.quad_face[q])) {
                result.push_back(q);
            }
        }
        return result;
    }

private:
    void meet(Index low, Index high, std::array<Index, 2> pair, const std::vector<QuadCorners>& corners) {
        if (!runs_along(corners[pair[0]], low, high)) {
            std::swap(pair[0], pair[1]);
        }
        const Vec3& x = mesh_.mesh.nodes[low];
        const Vec3& y = mesh_.mesh.nodes[high];
        const Vec3 along = (y - x).normalized();
        std::array<double, 2> angles{};
        for (std::size_t end = 0; end < 2; ++end) {
            std::array<Vec3, 2> into;
            for (std::size_t k = 0; k < 2; ++k) {
                const QuadCorners& c = corners[pair[k]];
                const Index here = end == 0 ? low : high, there = end == 0 ? high : low;
                const auto at = static_cast<std::size_t>(std::find(c.begin(), c.end(), here) - c.begin());
                const Index next = c[(at + 1) % 4] == there ? c[(at + 3) % 4] : c[(at + 1) % 4];
                const Vec3 edge = mesh_.mesh.nodes[next] - mesh_.mesh.nodes[here];
                into[k] = (edge - edge.dot(along) * along).normalized();
            }
            const Vec3 material = into[0].cross(along);  // against the normal of the quad that runs along
            const double turn = std::atan2(into[1].dot(material), into[1].dot(into[0])) * 180.0 / std::numbers::pi;
            angles[end] = turn < 0 ? turn + 360 : turn;
        }
        const FaceId f = mesh_.quad_face[quads_[pair[0]]], g = mesh_.quad_face[quads_[pair[1]]];
        if ((angles[0] + angles[1]) / 2 > angle_) {
            smooth_.insert(smooth_.end(), {{f, g}, {g, f}});
        }
        if (hexes_[pair[0]] == hexes_[pair[1]] && std::max(angles[0], angles[1]) > angle_) {
            flat_.push_back({hexes_[pair[0]], f, g});
        }
    }

    struct Flat {
        Index hex;
        FaceId f, g;
    };
    const SolidsMesh& mesh_;
    double angle_;
    std::vector<std::size_t> quads_;
    std::vector<Index> hexes_;
    std::vector<std::pair<FaceId, FaceId>> smooth_;
    std::vector<Flat> flat_;
};

/// Places the nodes of a mesh on its model, where they may slide, and raises the least scaled Jacobian.
class SlidingImprover {
public:
    SlidingImprover(const AnyModel& b, const PillowSolidsOptions& options, SolidsMesh& mesh)
        : b_(b), options_(options), mesh_(mesh) {}

    /// \return the least scaled Jacobian
    double run() {
        SettleOptions own;
        own.size = options_.size;
        own.near_feature = own.near;
        own.execution = options_.execution;
        on_ = settle_nodes(b_, mesh_, own).of_node;
        double least = raise(false, 30, 2);
        constexpr int most_rings = 4;
        for (int slice = 0, rings = 2; slice < 7 && least < options_.enough && !late(); ++slice) {
            const double before = least;
            least = raise(true, 20, rings);
            if (!(least > before + 1e-3) && ++rings > most_rings) {
                break;
            }
        }
        return least;
    }

private:
    [[nodiscard]] bool late() const { return options_.out_of_time && options_.out_of_time(); }

    double raise(bool sliding, double effort, int rings) {
        ImproveOptions own;
        own.target = 0.5;
        own.sufficient = options_.enough;
        own.effort = effort;
        own.rings = rings;
        own.execution = options_.execution;
        std::vector<NodeEntity> on = on_;
        for (NodeEntity& entity : on) {
            entity = !sliding && entity.dimension < 3 ? held_node() : entity;
        }
        const EntityGuide guide(b_, std::move(on), 1e-8 * options_.size);
        return improve_hexes(std::span(mesh_.mesh.nodes), std::span<const HexCorners>(mesh_.mesh.hexes), guide, own)
            .min_det_after;
    }

    const AnyModel& b_;
    const PillowSolidsOptions& options_;
    SolidsMesh& mesh_;
    std::vector<NodeEntity> on_;
};

/// Where layers go.
enum class PillowSeeds : std::uint8_t {
    flat,   ///< under faces whose quads of one hexahedron meet smoothly
    worst,  ///< under faces at the worst hexahedra
};

/// Inserts layers.
class LayerInserter {
public:
    LayerInserter(const PillowSolidsOptions& options, double before, SolidsMesh& mesh)
        : options_(options), before_(before), mesh_(mesh) {}

    /// One layer through all solids. \return faces and fault, no faces without seeds
    PillowAttempt together(PillowSeeds seeds) {
        insert({}, seeds);
        return finish(attempt_.fault);
    }
    /// A layer in each solid that has seeds.
    PillowAttempt apart(PillowSeeds seeds) {
        bool any = false;
        for (const SolidId s : std::set<SolidId>(mesh_.hex_solid.begin(), mesh_.hex_solid.end())) {
            std::vector<char> inside(mesh_.hex_solid.size(), 0);
            for (std::size_t h = 0; h < inside.size(); ++h) {
                inside[h] = mesh_.hex_solid[h] == s ? 1 : 0;
            }
            any = insert(inside, seeds) || any;
        }
        return finish(any ? PillowFault::none : attempt_.fault);
    }

private:
    PillowAttempt finish(PillowFault fault) {
        attempt_.faces.assign(faces_.begin(), faces_.end());
        attempt_.fault = fault;
        return std::move(attempt_);
    }

    /// Faces where the layer begins.
    [[nodiscard]] std::set<FaceId> begin(const PillowSkin& skin, PillowSeeds seeds) const {
        if (seeds == PillowSeeds::flat) {
            return skin.flat_faces(options_.enough);
        }
        constexpr double above_worst = 0.1;
        const double limit = std::min(options_.enough, before_ + above_worst);
        std::vector<Index> nodes;
        for (std::size_t h = 0; h < mesh_.mesh.hexes.size(); ++h) {
            if (scaled_jacobian(mesh_.mesh, h) < limit) {
                nodes.insert(nodes.end(), mesh_.mesh.hexes[h].begin(), mesh_.mesh.hexes[h].end());
            }
        }
        std::sort(nodes.begin(), nodes.end());
        std::set<FaceId> faces;
        skin.add_at(nodes, faces);
        return faces;
    }

    /// A layer in some hexahedra, under more faces where it could not conform otherwise. \return whether there is one
    bool insert(std::span<const char> inside, PillowSeeds seeds) {
        const PillowSkin skin(mesh_, inside, options_.angle);
        std::set<FaceId> faces = begin(skin, seeds);
        if (faces.empty()) {
            return false;
        }
        HexMeshData data;
        data.mesh = mesh_.mesh;
        data.quads = mesh_.quads;
        for (const SolidId s : mesh_.hex_solid) {
            data.hex_groups.push_back(s.value);
        }
        for (const FaceId f : mesh_.quad_face) {
            data.quad_groups.push_back(f.value);
        }
        PillowOptions own;
        own.shrink = inside;
        PillowReport report;
        constexpr int most_rounds = 20;
        for (int round = 0; round < most_rounds; ++round) {
            skin.close(faces);
            report = pillow(data, skin.quads_on(faces), own);
            if (report.ok() || !skin.add_at(report.fault_nodes, faces)) {
                break;
            }
        }
        attempt_.fault = report.fault;
        faces_.insert(faces.begin(), faces.end());
        if (report.ok()) {
            for (const Index h : report.hex_from) {
                mesh_.hex_solid.push_back(mesh_.hex_solid[h]);
            }
            for (const std::size_t q : report.quad_from) {
                mesh_.quad_face.push_back(mesh_.quad_face[q]);
            }
            mesh_.mesh = std::move(data.mesh);
            mesh_.quads = std::move(data.quads);
        }
        return report.ok();
    }

    const PillowSolidsOptions& options_;
    double before_;
    SolidsMesh& mesh_;
    std::set<FaceId> faces_;
    PillowAttempt attempt_;
};

inline void check_pillow_options(const PillowSolidsOptions& options) {
    if (!(options.size > 0) || !(options.angle > 90 && options.angle < 180) ||
        !(options.enough > 0 && options.enough < 1)) {
        throw InputError(ErrorCode::bad_option,
                         "the size must be above 0, the angle between 90 and 180, what is enough between 0 and 1");
    }
}

}  // namespace detail

PAVIOR_INLINE PillowedSolids pillow_solids(const AnyModel& b, SolidsMesh& mesh, const PillowSolidsOptions& options) {
    detail::check_pillow_options(options);
    detail::check_mesh_entities(mesh.mesh.nodes, mesh.mesh.hexes, mesh.hex_solid, mesh.quads, mesh.quad_face,
                                b.solid_count(), b.face_count(), {});
    PillowedSolids result;
    result.before = result.after = detail::least_scaled_jacobian(mesh.mesh);
    const auto late = [&] { return options.out_of_time && options.out_of_time(); };
    if (result.before >= options.enough || late()) {
        return result;
    }
    SolidsMesh best = mesh;
    const auto take = [&](SolidsMesh& made, PillowAttempt attempt, double least_rise) {
        if (attempt.min_jacobian >= result.after + least_rise) {
            result.after = attempt.min_jacobian;
            result.taken = result.attempts.size();
            best = std::move(made);
        }
        result.attempts.push_back(std::move(attempt));
    };
    const auto insert = [&](bool apart, detail::PillowSeeds seeds) {
        constexpr double worth = 0.02;  // a rise by less is not worth a layer
        SolidsMesh made = mesh;
        detail::LayerInserter inserter(options, result.before, made);
        PillowAttempt attempt = apart ? inserter.apart(seeds) : inserter.together(seeds);
        attempt.apart = apart;
        const bool known = std::any_of(result.attempts.begin(), result.attempts.end(), [&](const PillowAttempt& a) {
            return a.faces == attempt.faces && a.apart == apart;
        });
        if (attempt.faces.empty() || known) {
            return;
        }
        if (attempt.fault == PillowFault::none) {
            const double least = detail::SlidingImprover(b, options, made).run();
            attempt.min_jacobian = check_mesh(made.mesh, options.execution).verify.ok() ? least : -1;
        }
        take(made, std::move(attempt), worth);
    };
    const auto enough = [&] {
        check_stop(options.execution.stop);
        return result.after >= options.enough || late();
    };
    const bool several =
        std::any_of(mesh.hex_solid.begin(), mesh.hex_solid.end(), [&](SolidId s) { return s != mesh.hex_solid[0]; });
    const auto layered = [&](detail::PillowSeeds seeds) {
        insert(false, seeds);
        if (several && !enough()) {
            insert(true, seeds);
        }
    };
    layered(detail::PillowSeeds::flat);
    if (!enough()) {
        SolidsMesh made = mesh;
        PillowAttempt attempt;
        attempt.min_jacobian = detail::SlidingImprover(b, options, made).run();
        take(made, std::move(attempt), 1e-3);
    }
    if (!enough()) {
        layered(detail::PillowSeeds::worst);
    }
    mesh = std::move(best);
    return result;
}

}  // namespace pavior
