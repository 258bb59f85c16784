#include "surface_triangles.hpp"

#include "plane_mesh.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <set>
#include <utility>

namespace pavior::detail {

namespace {

constexpr double full_turn = 2 * std::numbers::pi;
constexpr double infinite = std::numeric_limits<double>::infinity();

double angle_between(const Vec3& a, const Vec3& b) { return std::atan2(a.cross(b).norm(), a.dot(b)); }

/// The angle that an edge of a curve of this curvature may span: a full turn by a number of the ladder per_turn,
/// 2 per_turn, 4 per_turn ..., so that arcs next to each other are divided alike.
double allowed_angle(double curvature, const SurfaceLimits& limits) {
    const double height = limits.chord * curvature;  // of the arc, in radii
    const double wanted = height < 1 ? std::numbers::pi / std::acos(1 - height) : 1;
    double count = limits.per_turn;
    while (count < (1 - 1e-6) * wanted && count < 1e6) {
        count *= 2;
    }
    return full_turn / count;
}

// ---- edges --------------------------------------------------------------------------------------------------------

/// Points of a curve at equal steps of its parameter, with what each step asks for.
struct CurveSteps {
    std::vector<double> wish;  ///< edges that each step asks for
    double total = 0;

    CurveSteps(const GmshModel& model, const EdgeData& edge, const SurfaceLimits& limits) {
        for (std::size_t steps = 128; steps <= 8192; steps *= 2) {
            if (sample(model, edge, limits, steps) < 0.2) {
                break;
            }
        }
    }

    /// Parameters that part the curve into edges of equal wishes.
    [[nodiscard]] std::vector<double> parts(const std::array<double, 2>& range, std::size_t count) const {
        const double floor = (total > 0 ? 1e-3 * total : 1) / static_cast<double>(wish.size());
        const double sum = total + floor * static_cast<double>(wish.size());
        std::vector<double> t{range[0]};
        double done = 0;
        for (std::size_t i = 0; i < wish.size(); ++i) {
            const double own = wish[i] + floor;
            while (t.size() < count && done + own >= sum * static_cast<double>(t.size()) / static_cast<double>(count)) {
                const double at = (sum * static_cast<double>(t.size()) / static_cast<double>(count) - done) / own;
                t.push_back(range[0] +
                            (range[1] - range[0]) * (static_cast<double>(i) + at) / static_cast<double>(wish.size()));
            }
            done += own;
        }
        t.resize(count, range[1]);
        t.push_back(range[1]);
        return t;
    }

private:
    /// Returns the largest angle between two steps.
    double sample(const GmshModel& model, const EdgeData& edge, const SurfaceLimits& limits, std::size_t steps) {
        std::vector<double> t(steps + 1);
        for (std::size_t i = 0; i <= steps; ++i) {
            t[i] =
                edge.range[0] + (edge.range[1] - edge.range[0]) * static_cast<double>(i) / static_cast<double>(steps);
        }
        std::vector<Vec3> x(t.size());
        model.edge_points(edge.tag, t, x);
        std::vector<double> turns(steps + 1, 0.0);  // at the points between steps
        for (std::size_t i = 1; i < steps; ++i) {
            turns[i] = angle_between(x[i] - x[i - 1], x[i + 1] - x[i]);
        }
        turns.front() = turns[1];
        turns.back() = turns[steps - 1];
        wish.assign(steps, 0.0);
        total = 0;
        for (std::size_t i = 0; i < steps; ++i) {
            const double angle = 0.5 * (turns[i] + turns[i + 1]);
            const double length = (x[i + 1] - x[i]).norm();
            if (angle > 1e-7 && length > 0) {
                wish[i] = angle / allowed_angle(angle / length, limits);
            }
            total += wish[i];
        }
        return *std::max_element(turns.begin(), turns.end());
    }
};

// ---- faces --------------------------------------------------------------------------------------------------------

/// A point of the parameter plane of a face.
struct FaceNode {
    Vec2 uv = Vec2::Zero();
    Vec3 x = Vec3::Zero();
    Vec3 normal = Vec3::Zero();      ///< zero where the parameters degenerate
    Index node = no_index;           ///< in the whole
    std::size_t edge = no_position;  ///< the edge that the loop follows from here on
};

/// The point of a face, and the unit normal there: zero where the parameters degenerate.
std::pair<Vec3, Vec3> point_and_normal(const GmshModel& model, const FaceData& face, const Vec2& uv) {
    const std::array at{wrapped(face, uv)};
    std::array<Vec3, 1> x;
    std::array<std::array<Vec3, 2>, 1> d;
    model.face_points(face.tag, at, x);
    model.face_derivatives(face.tag, at, d);
    const Vec3 normal = d[0][0].cross(d[0][1]);
    const double length = normal.norm();
    const bool degenerate = !(length > 1e-9 * d[0][0].norm() * d[0][1].norm()) || !std::isfinite(length);
    return {x[0], degenerate ? Vec3(Vec3::Zero()) : Vec3(normal / length)};
}

/// How long edges of a face may be at most whose shortest ones are \p least long.
double longest_edge(double least, const SurfaceLimits& limits) {
    return limits.longest < infinite ? std::max(limits.longest * least, limits.shortest) : infinite;
}

/// How long edges may be along the two parameters of a face, measured on a grid.
struct FaceSteps {
    Vec2 cell = Vec2::Ones();  ///< as parameters
    double least = infinite;   ///< the shorter as a length; infinite for a plane

    FaceSteps(const GmshModel& model, const FaceData& face, const SurfaceLimits& limits) {
        constexpr int steps = 8;
        const Vec2 low = face.bounds[0];
        const Vec2 extent = face.bounds[1] - low;
        std::vector<std::pair<Vec3, Vec3>> grid;
        for (int i = 0; i <= steps; ++i) {
            for (int j = 0; j <= steps; ++j) {
                grid.push_back(point_and_normal(model, face, low + extent.cwiseProduct(Vec2(i, j)) / steps));
            }
        }
        std::array<double, 2> step{infinite, infinite};  // as lengths
        std::array<double, 2> speed{};
        const auto measure = [&](std::size_t d, const auto& from, const auto& to) {
            const double length = (to.first - from.first).norm();
            const bool degenerate = from.second.isZero() || to.second.isZero();
            const double angle = degenerate ? 0 : angle_between(from.second, to.second);
            if (angle > 1e-7 && length > 0) {
                step[d] = std::min(step[d], length / angle * allowed_angle(angle / length, limits));
            }
            speed[d] = std::max(speed[d], length * steps / extent[static_cast<Eigen::Index>(d)]);
        };
        for (std::size_t at = 0; at < grid.size(); ++at) {
            if (at + steps + 1 < grid.size()) {
                measure(0, grid[at], grid[at + steps + 1]);
            }
            if (at % (steps + 1) != steps) {
                measure(1, grid[at], grid[at + 1]);
            }
        }
        least = std::min(step[0], step[1]);
        for (const std::size_t d : {0U, 1U}) {
            const double longest = std::min(16 * least, longest_edge(least, limits));
            const double own = least < infinite ? std::min(step[d], longest) : 1.0;
            const auto k = static_cast<Eigen::Index>(d);
            cell[k] = speed[d] > 0 ? own / speed[d] : extent[k];
        }
    }
};

/// One face.
class FaceTriangulator {
public:
    FaceTriangulator(const GmshModel& model, const Topology& topology, const FaceData& face, const FaceSteps& steps,
                     const SurfaceLimits& limits)
        : model_(model),
          topology_(topology),
          face_(face),
          cell_(steps.cell),
          longest_(longest_edge(steps.least, limits)),
          limits_(limits),
          plane_(face.kind == "Plane") {}

    /// \p parameters and \p nodes of each edge. False if edges cross: crossing() names them.
    bool run(const std::vector<std::vector<double>>& parameters, SurfaceTriangles& result) {
        collect(parameters, result.edges);
        std::vector<Vec2> plane(nodes_.size());
        std::transform(nodes_.begin(), nodes_.end(), plane.begin(),
                       [&](const FaceNode& n) { return Vec2(n.uv.cwiseQuotient(cell_)); });
        for (const Index at : crossing_edges(plane, loops_)) {
            crossing_.insert(nodes_[at].edge);
        }
        crossing_.erase(no_position);
        if (!crossing_.empty()) {
            return false;
        }
        std::optional<PlaneMesh> mesh = PlaneMesh::of(std::move(plane), loops_);
        if (!mesh) {
            return give_up();
        }
        for (FaceNode& node : nodes_) {
            node.x = result.nodes[node.node];
        }
        if (!plane_ && !refine(*mesh, result)) {
            return give_up();
        }
        return finish(*mesh, result);
    }

    /// Edges that are to be divided more finely.
    [[nodiscard]] const std::set<std::size_t>& crossing() const { return crossing_; }

private:
    bool give_up() {
        for (const EdgeUse& use : face_.uses) {
            crossing_.insert(use.edge.index());
        }
        return false;
    }

    void collect(const std::vector<std::vector<double>>& parameters, const std::vector<std::vector<Index>>& on_edge) {
        for (const std::vector<LoopPiece>& chain : face_.chains) {
            std::vector<Index>& loop = loops_.emplace_back();
            for (const LoopPiece& piece : chain) {
                if (piece.use == no_position) {
                    add_pole(piece, loop);
                } else {
                    add_edge(face_.uses[piece.use], parameters, on_edge, loop);
                }
            }
        }
    }

    void add(const FaceNode& node, std::vector<Index>& loop) {
        loop.push_back(static_cast<Index>(nodes_.size()));
        nodes_.push_back(node);
    }

    void add_edge(const EdgeUse& use, const std::vector<std::vector<double>>& parameters,
                  const std::vector<std::vector<Index>>& on_edge, std::vector<Index>& loop) {
        const std::size_t edge = use.edge.index();
        std::vector<double> t = parameters[edge];
        std::vector<Index> nodes = on_edge[edge];
        if (!use.forward) {
            std::reverse(t.begin(), t.end());
            std::reverse(nodes.begin(), nodes.end());
        }
        t.pop_back();
        std::vector<Vec2> uv(t.size());
        use_parameters(model_, topology_.edges[edge], face_, use, t, uv, topology_.diagonal);
        for (std::size_t i = 0; i < t.size(); ++i) {
            add({uv[i], Vec3::Zero(), normal_at(uv[i]), nodes[i], edge}, loop);
        }
    }

    /// A degenerate curve: one node at several parameters.
    void add_pole(const LoopPiece& piece, std::vector<Index>& loop) {
        const BoundaryCurve& curve = face_.curves[piece.curve];
        const Vec2 first = piece.forward ? curve.uv.front() : curve.uv.back();
        const Vec2 last = piece.forward ? curve.uv.back() : curve.uv.front();
        const double angle = (last - first).cwiseAbs().maxCoeff();
        const bool is_angle = face_.period[0] > 0 || face_.period[1] > 0 || angle < full_turn;
        const double count = is_angle ? std::clamp(std::ceil(angle / full_turn * limits_.per_turn), 1.0, 64.0) : 4.0;
        for (double i = 0; i < count; ++i) {
            add({first + i / count * (last - first), Vec3::Zero(), Vec3::Zero(), static_cast<Index>(curve.vertices[0]),
                 no_position},
                loop);
        }
    }

    [[nodiscard]] Vec3 normal_at(const Vec2& uv) const {
        return plane_ ? Vec3(Vec3::Zero()) : point_and_normal(model_, face_, uv).second;
    }

    /// Distance of the middle of an edge from the face along its normal.
    [[nodiscard]] std::pair<double, Vec3> height(const Vec2& uv, const Vec3& x) const {
        const auto [on_face, normal] = point_and_normal(model_, face_, uv);
        const Vec3 gap = on_face - x;
        return {normal.isZero() ? gap.norm() : std::abs(gap.dot(normal)), normal};
    }

    [[nodiscard]] double badness(Index a, Index b) const {
        const FaceNode& p = nodes_[a];
        const FaceNode& q = nodes_[b];
        const auto [high, normal] = height(0.5 * (p.uv + q.uv), 0.5 * (p.x + q.x));
        const double least = 0.02 * limits_.chord;
        if ((p.x - q.x).norm() < least && high < least) {
            return 0;
        }
        double angle = 0;
        for (const FaceNode* end : {&p, &q}) {
            if (!end->normal.isZero() && !normal.isZero()) {
                angle = std::max(angle, 2 * angle_between(end->normal, normal));
            }
        }
        return std::max({high / (inner_share * limits_.chord), angle / (1.6 * full_turn / limits_.per_turn),
                         (p.x - q.x).norm() / (1.5 * longest_)});
    }

    bool refine(PlaneMesh& mesh, SurfaceTriangles& result) {
        const auto added = [&](Index /*point*/, Index a, Index b) {
            FaceNode node;
            node.uv = 0.5 * (nodes_[a].uv + nodes_[b].uv);
            std::tie(node.x, node.normal) = point_and_normal(model_, face_, node.uv);
            node.node = static_cast<Index>(result.nodes.size());
            result.nodes.push_back(node.x);
            nodes_.push_back(node);
        };
        constexpr std::size_t most = 20000;
        return mesh.refine([&](Index a, Index b) { return badness(a, b); }, added, most);
    }

    /// Takes the triangles, measures them, drops those without area at poles.
    bool finish(const PlaneMesh& mesh, SurfaceTriangles& result) {
        std::vector<TriCorners>& triangles = result.faces[static_cast<std::size_t>(&face_ - topology_.faces.data())];
        for (const TriCorners& c : mesh.triangles()) {
            const std::array<const FaceNode*, 3> n{&nodes_[c[0]], &nodes_[c[1]], &nodes_[c[2]]};
            if (n[0]->node == n[1]->node || n[1]->node == n[2]->node || n[2]->node == n[0]->node) {
                continue;
            }
            triangles.push_back({n[0]->node, n[1]->node, n[2]->node});
            if (!plane_ && !measure(n, result.chord)) {
                return give_up();
            }
        }
        return !triangles.empty() || give_up();
    }

    /// False if the triangle looks the other way than the face.
    [[nodiscard]] bool measure(const std::array<const FaceNode*, 3>& n, double& chord) const {
        for (const std::size_t k : {0U, 1U, 2U}) {
            const FaceNode& p = *n[k];
            const FaceNode& q = *n[(k + 1) % 3];
            chord = std::max(chord, height(0.5 * (p.uv + q.uv), 0.5 * (p.x + q.x)).first);
        }
        const Vec3 centre = (n[0]->x + n[1]->x + n[2]->x) / 3;
        const auto [high, normal] = height((n[0]->uv + n[1]->uv + n[2]->uv) / 3, centre);
        chord = std::max(chord, high);
        return normal.isZero() || (n[1]->x - n[0]->x).cross(n[2]->x - n[0]->x).dot(normal) > 0;
    }

    static constexpr double inner_share = 0.75;  ///< of the chord, for edges: centres of triangles lie deeper

    const GmshModel& model_;
    const Topology& topology_;
    const FaceData& face_;
    const Vec2 cell_;
    const double longest_;  ///< of inner edges
    const SurfaceLimits& limits_;
    bool plane_;
    std::vector<FaceNode> nodes_;
    PointLoops loops_;
    std::set<std::size_t> crossing_;
};

/// All faces, with edges divided ever more finely where they cross.
class SurfaceTriangulator {
public:
    SurfaceTriangulator(const GmshModel& model, const Topology& topology, std::span<const std::size_t> faces,
                        const SurfaceLimits& limits)
        : model_(model), topology_(topology), faces_(faces), limits_(limits), edges_(topology.edges.size(), -1.0) {
        for (const std::size_t f : faces) {
            steps_of_faces_.emplace(f, FaceSteps(model, topology.faces[f], limits));
            for (const EdgeUse& use : topology.faces[f].uses) {
                double& length = edges_[use.edge.index()];
                length = std::min(length < 0 ? infinite : length, longest_edge(steps_of_faces_.at(f).least, limits));
            }
        }
        count_edges();
    }

    std::optional<SurfaceTriangles> run() {
        constexpr int rounds = 6;
        for (int round = 0; round < rounds; ++round) {
            if (std::optional<SurfaceTriangles> result = once()) {
                return result;
            }
        }
        return std::nullopt;
    }

private:
    void count_edges() {
        std::map<std::pair<std::int32_t, std::int32_t>, int> ends;
        for (std::size_t e = 0; e < edges_.size(); ++e) {
            const auto& [a, b] = topology_.edges[e].vertices;
            ++ends[std::minmax(a.value, b.value)];
        }
        SurfaceLimits own = limits_;
        own.chord *= 0.9;
        for (std::size_t e = 0; e < edges_.size(); ++e) {
            const EdgeData& edge = topology_.edges[e];
            steps_.push_back(edges_[e] >= 0 ? std::optional(CurveSteps(model_, edge, own)) : std::nullopt);
            const double wish =
                steps_.back() ? std::ceil(std::max(steps_.back()->total, edge.length / edges_[e]) - 1e-6) : 0;
            const auto& [a, b] = edge.vertices;
            const bool alone = ends.at(std::minmax(a.value, b.value)) == 1 || wish == 0;
            const double least = a == b ? 3 : alone ? 1 : 2;
            counts_.push_back(static_cast<std::size_t>(std::max(wish, least)));
        }
    }

    std::optional<SurfaceTriangles> once() {
        SurfaceTriangles result;
        result.nodes = topology_.vertices;
        result.edges.resize(edges_.size());
        result.faces.resize(topology_.faces.size());
        std::vector<std::vector<double>> parameters(edges_.size());
        for (std::size_t e = 0; e < edges_.size(); ++e) {
            if (edges_[e] >= 0) {
                place(e, parameters[e], result);
            }
        }
        std::set<std::size_t> crossing;
        for (const std::size_t f : faces_) {
            FaceTriangulator face(model_, topology_, topology_.faces[f], steps_of_faces_.at(f), limits_);
            if (!face.run(parameters, result)) {
                crossing.insert(face.crossing().begin(), face.crossing().end());
            }
        }
        for (const std::size_t e : crossing) {
            counts_[e] *= 2;
        }
        return crossing.empty() ? std::optional(std::move(result)) : std::nullopt;
    }

    void place(std::size_t e, std::vector<double>& t, SurfaceTriangles& result) const {
        const EdgeData& edge = topology_.edges[e];
        t = steps_[e]->parts(edge.range, counts_[e]);
        std::vector<Vec3> x(t.size());
        model_.edge_points(edge.tag, t, x);
        std::vector<Index>& nodes = result.edges[e];
        nodes.push_back(static_cast<Index>(edge.vertices[0].index()));
        for (std::size_t i = 1; i + 1 < t.size(); ++i) {
            nodes.push_back(static_cast<Index>(result.nodes.size()));
            result.nodes.push_back(x[i]);
        }
        nodes.push_back(static_cast<Index>(edge.vertices[1].index()));
    }

    const GmshModel& model_;
    const Topology& topology_;
    std::span<const std::size_t> faces_;
    SurfaceLimits limits_;
    std::map<std::size_t, FaceSteps> steps_of_faces_;
    std::vector<double> edges_;  ///< how long edges on it may be where it is straight; negative: no face has it
    std::vector<std::optional<CurveSteps>> steps_;
    std::vector<std::size_t> counts_;
};

}  // namespace

std::optional<SurfaceTriangles> surface_triangles(const GmshModel& model, const Topology& topology,
                                                  std::span<const std::size_t> faces, const SurfaceLimits& limits) {
    return SurfaceTriangulator(model, topology, faces, limits).run();
}

}  // namespace pavior::detail
