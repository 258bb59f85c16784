#pragma once
/// \file
/// Angles between the faces of a solid along its edges.

#include <pavior/brep/face_corners.hpp>
#include <pavior/brep/solid_boundary.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

namespace pavior {

/// An edge between two faces of a solid, and the angle that the material fills there.
struct EdgeAngle {
    EdgeId edge;
    std::array<OrientedFace, 2> faces;
    double least = 0, most = 0;  ///< degrees, over samples: 90 at the edge of a box, 270 in a notch, 180 if smooth

    [[nodiscard]] bool concave() const { return least > 200; }
    [[nodiscard]] bool smooth() const { return least > 170 && most < 190; }
};

/// The angles at the edges of \p solid, in the order of its boundary; edges that have one face on both sides (seams)
/// are left out. Three samples each.
template <brep B>
[[nodiscard]] std::vector<EdgeAngle> edge_angles(const B& b, SolidId solid) {
    const SolidBoundary boundary = solid_boundary(b, solid);
    std::vector<EdgeAngle> result;
    for (std::size_t h = 0; h < boundary.half_edges.size(); ++h) {
        const SolidBoundary::HalfEdge& one = boundary.half_edges[h];
        const SolidBoundary::HalfEdge& other = boundary.half_edges[one.twin];
        if (one.twin < h || one.face == other.face) {
            continue;
        }
        const std::array faces{boundary.faces[one.face].face, boundary.faces[other.face].face};
        const auto range = b.edge_range(one.use.edge);
        EdgeAngle angle{one.use.edge, faces, 360, 0};
        for (const double part : {0.15, 0.5, 0.85}) {
            const double t = range[0] + part * (range[1] - range[0]);
            const auto normal = [&](const OrientedFace& f, bool forward) {
                // a loop seen from outside runs the other way where the face's own normal points inwards
                return outward_normal(b, f, b.edge_on_face(one.use.edge, t, f.face, forward == f.outward));
            };
            const Vec3 along = (one.use.forward ? 1.0 : -1.0) * b.edge_derivative(one.use.edge, t).normalized();
            const Vec3 n = normal(faces[0], one.use.forward);
            const Vec3 into = n.cross(along);
            const Vec3 into_other = normal(faces[1], other.use.forward).cross(-along);
            const double turn = std::atan2(-into_other.dot(n), into_other.dot(into)) * 180 / std::numbers::pi;
            if (std::isfinite(turn)) {
                const double own = turn < 0 ? turn + 360 : turn;
                angle.least = std::min(angle.least, own);
                angle.most = std::max(angle.most, own);
            }
        }
        if (angle.least <= angle.most) {
            result.push_back(angle);
        }
    }
    return result;
}

}  // namespace pavior
