#include "plane_quads.hpp"

#include "gmsh_model.hpp"
#include "gmsh_options.hpp"

#include <pavior/mesh/boundary_loops.hpp>
#include <pavior/mesh/span_mesh.hpp>
#include <pavior/mesh/verify_quads.hpp>
#include <pavior/sweep/transfinite.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace pavior::detail {

namespace {

double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

/// The loops as points, straight lines of one interval, and a plane surface; point i has tag i + 1.
void make_region(const PlaneLoops& loops) {
    for (std::size_t i = 0; i < loops.points.size(); ++i) {
        gmsh::model::geo::addPoint(loops.points[i].x(), loops.points[i].y(), 0, 0, static_cast<int>(i) + 1);
    }
    std::vector<int> curve_loops;
    for (std::size_t l = 0; l < loops.size(); ++l) {
        std::vector<int> lines;
        for (std::size_t i = loops.offsets[l]; i < loops.offsets[l + 1]; ++i) {
            const auto a = static_cast<int>(i) + 1;
            const auto b = static_cast<int>(loops.next(l, i)) + 1;
            lines.push_back(gmsh::model::geo::addLine(a, b, a));
            gmsh::model::geo::mesh::setTransfiniteCurve(a, 2);
        }
        curve_loops.push_back(gmsh::model::geo::addCurveLoop(lines));
    }
    gmsh::model::geo::addPlaneSurface(curve_loops, 1);
    gmsh::model::geo::synchronize();
}

double shortest_edge(const PlaneLoops& loops) {
    double shortest = std::numeric_limits<double>::infinity();
    for (std::size_t l = 0; l < loops.size(); ++l) {
        for (std::size_t i = loops.offsets[l]; i < loops.offsets[l + 1]; ++i) {
            shortest = std::min(shortest, (loops.points[loops.next(l, i)] - loops.points[i]).norm());
        }
    }
    return std::max(shortest, 1e-12);
}

/// Elements of the surface in our numbering; false if a node of the boundary is missing.
struct RawMesh {
    std::vector<Vec2> nodes;
    std::vector<std::array<Index, 3>> triangles;
    std::vector<QuadCorners> quads;
};

bool read_nodes(const PlaneLoops& loops, RawMesh& mesh, std::vector<std::pair<std::size_t, Index>>& index) {
    mesh.nodes = loops.points;
    std::vector<std::size_t> tags;
    std::vector<double> x;
    std::vector<double> parameters;
    for (std::size_t i = 0; i < loops.points.size(); ++i) {
        gmsh::model::mesh::getNodes(tags, x, parameters, 0, static_cast<int>(i) + 1, false, false);
        if (tags.size() != 1) {
            return false;
        }
        index.emplace_back(tags[0], static_cast<Index>(i));
    }
    gmsh::model::mesh::getNodes(tags, x, parameters, 1, -1, false, false);
    if (!tags.empty()) {
        return false;
    }
    gmsh::model::mesh::getNodes(tags, x, parameters, 2, 1, false, false);
    for (std::size_t i = 0; i < tags.size(); ++i) {
        index.emplace_back(tags[i], static_cast<Index>(mesh.nodes.size()));
        mesh.nodes.emplace_back(x[3 * i], x[3 * i + 1]);
    }
    std::sort(index.begin(), index.end());
    return true;
}

template <std::size_t N>
bool read_cells(int type, const std::vector<std::pair<std::size_t, Index>>& index,
                std::vector<std::array<Index, N>>& cells) {
    std::vector<std::size_t> tags;
    std::vector<std::size_t> nodes;
    gmsh::model::mesh::getElementsByType(type, tags, nodes, 1);
    for (std::size_t i = 0; i + N <= nodes.size(); i += N) {
        std::array<Index, N> cell{};
        for (std::size_t k = 0; k < N; ++k) {
            const auto at = std::lower_bound(index.begin(), index.end(), std::pair(nodes[i + k], Index{0}));
            if (at == index.end() || at->first != nodes[i + k]) {
                return false;
            }
            cell[k] = at->second;
        }
        cells.push_back(cell);
    }
    return true;
}

template <std::size_t N>
void turn_left(const std::vector<Vec2>& nodes, std::vector<std::array<Index, N>>& cells) {
    double twice = 0;
    for (const auto& cell : cells) {
        for (std::size_t k = 1; k + 1 < N; ++k) {
            twice += cross(nodes[cell[k]] - nodes[cell[0]], nodes[cell[k + 1]] - nodes[cell[0]]);
        }
    }
    if (twice < 0) {
        for (auto& cell : cells) {
            std::reverse(cell.begin() + 1, cell.end());
        }
    }
}

std::optional<RawMesh> meshed(const PlaneLoops& loops, double size, const QuadRecipe* recipe) {
    const GmshSession session;
    const Hush hush;
    try {
        GmshOptions options;
        set_mesh_options(options, size, 0.1 * shortest_edge(loops));
        options.set("Mesh.RandomFactor", 1e-9);
        options.set("Mesh.Algorithm", recipe != nullptr ? recipe->algorithm : 6);
        options.set("Mesh.MeshSizeFactor", recipe != nullptr ? recipe->scale : 1);
        options.set("Mesh.Smoothing", recipe != nullptr ? recipe->smoothing : 1);
        options.set("Mesh.RecombinationAlgorithm", 1);
        options.set("Mesh.RecombineOptimizeTopology", recipe != nullptr ? recipe->topology : 0);
        const GmshScratchModel model("pavior cap");
        make_region(loops);
        if (recipe != nullptr) {
            gmsh::model::mesh::setRecombine(2, 1);
        }
        gmsh::model::mesh::generate(2);
        gmsh::vectorpair failed;
        gmsh::model::mesh::getLastEntityError(failed);
        if (!failed.empty()) {
            return std::nullopt;
        }
        RawMesh mesh;
        std::vector<std::pair<std::size_t, Index>> index;
        if (!read_nodes(loops, mesh, index) || !read_cells(2, index, mesh.triangles) ||
            !read_cells(3, index, mesh.quads)) {
            return std::nullopt;
        }
        turn_left(mesh.nodes, mesh.triangles);
        turn_left(mesh.nodes, mesh.quads);
        return mesh;
    } catch (const Error&) {
        throw;
    } catch (...) {
        return std::nullopt;
    }
}

/// Every boundary edge borders one quad, every inner edge two, every node is used.
bool fits(const PlaneLoops& loops, const PlaneQuads& mesh) {
    std::vector<Vec3> points;
    std::transform(mesh.nodes.begin(), mesh.nodes.end(), std::back_inserter(points),
                   [](const Vec2& p) { return Vec3(p.x(), p.y(), 0); });
    const QuadMesh quads{std::move(points), mesh.quads};
    if (mesh.quads.empty() || !verify_quads(quads).ok()) {
        return false;
    }
    const Loops found = boundary_loops(quads);
    if (found.size() != loops.size() || found.nodes.size() != loops.points.size()) {
        return false;
    }
    for (std::size_t l = 0; l < loops.size(); ++l) {
        const auto loop = found[l];
        if (loop.size() != loops.offsets[l + 1] - loops.offsets[l]) {
            return false;
        }
        for (std::size_t i = 0; i < loop.size(); ++i) {
            if (loop[i] != loops.offsets[l] + i) {
                return false;
            }
        }
    }
    return true;
}

/// Positions of the four corners of a single loop, if it has just four.
std::vector<std::size_t> find_corners(const PlaneLoops& loops) {
    constexpr double corner_angle = 0.7 * std::numbers::pi;
    const std::size_t n = loops.points.size();
    std::vector<std::size_t> corners;
    for (std::size_t i = 0; i < n; ++i) {
        const Vec2 after = loops.points[(i + 1) % n] - loops.points[i];
        const Vec2 before = loops.points[(i + n - 1) % n] - loops.points[i];
        double angle = std::atan2(cross(after, before), after.dot(before));
        angle = angle < 0 ? angle + 2 * std::numbers::pi : angle;
        if (angle < corner_angle) {
            corners.push_back(i);
        }
    }
    return corners;
}

}  // namespace

double smallest_corner(std::span<const Vec2> nodes, std::span<const QuadCorners> quads) {
    double smallest = 1;
    for (const QuadCorners& q : quads) {
        for (std::size_t k = 0; k < 4; ++k) {
            const Vec2 a = nodes[q[(k + 1) % 4]] - nodes[q[k]];
            const Vec2 b = nodes[q[(k + 3) % 4]] - nodes[q[k]];
            const double lengths = a.norm() * b.norm();
            smallest = std::min(smallest, lengths > 0 ? cross(a, b) / lengths : 0.0);
        }
    }
    return smallest;
}

std::optional<PlaneQuads> grid_quads(const PlaneLoops& loops) {
    const std::vector<std::size_t> corners = loops.size() == 1 ? find_corners(loops) : std::vector<std::size_t>{};
    const std::size_t n = loops.points.size();
    if (corners.size() != 4) {
        return std::nullopt;
    }
    std::array<std::vector<std::size_t>, 4> ids;  // along the loop
    for (std::size_t k = 0; k < 4; ++k) {
        for (std::size_t i = corners[k];; i = (i + 1) % n) {
            ids[k].push_back(i);
            if (i == corners[(k + 1) % 4]) {
                break;
            }
        }
    }
    if (ids[0].size() != ids[2].size() || ids[1].size() != ids[3].size()) {
        return std::nullopt;
    }
    std::reverse(ids[2].begin(), ids[2].end());
    std::reverse(ids[3].begin(), ids[3].end());
    std::array<std::vector<Vec2>, 4> sides;
    for (std::size_t k = 0; k < 4; ++k) {
        std::transform(ids[k].begin(), ids[k].end(), std::back_inserter(sides[k]),
                       [&](std::size_t i) { return loops.points[i]; });
    }
    const StructuredGrid<Vec2> grid =
        transfinite<Vec2>({sides[0], sides[2], sides[3], sides[1]}, {Blending::arc_length, 1e-8});
    PlaneQuads mesh{loops.points, {}};
    std::vector<Index> number(grid.nodes.size());
    for (std::size_t k = 0; k <= grid.rows; ++k) {
        for (std::size_t i = 0; i <= grid.columns; ++i) {
            const bool at_side = i == 0 || k == 0 || i == grid.columns || k == grid.rows;
            Index& id = number[grid.index(i, k)];
            if (at_side) {
                id = static_cast<Index>(k == 0           ? ids[0][i]
                                        : k == grid.rows ? ids[2][i]
                                        : i == 0         ? ids[3][k]
                                                         : ids[1][k]);
            } else {
                id = static_cast<Index>(mesh.nodes.size());
                mesh.nodes.push_back(grid(i, k));
            }
        }
    }
    for (QuadCorners quad : structured_quads(grid.columns, grid.rows)) {
        std::transform(quad.begin(), quad.end(), quad.begin(), [&](Index i) { return number[i]; });
        mesh.quads.push_back(quad);
    }
    return mesh;
}

std::optional<PlaneQuads> recombined_quads(const PlaneLoops& loops, double size, const QuadRecipe& recipe) {
    std::optional<RawMesh> raw = meshed(loops, size, &recipe);
    if (!raw || !raw->triangles.empty()) {
        return std::nullopt;
    }
    PlaneQuads mesh{std::move(raw->nodes), std::move(raw->quads)};
    if (!fits(loops, mesh)) {
        return std::nullopt;
    }
    return mesh;
}

namespace {

/// Every second node of each loop.
PlaneLoops halved(const PlaneLoops& loops, std::size_t first) {
    PlaneLoops half;
    for (std::size_t l = 0; l < loops.size(); ++l) {
        for (std::size_t i = loops.offsets[l] + first; i < loops.offsets[l + 1]; i += 2) {
            half.points.push_back(loops.points[i]);
        }
        half.offsets.push_back(half.points.size());
    }
    return half;
}

/// Nodes of the fine mesh at the middles of the edges of the coarse one.
class EdgeMiddles {
public:
    EdgeMiddles(const std::vector<Index>& number, std::vector<Vec2>& nodes) : number_(number), nodes_(nodes) {}

    void add(Index a, Index b, Index middle) { middles_.emplace_back(std::minmax(a, b), middle); }
    void sort() { std::sort(middles_.begin(), middles_.end()); }

    /// The middle of a boundary edge, if it is one.
    [[nodiscard]] std::optional<Index> find(Index a, Index b) const {
        const std::pair<Index, Index> key = std::minmax(a, b);
        const auto at = std::lower_bound(middles_.begin(), middles_.end(), std::pair(key, Index{0}));
        return at != middles_.end() && at->first == key ? std::optional(at->second) : std::nullopt;
    }
    /// Adds middles for all edges of the triangles that have none.
    void complete(const std::vector<std::array<Index, 3>>& triangles) {
        std::vector<std::pair<Index, Index>> missing;
        for (const auto& t : triangles) {
            for (std::size_t k = 0; k < 3; ++k) {
                if (!find(t[k], t[(k + 1) % 3])) {
                    missing.push_back(std::minmax(t[k], t[(k + 1) % 3]));
                }
            }
        }
        std::sort(missing.begin(), missing.end());
        missing.erase(std::unique(missing.begin(), missing.end()), missing.end());
        for (const auto& [a, b] : missing) {
            middles_.push_back({{a, b}, static_cast<Index>(nodes_.size())});
            nodes_.emplace_back(0.5 * (nodes_[number_[a]] + nodes_[number_[b]]));
        }
        sort();
    }

private:
    const std::vector<Index>& number_;
    std::vector<Vec2>& nodes_;
    std::vector<std::pair<std::pair<Index, Index>, Index>> middles_;
};

}  // namespace

std::optional<PlaneQuads> subdivided_triangles(const PlaneLoops& loops, double size, std::size_t first) {
    for (std::size_t l = 0; l < loops.size(); ++l) {
        const std::size_t n = loops.offsets[l + 1] - loops.offsets[l];
        if (n % 2 != 0 || n < 6) {
            return std::nullopt;
        }
    }
    const PlaneLoops half = halved(loops, first);
    const std::optional<RawMesh> coarse = meshed(half, 2 * size, nullptr);
    if (!coarse) {
        return std::nullopt;
    }
    PlaneQuads mesh{loops.points, {}};
    std::vector<Index> number(coarse->nodes.size());  // coarse node -> fine node
    EdgeMiddles middles(number, mesh.nodes);
    for (std::size_t l = 0; l < half.size(); ++l) {
        for (std::size_t i = half.offsets[l]; i < half.offsets[l + 1]; ++i) {
            const std::size_t fine = loops.offsets[l] + first + 2 * (i - half.offsets[l]);
            number[i] = static_cast<Index>(fine);
            middles.add(static_cast<Index>(i), static_cast<Index>(half.next(l, i)),
                        static_cast<Index>(loops.next(l, fine)));
        }
    }
    middles.sort();
    for (std::size_t i = half.points.size(); i < coarse->nodes.size(); ++i) {
        number[i] = static_cast<Index>(mesh.nodes.size());
        mesh.nodes.push_back(coarse->nodes[i]);
    }
    middles.complete(coarse->triangles);
    for (const auto& t : coarse->triangles) {
        const auto centre = static_cast<Index>(mesh.nodes.size());
        mesh.nodes.emplace_back((coarse->nodes[t[0]] + coarse->nodes[t[1]] + coarse->nodes[t[2]]) / 3);
        for (std::size_t k = 0; k < 3; ++k) {
            mesh.quads.push_back(
                {number[t[k]], *middles.find(t[k], t[(k + 1) % 3]), centre, *middles.find(t[(k + 2) % 3], t[k])});
        }
    }
    return fits(loops, mesh) ? std::optional(mesh) : std::nullopt;
}

PlaneQuads pillowed(const PlaneQuads& quads, const PlaneLoops& loops) {
    constexpr double depth = 0.15;  // of the shorter of two neighbouring boundary edges
    PlaneQuads mesh = quads;
    const std::size_t n = loops.points.size();
    std::vector<Index> inner(n);
    for (std::size_t l = 0; l < loops.size(); ++l) {
        std::size_t before = loops.offsets[l + 1] - 1;
        for (std::size_t i = loops.offsets[l]; i < loops.offsets[l + 1]; before = i++) {
            const Vec2 out = loops.points[loops.next(l, i)] - loops.points[i];
            const Vec2 in = loops.points[before] - loops.points[i];
            const double angle = std::atan2(cross(out, in), out.dot(in));
            const double half = 0.5 * (angle < 0 ? angle + 2 * std::numbers::pi : angle);
            const Vec2 along = depth * std::min(out.norm(), in.norm()) * out.normalized();
            inner[i] = static_cast<Index>(mesh.nodes.size());
            mesh.nodes.push_back(loops.points[i] + std::cos(half) * along +
                                 std::sin(half) * Vec2(-along.y(), along.x()));
        }
    }
    for (QuadCorners& quad : mesh.quads) {
        for (Index& i : quad) {
            i = i < n ? inner[i] : i;
        }
    }
    for (std::size_t l = 0; l < loops.size(); ++l) {
        for (std::size_t i = loops.offsets[l]; i < loops.offsets[l + 1]; ++i) {
            const std::size_t next = loops.next(l, i);
            mesh.quads.push_back({static_cast<Index>(i), static_cast<Index>(next), inner[next], inner[i]});
        }
    }
    return mesh;
}

}  // namespace pavior::detail
