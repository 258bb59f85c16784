// Parameters on faces: periods, projections, edges on faces.
#include "gmsh_topology.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pavior::detail {

namespace {

struct Projection {
    Vec2 uv;
    double distance;
};

Projection measured(const GmshModel& model, const FaceData& face, const Vec3& x, const Vec2& uv) {
    std::array<Vec3, 1> point;
    model.face_points(face.tag, std::array{wrapped(face, uv)}, point);
    return {uv, (point[0] - x).norm()};
}

Vec2 clamped(const FaceData& face, Vec2 uv) {
    for (int d = 0; d < 2; ++d) {
        if (face.period[static_cast<std::size_t>(d)] == 0) {
            uv[d] = std::clamp(uv[d], face.bounds[0][d], face.bounds[1][d]);
        }
    }
    return uv;
}

/// Gauss-Newton inside the box of the face.
Projection refined(const GmshModel& model, const FaceData& face, const Vec3& x, Projection best) {
    for (int iteration = 0; iteration < 20; ++iteration) {
        const std::array at{wrapped(face, best.uv)};
        std::array<Vec3, 1> point;
        std::array<std::array<Vec3, 2>, 1> derivative;
        model.face_points(face.tag, at, point);
        model.face_derivatives(face.tag, at, derivative);
        const auto& [du, dv] = derivative[0];
        const Vec3 gap = x - point[0];
        const double a = du.squaredNorm();
        const double b = du.dot(dv);
        const double c = dv.squaredNorm();
        const double determinant = a * c - b * b;
        if (!(determinant > 1e-24 * a * c)) {
            return best;
        }
        Vec2 step(c * du.dot(gap) - b * dv.dot(gap), a * dv.dot(gap) - b * du.dot(gap));
        step /= determinant;
        bool better = false;
        for (int halving = 0; halving < 6 && !better; ++halving, step *= 0.5) {
            const Projection trial = measured(model, face, x, clamped(face, best.uv + step));
            better = trial.distance < best.distance;
            if (better) {
                best = trial;
            }
        }
        if (!better) {
            return best;
        }
    }
    return best;
}

Projection best_on_grid(const GmshModel& model, const FaceData& face, const Vec3& x) {
    constexpr int steps = 12;
    std::vector<Vec2> uv;
    for (int i = 0; i <= steps; ++i) {
        for (int j = 0; j <= steps; ++j) {
            uv.push_back(face.bounds[0] + (face.bounds[1] - face.bounds[0]).cwiseProduct(Vec2(i, j) / steps));
        }
    }
    for (const BoundaryCurve& curve : face.curves) {
        uv.insert(uv.end(), curve.uv.begin(), curve.uv.end());
    }
    std::vector<Vec3> points(uv.size());
    model.face_points(face.tag, uv, points);
    Projection best{uv.front(), std::numeric_limits<double>::infinity()};
    for (std::size_t i = 0; i < uv.size(); ++i) {
        if (const double distance = (points[i] - x).norm(); distance < best.distance) {
            best = {uv[i], distance};
        }
    }
    return best;
}

/// The offset is square to the surface.
bool is_foot(const GmshModel& model, const FaceData& face, const Vec3& x, const Projection& projection) {
    std::array<std::array<Vec3, 2>, 1> derivative;
    std::array<Vec3, 1> point;
    model.face_derivatives(face.tag, std::array{projection.uv}, derivative);
    model.face_points(face.tag, std::array{projection.uv}, point);
    const Vec3 gap = x - point[0];
    const double slack = 1e-6 * gap.norm() + 1e-12 * x.norm();
    return std::abs(gap.dot(derivative[0][0])) <= slack * derivative[0][0].norm() &&
           std::abs(gap.dot(derivative[0][1])) <= slack * derivative[0][1].norm();
}

}  // namespace

Vec2 wrapped(const FaceData& face, Vec2 uv) {
    for (int d = 0; d < 2; ++d) {
        const auto k = static_cast<std::size_t>(d);
        if (!face.closed[k]) {
            continue;
        }
        const double turns = (uv[d] - face.bounds[0][d]) / face.period[k];
        if (!std::isfinite(turns)) {
            continue;
        }
        if (std::abs(turns) > 16) {  // steps near a pole lead far off
            uv[d] -= face.period[k] * std::floor(turns);
        }
        const double slack = 1e-9 * face.period[k];
        while (uv[d] < face.bounds[0][d] - slack) {
            uv[d] += face.period[k];
        }
        while (uv[d] > face.bounds[1][d] + slack) {
            uv[d] -= face.period[k];
        }
    }
    return uv;
}

Vec2 shifted_to(const FaceData& face, Vec2 uv, const Vec2& reference) {
    for (int d = 0; d < 2; ++d) {
        const double period = face.period[static_cast<std::size_t>(d)];
        if (period > 0) {
            uv[d] += period * std::round((reference[d] - uv[d]) / period);
        }
    }
    return uv;
}

Vec2 closest_parameters(const GmshModel& model, const FaceData& face, const Vec3& x) {
    Vec2 uv;
    if (model.project_on_face(face.tag, x, uv)) {
        const Projection projection = measured(model, face, x, uv);
        if (is_foot(model, face, x, projection)) {
            return shifted_to(face, uv, 0.5 * (face.bounds[0] + face.bounds[1]));
        }
    }
    const Projection best = refined(model, face, x, best_on_grid(model, face, x));
    return shifted_to(face, best.uv, 0.5 * (face.bounds[0] + face.bounds[1]));
}

void use_parameters(const GmshModel& model, const EdgeData& edge, const FaceData& face, const EdgeUse& use,
                    std::span<const double> t, std::span<Vec2> uv, double diagonal) {
    model.edge_on_face(edge.tag, t, face.tag, use.side, uv);
    std::vector<Vec3> on_edge(t.size());
    std::vector<Vec3> on_face(t.size());
    std::vector<Vec2> inside(uv.begin(), uv.end());
    std::transform(inside.begin(), inside.end(), inside.begin(), [&](const Vec2& p) { return wrapped(face, p); });
    model.edge_points(edge.tag, t, on_edge);
    model.face_points(face.tag, inside, on_face);
    const double tolerance = 1e-6 * diagonal;
    for (std::size_t i = 0; i < t.size(); ++i) {
        const double gap = (on_edge[i] - on_face[i]).norm();
        if (!(gap <= tolerance)) {
            const Vec2 closest = closest_parameters(model, face, on_edge[i]);
            if (!(measured(model, face, on_edge[i], closest).distance >= gap)) {
                uv[i] = closest;
            }
        }
        if (use.uv.size() > 1) {
            const double at = (t[i] - edge.range[0]) / (edge.range[1] - edge.range[0]);
            const double position = std::clamp(at, 0.0, 1.0) * static_cast<double>(use.uv.size() - 1);
            const std::size_t k = std::min(static_cast<std::size_t>(position), use.uv.size() - 2);
            const double weight = position - static_cast<double>(k);
            uv[i] = shifted_to(face, uv[i], (1 - weight) * use.uv[k] + weight * use.uv[k + 1]);
        }
    }
}

}  // namespace pavior::detail
