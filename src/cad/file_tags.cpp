#include "file_tags.hpp"

#include "entities_at.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <set>
#include <utility>

namespace pavior::detail {

namespace {

/// By tag of a piece, the solids of the file that it is a piece of; first the one that is nothing but this piece.
std::map<int, std::vector<int>> solids_of_pieces(const SolidPieces& pieces) {
    std::map<int, std::vector<int>> result;
    for (const bool whole : {true, false}) {
        for (const auto& [solid, own] : pieces.pieces) {
            for (const int piece : (own.size() == 1) == whole ? own : std::vector<int>{}) {
                result[piece].push_back(solid);
            }
        }
    }
    return result;
}

/// Edges and vertices are told apart by their tags: one of several with the same keeps it, others get new ones.
void make_unique(std::vector<std::vector<int>>& tags, int last) {
    std::set<int> used;
    for (std::vector<int>& own : tags) {
        const auto free = std::find_if(own.begin(), own.end(), [&](int tag) { return !used.contains(tag); });
        if (free == own.end()) {
            own.insert(own.begin(), ++last);
        } else {
            std::rotate(own.begin(), free, free + 1);
        }
        used.insert(own.front());
    }
}

Vec3 middle_of(const GmshModel& model, const EdgeData& edge) {
    std::array<Vec3, 1> x;
    model.edge_points(edge.tag, std::array{0.5 * (edge.range[0] + edge.range[1])}, x);
    return x[0];
}

/// A point of a face, and the unit normal there.
struct FacePoint {
    Vec3 x, normal;
};

/// Points inside a face: on a grid of its parameters, and its own inner point.
std::vector<FacePoint> points_inside(const GmshModel& model, const FaceData& face) {
    std::vector<Vec2> uv{face.interior};
    constexpr int grid = 6;
    for (int i = 1; i < grid; ++i) {
        for (int j = 1; j < grid; ++j) {
            const Vec2 at = face.bounds[0] + (face.bounds[1] - face.bounds[0]).cwiseProduct(Vec2(i, j) / grid);
            if (model.inside_face(face.tag, at)) {
                uv.push_back(at);
            }
        }
    }
    std::vector<Vec3> points(uv.size());
    std::vector<std::array<Vec3, 2>> derivatives(uv.size());
    model.face_points(face.tag, uv, points);
    model.face_derivatives(face.tag, uv, derivatives);
    std::vector<FacePoint> result;
    for (std::size_t i = 0; i < uv.size(); ++i) {
        result.push_back({points[i], derivatives[i][0].cross(derivatives[i][1]).normalized()});
    }
    return result;
}

/// The least distance, not 0, of points of a face from \p other where their feet are inside that and both faces look
/// across the gap.
std::optional<double> gap_between(const GmshModel& model, std::span<const FacePoint> points, const FaceData& other,
                                  const EntityBox& box, double near, double zero) {
    std::optional<double> least;
    for (const auto& [x, normal] : points) {
        Vec2 uv;
        if (!box.holds(x, near) || !model.project_on_face(other.tag, x, uv) || !model.inside_face(other.tag, uv)) {
            continue;
        }
        std::array<Vec3, 1> foot;
        model.face_points(other.tag, std::array{uv}, foot);
        const Vec3 gap = foot[0] - x;
        const double distance = gap.norm();
        if (distance > zero && distance <= near && std::abs(gap.dot(normal)) > 0.9 * distance &&
            distance < least.value_or(near * 2)) {
            least = distance;
        }
    }
    return least;
}

std::vector<SolidOverlap> overlaps_of(const SolidPieces& pieces, const std::map<int, std::vector<int>>& solids_of,
                                      const std::map<int, double>& volume_of_piece) {
    std::map<std::pair<int, int>, double> common;
    for (const auto& [piece, solids] : solids_of) {
        for (const int a : solids) {
            for (const int b : solids) {
                if (a < b) {
                    common[{a, b}] += volume_of_piece.at(piece);
                }
            }
        }
    }
    std::vector<SolidOverlap> result;
    for (const auto& [pair, volume] : common) {
        const auto all_of = [&pieces, shared = volume](int solid) {
            return shared >= (1 - 1e-6) * pieces.volume.at(solid);
        };
        const auto [a, b] = pair;
        SolidOverlap overlap{{a, b}, OverlapKind::overlap, volume};
        if (all_of(a) && all_of(b)) {
            overlap.kind = OverlapKind::duplicate;
        } else if (all_of(a) || all_of(b)) {
            overlap.kind = OverlapKind::nested;
            overlap.solids = all_of(b) ? std::array{a, b} : std::array{b, a};
        }
        result.push_back(overlap);
    }
    return result;
}

std::vector<SolidGap> gaps_of(const GmshModel& model, const Topology& topology,
                              const std::map<int, std::vector<int>>& solids_of, double near) {
    struct Outer {
        std::size_t solid;
        const FaceData* face;
        EntityBox box;
        std::vector<FacePoint> points;
    };
    std::vector<int> uses(topology.faces.size(), 0);
    for (const SolidData& solid : topology.solids) {
        for (const OrientedFace& f : solid.faces) {
            ++uses[f.face.index()];
        }
    }
    std::vector<Outer> outer;
    for (std::size_t s = 0; s < topology.solids.size(); ++s) {
        for (const OrientedFace& f : topology.solids[s].faces) {
            const FaceData& face = topology.faces[f.face.index()];
            if (uses[f.face.index()] == 1) {
                outer.push_back({s, &face, EntityBox(2, face.tag), {}});
            }
        }
    }
    std::map<std::pair<int, int>, double> least;
    for (Outer& a : outer) {
        for (const Outer& b : outer) {
            if (a.solid == b.solid || !a.box.near(b.box, near)) {
                continue;
            }
            if (a.points.empty()) {
                a.points = points_inside(model, *a.face);
            }
            const double zero = 1e-9 * topology.diagonal;
            if (const auto gap = gap_between(model, a.points, *b.face, b.box, near, zero)) {
                const std::pair<int, int> solids = std::minmax({solids_of.at(topology.solids[a.solid].tag).front(),
                                                                solids_of.at(topology.solids[b.solid].tag).front()});
                const auto [at, first] = least.emplace(solids, *gap);
                at->second = std::min(at->second, *gap);
            }
        }
    }
    std::vector<SolidGap> gaps;
    for (const auto& [solids, distance] : least) {
        if (solids.first != solids.second) {
            gaps.push_back({{solids.first, solids.second}, distance});
        }
    }
    return gaps;
}

}  // namespace

std::array<std::vector<std::vector<int>>, 4> file_tags(const GmshModel& model, const Topology& topology,
                                                       const SolidPieces& pieces, const std::function<void()>& populate,
                                                       double tolerance) {
    const GmshModel file;
    {
        const GmshModel::Current there(file);
        populate();
    }
    const EntitiesAt original(file, tolerance);
    const GmshModel::Current current(model);
    std::array<std::vector<std::vector<int>>, 4> tags;
    for (const Vec3& x : topology.vertices) {
        tags[0].push_back(original.at(0, x));
    }
    for (const EdgeData& edge : topology.edges) {
        tags[1].push_back(original.at(1, middle_of(model, edge)));
    }
    int last = original.last(2);
    for (const FaceData& face : topology.faces) {
        std::array<Vec3, 1> x;
        model.face_points(face.tag, std::array{face.interior}, x);
        tags[2].push_back(original.at(2, x[0]));
        if (tags[2].back().empty()) {
            tags[2].back() = {++last};
        }
    }
    make_unique(tags[0], original.last(0));
    make_unique(tags[1], original.last(1));
    const auto solids_of = solids_of_pieces(pieces);
    for (const SolidData& solid : topology.solids) {
        tags[3].push_back(solids_of.at(solid.tag));
    }
    return tags;
}

ImprintReport imprint_report(const GmshModel& model, const Topology& topology, const SolidPieces& pieces, double near) {
    const GmshModel::Current current(model);
    const auto solids_of = solids_of_pieces(pieces);
    std::map<int, double> volume;
    ImprintReport report;
    for (const SolidData& solid : topology.solids) {
        volume[solid.tag] = solid.volume;
        double area = 0;
        for (const OrientedFace& f : solid.faces) {
            area += topology.faces[f.face.index()].area;
        }
        std::vector<int> solids = solids_of.at(solid.tag);
        const bool cut =
            std::any_of(solids.begin(), solids.end(), [&](int tag) { return pieces.pieces.at(tag).size() > 1; });
        std::sort(solids.begin(), solids.end());
        if (cut && area > 0) {
            report.pieces.push_back({std::move(solids), 2 * solid.volume / area});
        }
    }
    std::stable_sort(report.pieces.begin(), report.pieces.end(),
                     [](const SolidPiece& a, const SolidPiece& b) { return a.thickness < b.thickness; });
    report.overlaps = overlaps_of(pieces, solids_of, volume);
    report.gaps = gaps_of(model, topology, solids_of, near);
    return report;
}

}  // namespace pavior::detail
