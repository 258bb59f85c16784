#pragma once
/// \file
/// Poor meshes made better with nodes that slide on plane faces.

#include <pavior/mesh/boundary_quads.hpp>
#include <pavior/mesh/grouped_mesh.hpp>
#include <pavior/part/any_model.hpp>
#include <pavior/part/model_extras.hpp>
#include <pavior/smooth/node_guide.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

namespace pavior {

/// The node_guide of a mesh on plane faces: nodes inside a face slide in its plane, those on an edge between two slide
/// along it; those on vertices and curved faces are fixed. The groups of the quads are tags of faces.
class PlaneGuide {
public:
    PlaneGuide(const AnyModel& b, const HexMeshData& data) : holds_(data.mesh.nodes.size()) {
        collect(data);
        std::map<int, std::optional<FacePlane>> planes;
        for (std::size_t f = 0; f < b.face_count(); ++f) {
            planes[b.tag(2, f)] = plane_of(b, FaceId{static_cast<std::int32_t>(f)});
        }
        for (Hold& hold : holds_) {
            settle(planes, hold);
        }
        const double near = 1e-7 * diagonal_of(b);
        for (std::size_t v = 0; v < b.vertex_count(); ++v) {
            fix_at(data, b.vertex_point(VertexId{static_cast<std::int32_t>(v)}), near);
        }
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

    static void settle(const std::map<int, std::optional<FacePlane>>& planes, Hold& hold) {
        constexpr double least_sine = 0.05;  // sine of the angle between two planes
        if (hold.faces.empty()) {
            return;
        }
        hold.freedom = Freedom::fixed;
        std::vector<FacePlane> own;
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
        } else if (const Vec3 along = own[0].normal.cross(own[1].normal); along.norm() > least_sine) {
            hold.freedom = Freedom::curve;
            hold.direction = along.normalized();
        }
    }

    void fix_at(const HexMeshData& data, const Vec3& x, double near) {
        for (std::size_t i = 0; i < holds_.size(); ++i) {
            if (holds_[i].freedom == Freedom::curve && (data.mesh.nodes[i] - x).norm() <= near) {
                holds_[i].freedom = Freedom::fixed;
            }
        }
    }

    std::vector<Hold> holds_;
};

}  // namespace pavior
