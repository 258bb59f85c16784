#include "assemble.hpp"

#include <pavior/core/error.hpp>

#include "predicates.hpp"
#include "tet_faces.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <span>
#include <string>
#include <utility>

namespace pavior::detail {

namespace {

[[noreturn]] void fail(const std::string& reason) { throw Error(ErrorCode::tetrahedra_failed, reason); }

Vec3 normal_of(const Vec3& a, const Vec3& b, const Vec3& c) { return (b - a).cross(c - a); }

/// Altitude on the largest face by the longest edge; 0 for a flat one.
double flatness(const std::array<Vec3, 4>& x) {
    double face = 0.0;
    double edge = 0.0;
    for (const auto& f : tet_faces) {
        const auto at = [&](std::size_t k) -> const Vec3& { return x[static_cast<std::size_t>(f[k])]; };
        face = std::max(face, normal_of(at(0), at(1), at(2)).norm());
    }
    for (const auto& e : tet_edges) {
        edge = std::max(edge, (x[static_cast<std::size_t>(e[0])] - x[static_cast<std::size_t>(e[1])]).norm());
    }
    const double volume = std::abs(normal_of(x[0], x[1], x[2]).dot(x[3] - x[0]));
    return face > 0.0 ? volume / face / edge : 0.0;
}

/// Builds the mesh step by step; the steps run in the order in which they stand here.
class Assembler {
public:
    Assembler(const Problem& problem, const RawTets& raw) : problem_(problem), raw_(raw) {}

    Assembled run() {
        take_nodes();
        take_tets();
        const TetFaceTable faces(frame_nodes_.size(), tets_);
        if (faces.overused() != no_index) {
            fail("tetrahedra overlap at a face");
        }
        find_facets(faces);
        keep_inside(faces);
        collect_triangles(faces);
        drop_unused();
        collect_edges();
        check_surface_kept();
        check_volume();
        collect_vertices();
        return std::move(result_);
    }

private:
    [[nodiscard]] std::span<const Vec3> kept_nodes() const {
        return problem_.keep_nodes ? std::span<const Vec3>(problem_.surface->mesh.nodes) : std::span<const Vec3>();
    }

    void take_nodes() {
        const std::span<const Vec3> given = kept_nodes();
        const std::size_t count = raw_.nodes.size() / 3;
        if (count < given.size() || raw_.tets.empty()) {
            fail(raw_.tets.empty() ? "no tetrahedra" : "nodes of the surface are missing");
        }
        result_.mesh.mesh.nodes.assign(given.begin(), given.end());
        frame_nodes_.assign(problem_.plc.nodes.begin(),
                            problem_.plc.nodes.begin() + static_cast<std::ptrdiff_t>(given.size()));
        for (std::size_t i = given.size(); i < count; ++i) {
            frame_nodes_.emplace_back(raw_.nodes[3 * i], raw_.nodes[3 * i + 1], raw_.nodes[3 * i + 2]);
            result_.mesh.mesh.nodes.push_back(problem_.plc.frame.outside(frame_nodes_.back()));
        }
    }

    void take_tets() {
        const std::vector<Vec3>& nodes = result_.mesh.mesh.nodes;
        result_.flattest = std::numeric_limits<double>::infinity();
        for (std::size_t t = 0; 4 * t < raw_.tets.size(); ++t) {
            TetCorners c{};
            std::transform(raw_.tets.begin() + static_cast<std::ptrdiff_t>(4 * t),
                           raw_.tets.begin() + static_cast<std::ptrdiff_t>(4 * t + 4), c.begin(),
                           [](int id) { return static_cast<Index>(id); });
            if (*std::max_element(c.begin(), c.end()) >= nodes.size()) {
                fail("a tetrahedron names a node that does not exist");
            }
            const int sign = orientation(nodes[c[0]], nodes[c[1]], nodes[c[2]], nodes[c[3]]);
            if (sign == 0) {
                fail("a tetrahedron without volume");
            }
            if (sense_ == 0) {
                sense_ = sign;
            }
            if (sign != sense_) {
                fail("tetrahedra of both orientations");
            }
            if (sign < 0) {
                std::swap(c[2], c[3]);
            }
            tets_.push_back(c);
        }
    }

    [[nodiscard]] const FacetSource& source(int number) const {
        const auto at = static_cast<std::size_t>(number - first_number);
        if (number < first_number || at >= problem_.sources.size()) {
            fail("a facet that comes from nowhere");
        }
        return problem_.sources[at];
    }

    [[nodiscard]] TriCorners facet(std::size_t f) const {
        return {static_cast<Index>(raw_.facets[3 * f]), static_cast<Index>(raw_.facets[3 * f + 1]),
                static_cast<Index>(raw_.facets[3 * f + 2])};
    }

    /// Positions in \p numbers, those of smaller numbers first.
    [[nodiscard]] static std::vector<std::size_t> by_number(const std::vector<int>& numbers) {
        std::vector<std::size_t> order(numbers.size());
        for (std::size_t i = 0; i < order.size(); ++i) {
            order[i] = i;
        }
        std::stable_sort(order.begin(), order.end(),
                         [&](std::size_t a, std::size_t b) { return numbers[a] < numbers[b]; });
        return order;
    }

    /// Which facet lies on each face of a tetrahedron.
    void find_facets(const TetFaceTable& faces) {
        facet_on_.assign(4 * tets_.size(), -1);
        for (std::size_t f = 0; f < raw_.facet_numbers.size(); ++f) {
            const std::uint32_t face = faces.find(facet(f));
            if (face == no_index) {
                fail("a facet that is no face of a tetrahedron");
            }
            facet_on_[face] = static_cast<int>(f);
            if (faces.opposite(face) != no_index) {
                facet_on_[faces.opposite(face)] = static_cast<int>(f);
            }
        }
    }

    /// True if the tetrahedron of a face that carries a facet lies behind that facet.
    [[nodiscard]] bool behind(std::uint32_t face) const {
        if (!problem_.keep_nodes) {
            return true;  // a surface sampled anew comes with the tetrahedra behind it, and may bridge narrow gaps
        }
        const TriCorners c = tet_face(tets_[face / 4], face % 4);
        const int number = raw_.facet_numbers[static_cast<std::size_t>(facet_on_[face])];
        return normal_of(frame_nodes_[c[0]], frame_nodes_[c[1]], frame_nodes_[c[2]]).dot(source(number).normal) > 0.0;
    }

    [[nodiscard]] bool on_boundary(std::uint32_t face) const {
        const int f = facet_on_[face];
        return f >= 0 && !source(raw_.facet_numbers[static_cast<std::size_t>(f)]).inner;
    }

    /// Keeps what can be reached from behind the boundary without crossing it.
    void keep_inside(const TetFaceTable& faces) {
        std::vector<char> inside(tets_.size(), 0);
        std::vector<std::uint32_t> todo;
        const auto reach = [&](std::uint32_t tet) {
            if (inside[tet] == 0) {
                inside[tet] = 1;
                todo.push_back(tet);
            }
        };
        for (std::uint32_t face = 0; face < facet_on_.size(); ++face) {
            if (on_boundary(face) && behind(face)) {
                reach(face / 4);
            }
        }
        while (!todo.empty()) {
            const std::uint32_t tet = todo.back();
            todo.pop_back();
            for (std::uint32_t face = 4 * tet; face < 4 * tet + 4; ++face) {
                if (on_boundary(face)) {
                    if (!behind(face)) {
                        fail("the inside leaks out");
                    }
                } else if (faces.opposite(face) == no_index) {
                    fail("a face of the boundary lies on no facet");
                } else {
                    reach(faces.opposite(face) / 4);
                }
            }
        }
        inside_ = std::move(inside);
    }

    /// In the order of their numbers: those of the boundary first, and as the surface has them.
    void collect_triangles(const TetFaceTable& faces) {
        for (const std::size_t f : by_number(raw_.facet_numbers)) {
            const int number = raw_.facet_numbers[f];
            std::uint32_t face = faces.find(facet(f));
            if (!behind(face)) {
                face = faces.opposite(face);
            }
            if (face == no_index || !behind(face) || inside_[face / 4] == 0) {
                fail("a facet without a tetrahedron behind it");
            }
            result_.mesh.triangles.push_back({tet_face(tets_[face / 4], face % 4), source(number).tag});
            numbers_.push_back(number);
        }
    }

    /// Drops tetrahedra outside and added nodes that only those use.
    void drop_unused() {
        std::vector<Vec3>& nodes = result_.mesh.mesh.nodes;
        const std::size_t given = kept_nodes().size();
        std::vector<char> used(nodes.size(), 0);
        std::fill(used.begin(), used.begin() + static_cast<std::ptrdiff_t>(given), char{1});
        for (std::size_t t = 0; t < tets_.size(); ++t) {
            for (const Index node : tets_[t]) {
                used[node] = static_cast<char>(used[node] | inside_[t]);
            }
        }
        number_of_.resize(nodes.size());
        Index next = 0;
        for (std::size_t i = 0; i < nodes.size(); ++i) {
            number_of_[i] = next;
            nodes[next] = nodes[i];
            frame_nodes_[next] = frame_nodes_[i];
            next += static_cast<Index>(used[i]);
        }
        nodes.resize(next);
        frame_nodes_.resize(next);
        for (std::size_t t = 0; t < tets_.size(); ++t) {
            if (inside_[t] != 0) {
                result_.mesh.mesh.tets.push_back(renumbered(tets_[t]));
            }
        }
        for (TaggedTriangle& triangle : result_.mesh.triangles) {
            triangle.nodes = renumbered(triangle.nodes);
        }
    }

    template <class Corners>
    [[nodiscard]] Corners renumbered(Corners corners) const {
        for (Index& node : corners) {
            node = number_of_[node];
        }
        return corners;
    }

    void collect_edges() {
        if (problem_.keep_surface) {
            result_.mesh.edges = problem_.surface->edges;
            return;
        }
        for (const std::size_t e : by_number(raw_.edge_numbers)) {
            const auto at = static_cast<std::size_t>(raw_.edge_numbers[e] - first_number);
            if (raw_.edge_numbers[e] >= first_number && at < problem_.surface->edges.size()) {
                const std::array<Index, 2> nodes{static_cast<Index>(raw_.edges[2 * e]),
                                                 static_cast<Index>(raw_.edges[2 * e + 1])};
                result_.mesh.edges.push_back({renumbered(nodes), problem_.surface->edges[at].tag});
            }
        }
        check_edge_lengths();
    }

    void collect_vertices() {
        if (problem_.keep_nodes) {
            result_.mesh.vertices = problem_.surface->vertices;
            return;
        }
        std::map<std::array<double, 3>, Index> at;
        for (Index i = 0; i < frame_nodes_.size(); ++i) {
            at.emplace(std::array{frame_nodes_[i].x(), frame_nodes_[i].y(), frame_nodes_[i].z()}, i);
        }
        for (const TaggedNode& vertex : problem_.surface->vertices) {
            const Vec3& x = problem_.plc.nodes[vertex.node];
            const auto found = at.find({x.x(), x.y(), x.z()});
            if (found == at.end()) {
                fail("a tagged vertex got lost");
            }
            result_.mesh.vertices.push_back({found->second, vertex.tag});
            result_.mesh.mesh.nodes[found->second] = problem_.surface->mesh.nodes[vertex.node];
        }
    }

    /// The pieces of the tagged edges must be as long as those were.
    void check_edge_lengths() const {
        const auto total = [](const std::vector<TaggedEdge>& edges, const std::vector<Vec3>& nodes) {
            double sum = 0.0;
            for (const TaggedEdge& edge : edges) {
                sum += (nodes[edge.nodes[0]] - nodes[edge.nodes[1]]).norm();
            }
            return sum;
        };
        const double given = total(problem_.surface->edges, problem_.plc.nodes);
        if (std::abs(total(result_.mesh.edges, frame_nodes_) - given) > problem_.tolerance * given) {
            fail("tagged edges got lost");
        }
    }

    void check_surface_kept() const {
        if (!problem_.keep_surface) {
            return;
        }
        std::vector<char> seen(problem_.sources.size(), 0);
        for (std::size_t i = 0; i < numbers_.size(); ++i) {
            const auto at = static_cast<std::size_t>(numbers_[i] - first_number);
            TriCorners given = problem_.plc.facets[at];
            TriCorners made = result_.mesh.triangles[i].nodes;
            std::sort(given.begin(), given.end());
            std::sort(made.begin(), made.end());
            if (given != made || std::exchange(seen[at], char{1}) != 0) {
                fail("a triangle of the surface was split");
            }
        }
        if (numbers_.size() != seen.size()) {
            fail("triangles of the surface are missing");
        }
    }

    void check_volume() {
        double inside = 0.0;
        for (const TetCorners& c : result_.mesh.mesh.tets) {
            const std::array<Vec3, 4> y{frame_nodes_[c[0]], frame_nodes_[c[1]], frame_nodes_[c[2]], frame_nodes_[c[3]]};
            inside += normal_of(y[0], y[1], y[2]).dot(y[3] - y[0]);
            result_.flattest = std::min(result_.flattest, flatness(y));
        }
        double given = 0.0;
        double scale = 0.0;
        const std::vector<Vec3>& x = problem_.plc.nodes;
        for (const TriCorners& c : problem_.surface->mesh.triangles) {
            const double part = normal_of(x[c[0]], x[c[1]], x[c[2]]).dot(x[c[0]] - x[0]);
            given += part;
            scale += std::abs(part);
        }
        if (!(std::abs(inside - given) <= problem_.tolerance * scale)) {
            fail("the tetrahedra do not fill the surface");
        }
    }

    const Problem& problem_;
    const RawTets& raw_;
    Assembled result_;
    std::vector<Vec3> frame_nodes_;
    std::vector<TetCorners> tets_;
    std::vector<int> facet_on_;
    std::vector<char> inside_;
    std::vector<int> numbers_;
    std::vector<Index> number_of_;
    int sense_ = 0;
};

}  // namespace

Assembled assemble(const Problem& problem, const RawTets& raw) { return Assembler(problem, raw).run(); }

}  // namespace pavior::detail
