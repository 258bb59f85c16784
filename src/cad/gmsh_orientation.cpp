// The sense of the faces of a solid.
#include "gmsh_topology.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <map>

namespace pavior::detail {

namespace {

/// Abscissas and weights on [0, 1].
constexpr std::array<std::array<double, 2>, 4> gauss{{{0.0694318442029737, 0.1739274225687269},
                                                      {0.3300094782075719, 0.3260725774312731},
                                                      {0.6699905217924281, 0.3260725774312731},
                                                      {0.9305681557970263, 0.1739274225687269}}};

/// One third of the flux of x - centre through the face along its own normal. By Green's theorem in the parameter
/// plane: the integral of g(u, v) over the face is the integral of G dv along its loops, dG/du = g.
double face_flux(const GmshModel& model, const FaceData& face, const Vec3& centre, int panels) {
    const auto loops = chain_curves(face.curves, face.bounds[1] - face.bounds[0]);
    const double origin = face.bounds[0].x();
    std::vector<Vec2> uv;
    std::vector<double> weights;
    for (const CurveLoop& loop : *loops) {
        for (const auto& [curve, forward] : loop) {
            const std::vector<Vec2>& samples = face.curves[curve].uv;
            for (std::size_t i = 0; i + 1 < samples.size(); ++i) {
                const Vec2 middle = 0.5 * (samples[i] + samples[i + 1]);
                const double dv = (forward ? 1 : -1) * (samples[i + 1].y() - samples[i].y());
                const double width = (middle.x() - origin) / panels;
                for (int panel = 0; dv != 0 && panel < panels; ++panel) {
                    for (const auto& [at, weight] : gauss) {
                        uv.push_back(wrapped(face, {origin + (panel + at) * width, middle.y()}));
                        weights.push_back(weight * width * dv);
                    }
                }
            }
        }
    }
    std::vector<Vec3> points(uv.size());
    std::vector<std::array<Vec3, 2>> derivatives(uv.size());
    model.face_points(face.tag, uv, points);
    model.face_derivatives(face.tag, uv, derivatives);
    double sum = 0;
    for (std::size_t i = 0; i < uv.size(); ++i) {
        sum += weights[i] * (points[i] - centre).dot(derivatives[i][0].cross(derivatives[i][1]));
    }
    return sum / 3;
}

struct FaceUse {
    std::size_t face;  ///< position in solid.faces
    bool forward;
};

std::map<EdgeId, std::vector<FaceUse>> edge_uses(const Topology& topology, const SolidData& solid) {
    std::map<EdgeId, std::vector<FaceUse>> uses;
    for (std::size_t i = 0; i < solid.faces.size(); ++i) {
        for (const EdgeLoop& loop : topology.faces[solid.faces[i].face.index()].loops) {
            for (const OrientedEdge& edge : loop) {
                uses[edge.edge].push_back({i, edge.forward});
            }
        }
    }
    return uses;
}

/// Shells: faces connected through edges, their senses made consistent. Returns the shell of each face.
std::vector<int> spread_senses(const Topology& topology, SolidData& solid) {
    std::vector<std::vector<std::pair<std::size_t, bool>>> neighbours(solid.faces.size());
    for (const auto& [edge, users] : edge_uses(topology, solid)) {
        if (users.size() != 2) {
            const int tag = topology.edges[edge.index()].tag;
            throw Error(ErrorCode::non_manifold,
                        entity_label(3, solid.tag) + ": its faces use " + entity_label(1, tag) + " " +
                            std::to_string(users.size()) + " times instead of twice",
                        {tag});
        }
        const bool same = users[0].forward != users[1].forward;
        if (users[0].face == users[1].face && !same) {
            const int tag = topology.faces[solid.faces[users[0].face].face.index()].tag;
            throw Error(ErrorCode::cad_failure, entity_label(2, tag) + ": one-sided", {tag});
        }
        neighbours[users[0].face].emplace_back(users[1].face, same);
        neighbours[users[1].face].emplace_back(users[0].face, same);
    }
    std::vector<int> shell(solid.faces.size(), -1);
    int count = 0;
    for (std::size_t seed = 0; seed < shell.size(); ++seed) {
        std::vector<std::size_t> front;
        if (shell[seed] < 0) {
            shell[seed] = count++;
            front.push_back(seed);
        }
        while (!front.empty()) {
            const std::size_t at = front.back();
            front.pop_back();
            for (const auto& [next, same] : neighbours[at]) {
                const bool sense = solid.faces[at].outward == same;
                if (shell[next] < 0) {
                    shell[next] = shell[at];
                    solid.faces[next].outward = sense;
                    front.push_back(next);
                } else if (solid.faces[next].outward != sense) {
                    throw Error(ErrorCode::cad_failure, entity_label(3, solid.tag) + ": its faces cannot be oriented",
                                {solid.tag});
                }
            }
        }
    }
    return shell;
}

std::vector<double> shell_volumes(const GmshModel& model, const Topology& topology, const SolidData& solid,
                                  const std::vector<int>& shell, int panels) {
    std::vector<double> volume(static_cast<std::size_t>(*std::max_element(shell.begin(), shell.end())) + 1, 0.0);
    const FaceData& any = topology.faces[solid.faces.front().face.index()];
    std::array<Vec3, 1> centre;
    model.face_points(any.tag, std::array{any.interior}, centre);
    for (std::size_t i = 0; i < solid.faces.size(); ++i) {
        const FaceData& face = topology.faces[solid.faces[i].face.index()];
        const double flux = face_flux(model, face, centre[0], panels);
        volume[static_cast<std::size_t>(shell[i])] += solid.faces[i].outward ? flux : -flux;
    }
    return volume;
}

}  // namespace

void orient_solid(const GmshModel& model, const Topology& topology, SolidData& solid) {
    const std::vector<int> shell = spread_senses(topology, solid);
    for (const int panels : {2, 8, 32}) {
        const std::vector<double> volume = shell_volumes(model, topology, solid, shell, panels);
        const auto outer = std::max_element(volume.begin(), volume.end(),
                                            [](double a, double b) { return std::abs(a) < std::abs(b); });
        double total = 0;
        for (const double& v : volume) {
            total += &v == &*outer ? std::abs(v) : -std::abs(v);
        }
        if (std::abs(total - solid.volume) > 0.05 * solid.volume) {
            continue;
        }
        for (std::size_t i = 0; i < shell.size(); ++i) {
            const auto own = static_cast<std::size_t>(shell[i]);
            const bool wants_positive = static_cast<std::ptrdiff_t>(own) == outer - volume.begin();
            if ((volume[own] > 0) != wants_positive) {
                solid.faces[i].outward = !solid.faces[i].outward;
            }
        }
        return;
    }
    throw Error(ErrorCode::cad_failure,
                entity_label(3, solid.tag) + ": its faces do not enclose the volume that the CAD kernel states",
                {solid.tag});
}

}  // namespace pavior::detail
