#include "gmsh_topology.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <numbers>
#include <set>

namespace pavior::detail {

namespace {

constexpr std::size_t curve_samples = 65;

using TagIndex = std::map<int, std::size_t>;

std::vector<int> boundary_tags(int dim, int tag) {
    return on_entity(dim, tag, [&] {
        gmsh::vectorpair boundary;
        gmsh::model::getBoundary({{dim, tag}}, boundary, false, false, false);
        std::vector<int> tags;
        std::transform(boundary.begin(), boundary.end(), std::back_inserter(tags),
                       [](const auto& entity) { return std::abs(entity.second); });
        return tags;
    });
}

TagIndex indexed(const std::set<int>& tags) {
    TagIndex index;
    for (const int tag : tags) {
        index.emplace(tag, index.size());
    }
    return index;
}

std::vector<double> sample_parameters(const std::array<double, 2>& range, std::size_t count) {
    std::vector<double> t(count);
    for (std::size_t i = 0; i < count; ++i) {
        t[i] = range[0] + (range[1] - range[0]) * static_cast<double>(i) / static_cast<double>(count - 1);
    }
    t.back() = range[1];
    return t;
}

/// Reads one model; edges are first collected with the degenerate ones, by tag.
class Reader {
public:
    explicit Reader(const GmshModel& model) : model_(model), current_(model) {}

    Topology read() {
        collect();
        read_vertices();
        read_edges();
        read_faces();
        read_solids();
        return std::move(result_);
    }

private:
    void collect() {
        gmsh::vectorpair solids;
        gmsh::model::getEntities(solids, 3);
        std::set<int> faces;
        for (const auto& [dim, tag] : solids) {
            solid_faces_[tag] = boundary_tags(3, tag);
            faces.insert(solid_faces_[tag].begin(), solid_faces_[tag].end());
        }
        std::set<int> edges;
        std::set<int> vertices;
        for (const int face : faces) {
            face_edges_[face] = boundary_tags(2, face);
            edges.insert(face_edges_[face].begin(), face_edges_[face].end());
        }
        for (const int edge : edges) {
            edge_ends_[edge] = boundary_tags(1, edge);
            vertices.insert(edge_ends_[edge].begin(), edge_ends_[edge].end());
        }
        vertex_index_ = indexed(vertices);
        face_index_ = indexed(faces);
    }

    void read_vertices() {
        for (const auto& [tag, index] : vertex_index_) {
            result_.vertex_tags.push_back(tag);
            result_.vertices.push_back(model_.vertex_point(tag));
        }
        result_.diagonal = bounding_box().extent().norm();
    }

    [[nodiscard]] std::size_t nearest_end(int edge, const Vec3& point) const {
        const std::vector<int>& ends = edge_ends_.at(edge);
        if (ends.empty()) {
            throw Error(ErrorCode::cad_failure, entity_label(1, edge) + " has no vertex", {edge});
        }
        const auto distance = [&](int tag) { return (result_.vertices[vertex_index_.at(tag)] - point).norm(); };
        return vertex_index_.at(
            *std::min_element(ends.begin(), ends.end(), [&](int a, int b) { return distance(a) < distance(b); }));
    }

    void read_edges() {
        for (const auto& [tag, ends] : edge_ends_) {
            EdgeData edge;
            edge.tag = tag;
            edge.range = model_.edge_range(tag);
            const std::vector<double> t = sample_parameters(edge.range, curve_samples);
            std::vector<Vec3> points(t.size());
            model_.edge_points(tag, t, points);
            const std::array ends_of{nearest_end(tag, points.front()), nearest_end(tag, points.back())};
            for (const std::size_t k : {0U, 1U}) {
                edge.vertices[k].value = static_cast<std::int32_t>(ends_of[k]);
            }
            double chord = 0;
            for (const Vec3& point : points) {
                chord = std::max(chord, (point - points.front()).norm());
            }
            if (!(chord > 1e-9 * result_.diagonal)) {
                degenerate_.emplace(tag, edge);
                continue;
            }
            edge.length = model_.mass(1, tag);
            edge_index_.emplace(tag, result_.edges.size());
            result_.edges.push_back(edge);
        }
    }

    void find_periods(FaceData& face) const {
        const Vec2 extent = face.bounds[1] - face.bounds[0];
        if (face.kind == "Plane") {
            return;
        }
        for (const int d : {0, 1}) {
            const auto k = static_cast<std::size_t>(d);
            if (d == 1 && face.kind == "Sphere") {
                continue;
            }
            if (repeats(face, d, face.bounds[0][d], extent[d])) {
                face.period[k] = extent[d];
                face.closed[k] = true;
            } else if (repeats(face, d, 0.5 * (face.bounds[0][d] + face.bounds[1][d]), 2 * std::numbers::pi)) {
                face.period[k] = 2 * std::numbers::pi;
            }
        }
    }

    /// The curves at parameter \p at and one period on are the same, and so are the tangents across them.
    [[nodiscard]] bool repeats(const FaceData& face, int d, double at, double period) const {
        std::vector<Vec2> uv;
        for (const double fraction : {0.1, 0.35, 0.5, 0.8}) {
            Vec2 point;
            point[1 - d] = face.bounds[0][1 - d] + fraction * (face.bounds[1][1 - d] - face.bounds[0][1 - d]);
            for (const double step : {0.0, 0.5, 1.0}) {
                point[d] = at + step * period;
                uv.push_back(point);
            }
        }
        std::vector<Vec3> points(uv.size());
        model_.face_points(face.tag, uv, points);
        double gap = 0;
        double reach = 0;
        for (std::size_t i = 0; i < points.size(); i += 3) {
            gap = std::max(gap, (points[i] - points[i + 2]).norm());
            reach = std::max(reach, (points[i] - points[i + 1]).norm());
        }
        return gap <= 1e-6 * reach && reach > 1e-9 * result_.diagonal;
    }

    void read_faces() {
        for (const auto& [tag, edges] : face_edges_) {
            FaceData face;
            face.tag = tag;
            face.bounds = model_.face_bounds(tag);
            on_entity(2, face.tag, [&] { gmsh::model::getType(2, face.tag, face.kind); });
            find_periods(face);
            face.area = model_.mass(2, tag);
            read_loops(face, edges);
            face.interior = interior_point(face.curves);
            result_.faces.push_back(std::move(face));
        }
    }

    /// Samples one use of an edge, continuous from its middle outwards.
    BoundaryCurve sample_use(const FaceData& face, const EdgeData& edge, int side, bool is_degenerate) const {
        const std::vector<double> t = sample_parameters(edge.range, curve_samples);
        BoundaryCurve curve{{edge.vertices[0].index(), edge.vertices[1].index()}, std::vector<Vec2>(t.size())};
        if (is_degenerate) {
            model_.edge_on_face(edge.tag, t, face.tag, side, curve.uv);
        } else {
            EdgeUse use;
            use.side = side;
            use_parameters(model_, edge, face, use, t, curve.uv, result_.diagonal);
        }
        for (std::size_t i = t.size() / 2; i-- > 0;) {
            curve.uv[i] = shifted_to(face, curve.uv[i], curve.uv[i + 1]);
        }
        for (std::size_t i = t.size() / 2 + 1; i < t.size(); ++i) {
            curve.uv[i] = shifted_to(face, curve.uv[i], curve.uv[i - 1]);
        }
        bring_inside(face, curve.uv);
        return curve;
    }

    /// Where the seam of a closed surface bounds a part of it, Gmsh may give parameters one period beyond the box.
    static void bring_inside(const FaceData& face, std::vector<Vec2>& uv) {
        const Vec2 middle = uv[uv.size() / 2];
        for (int d = 0; d < 2; ++d) {
            const double period = face.period[static_cast<std::size_t>(d)];
            const double slack = 1e-6 * period;
            for (const double shift : {-period, period}) {
                const bool outside = middle[d] > face.bounds[1][d] + slack || middle[d] < face.bounds[0][d] - slack;
                const double moved = middle[d] + shift;
                if (outside && moved <= face.bounds[1][d] + slack && moved >= face.bounds[0][d] - slack) {
                    std::for_each(uv.begin(), uv.end(), [&](Vec2& x) { x[d] += shift; });
                    break;
                }
            }
        }
    }

    void read_loops(FaceData& face, const std::vector<int>& edges) const {
        std::map<int, int> seen;
        std::vector<EdgeUse> uses;
        for (const int tag : edges) {
            const auto degenerate = degenerate_.find(tag);
            const bool is_degenerate = degenerate != degenerate_.end();
            EdgeUse use;
            use.side = seen[tag]++;
            if (use.side > 1 || (is_degenerate && use.side > 0)) {
                continue;
            }
            use.seam = std::count(edges.begin(), edges.end(), tag) > 1;
            if (!is_degenerate) {
                use.edge.value = static_cast<std::int32_t>(edge_index_.at(tag));
            }
            const EdgeData& edge = is_degenerate ? degenerate->second : result_.edges[use.edge.index()];
            BoundaryCurve curve = sample_use(face, edge, use.side, is_degenerate);
            use.uv = curve.uv;
            uses.push_back(std::move(use));
            face.curves.push_back(std::move(curve));
        }
        store_loops(face, std::move(uses));
    }

    void store_loops(FaceData& face, std::vector<EdgeUse> uses) const {
        const auto loops = chain_curves(face.curves, face.bounds[1] - face.bounds[0]);
        if (!loops || loops->empty()) {
            throw Error(ErrorCode::cad_failure,
                        entity_label(2, face.tag) + ": its edges do not close in parameter space", {face.tag});
        }
        for (const CurveLoop& chain : *loops) {
            EdgeLoop loop;
            std::vector<LoopPiece>& pieces = face.chains.emplace_back();
            for (const auto& [curve, forward] : chain) {
                uses[curve].forward = forward;
                const bool is_edge = uses[curve].edge.valid();
                pieces.push_back({curve, forward, is_edge ? face.uses.size() : no_position});
                if (is_edge) {
                    loop.push_back({uses[curve].edge, forward});
                    face.uses.push_back(uses[curve]);
                }
            }
            if (!loop.empty()) {
                face.loops.push_back(std::move(loop));
            }
        }
    }

    void read_solids() {
        for (const auto& [tag, faces] : solid_faces_) {
            SolidData solid;
            solid.tag = tag;
            solid.volume = model_.mass(3, tag);
            for (const int face : faces) {
                solid.faces.push_back({FaceId{static_cast<std::int32_t>(face_index_.at(face))}, true});
            }
            std::sort(solid.faces.begin(), solid.faces.end());
            orient_solid(model_, result_, solid);
            result_.solids.push_back(std::move(solid));
        }
    }

    const GmshModel& model_;
    GmshModel::Current current_;
    Topology result_;
    std::map<int, std::vector<int>> solid_faces_;
    std::map<int, std::vector<int>> face_edges_;
    std::map<int, std::vector<int>> edge_ends_;
    std::map<int, EdgeData> degenerate_;
    TagIndex vertex_index_;
    TagIndex edge_index_;
    TagIndex face_index_;
};

}  // namespace

Topology read_topology(const GmshModel& model) { return Reader(model).read(); }

}  // namespace pavior::detail
