#include "mesh_methods.hpp"
#include "swept.hpp"

#include <pavior/mesh/boundary_quads.hpp>
#include <pavior/mesh/quality.hpp>
#include <pavior/mesh/span_mesh.hpp>
#include <pavior/smooth/improve_hexes.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <cstddef>
#include <map>
#include <optional>
#include <sstream>
#include <vector>

namespace pavior::cli {

namespace {

/// The node_guide of a mesh on plane faces: nodes inside a face slide in its plane, those on an edge between two slide
/// along it; those on vertices and curved faces are fixed.
class PlaneGuide {
public:
    PlaneGuide(const GmshBrep& model, const HexMeshData& data) : holds_(data.mesh.nodes.size()) {
        collect(data);
        std::map<int, std::optional<Plane>> planes;
        for (std::size_t f = 0; f < model.face_count(); ++f) {
            planes[model.tag(2, f)] = plane_of(model, FaceId{static_cast<std::int32_t>(f)});
        }
        for (Hold& hold : holds_) {
            settle(planes, hold);
        }
        fix_vertices(model, data);
    }

    [[nodiscard]] Freedom freedom(Index i) const { return holds_[i].freedom; }
    [[nodiscard]] Vec3 project(Index i, const Vec3& x) const {
        const Hold& hold = holds_[i];
        const Vec3 off = x - hold.point;
        const double along = off.dot(hold.direction);
        return hold.freedom == Freedom::curve ? Vec3(hold.point + along * hold.direction)
                                              : Vec3(x - along * hold.direction);
    }
    [[nodiscard]] Vec3 direction(Index i, const Vec3&) const { return holds_[i].direction; }
    [[nodiscard]] static bool concurrent() { return true; }

private:
    struct Hold {
        Freedom freedom = Freedom::space;
        Vec3 point = Vec3::Zero(), direction = Vec3::Zero();  ///< tangent of a line, normal of a plane; unit
        std::vector<int> faces;
    };

    /// The faces of each node; what lies on the boundary but on no face is fixed.
    void collect(const HexMeshData& data) {
        for (std::size_t q = 0; q < data.quads.size(); ++q) {
            for (const Index i : data.quads[q]) {
                std::vector<int>& faces = holds_[i].faces;
                if (std::find(faces.begin(), faces.end(), data.quad_groups[q]) == faces.end()) {
                    faces.push_back(data.quad_groups[q]);
                }
                holds_[i].point = data.mesh.nodes[i];
            }
        }
        for (const QuadCorners& quad : boundary_quads(data.mesh)) {
            for (const Index i : quad) {
                holds_[i].freedom = holds_[i].faces.empty() ? Freedom::fixed : holds_[i].freedom;
            }
        }
    }

    static void settle(const std::map<int, std::optional<Plane>>& planes, Hold& hold) {
        constexpr double parallel = 0.05;  // sine of the angle between two planes
        if (hold.faces.empty()) {
            return;
        }
        hold.freedom = Freedom::fixed;
        std::vector<Plane> own;
        for (const int face : hold.faces) {
            if (const auto at = planes.find(face); at != planes.end() && at->second) {
                own.push_back(*at->second);
            }
        }
        if (own.size() != hold.faces.size() || own.size() > 2) {
            return;
        }
        if (own.size() == 1) {
            hold.freedom = Freedom::surface;
            hold.direction = own[0].normal;
        } else if (const Vec3 along = own[0].normal.cross(own[1].normal); along.norm() > parallel) {
            hold.freedom = Freedom::curve;
            hold.direction = along.normalized();
        }
    }

    void fix_vertices(const GmshBrep& model, const HexMeshData& data) {
        const double near = 1e-7 * model.diagonal();
        for (std::size_t v = 0; v < model.vertex_count(); ++v) {
            const Vec3 x = model.vertex_point(VertexId{static_cast<std::int32_t>(v)});
            for (std::size_t i = 0; i < holds_.size(); ++i) {
                if (holds_[i].freedom == Freedom::curve && (data.mesh.nodes[i] - x).norm() <= near) {
                    holds_[i].freedom = Freedom::fixed;
                }
            }
        }
    }

    std::vector<Hold> holds_;
};

}  // namespace

std::optional<Plane> plane_of(const GmshBrep& model, FaceId face) {
    if (model.face_kind(face) != "Plane") {
        return std::nullopt;
    }
    const Vec2 uv = model.face_interior(face);
    const auto [du, dv] = model.face_derivatives(face, uv);
    return Plane{model.face_point(face, uv), du.cross(dv).normalized()};
}

void improve_poor_mesh(const GmshBrep& model, const MeshCommand& command, MethodTry& result) {
    constexpr double enough = 0.3;
    const Execution execution{command.threads};
    const double before = hex_quality(result.data.mesh, {10, execution}).scaled_jacobian.min;
    if (before >= enough || result.data.quad_groups.size() != result.data.quads.size()) {
        return;
    }
    ImproveOptions options;
    options.target = 0.5;
    options.sufficient = enough;
    options.effort = 30;
    options.execution = execution;
    const PlaneGuide guide(model, result.data);
    HexMesh& mesh = result.data.mesh;
    const SmoothReport report =
        improve_hexes(std::span(mesh.nodes), std::span<const HexCorners>(mesh.hexes), guide, options);
    result.details["improvement"] = cli::to_json(report);
    const double after = hex_quality(mesh, {10, execution}).scaled_jacobian.min;
    if (after > before) {
        std::ostringstream note;
        note << "least scaled Jacobian raised from " << before << " by sliding nodes on plane faces";
        result.notes.push_back(note.str());
    }
}

}  // namespace pavior::cli
