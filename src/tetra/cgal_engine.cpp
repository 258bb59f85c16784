#include "cgal_engine.hpp"

#include <pavior/core/disjoint_sets.hpp>
#include <pavior/core/error.hpp>

#include "facet_edges.hpp"
#include "feature_chains.hpp"

#include <CGAL/AABB_face_graph_triangle_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Mesh_complex_3_in_triangulation_3.h>
#include <CGAL/Mesh_criteria_3.h>
#include <CGAL/Mesh_domain_with_polyline_features_3.h>
#include <CGAL/Mesh_triangulation_3.h>
#include <CGAL/Polyhedral_mesh_domain_3.h>
#include <CGAL/Random.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/make_mesh_3.h>

#include <cmath>
#include <map>
#include <string>

namespace pavior::detail {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Surface = CGAL::Surface_mesh<Point>;
using Domain = CGAL::Mesh_domain_with_polyline_features_3<CGAL::Polyhedral_mesh_domain_3<Surface, Kernel>>;
using Triangulation = CGAL::Mesh_triangulation_3<Domain>::type;
using Complex = CGAL::Mesh_complex_3_in_triangulation_3<Triangulation, Domain::Corner_index, Domain::Curve_index>;
using Criteria = CGAL::Mesh_criteria_3<Triangulation>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, CGAL::AABB_face_graph_triangle_primitive<Surface>>>;

Point to_point(const Vec3& x) { return {x.x(), x.y(), x.z()}; }

Surface make_surface(const Plc& plc) {
    Surface surface;
    std::vector<Surface::Vertex_index> at;
    for (const Vec3& x : plc.nodes) {
        at.push_back(surface.add_vertex(to_point(x)));
    }
    for (const TriCorners& c : plc.facets) {
        if (surface.add_face(at[c[0]], at[c[1]], at[c[2]]) == Surface::null_face()) {
            throw Error(ErrorCode::tetrahedra_failed, "CGAL does not take the surface");
        }
    }
    return surface;
}

/// Gives each shell without a curve or corner a corner: the refinement would not find it otherwise.
void add_missing_corners(const Plc& plc, const std::vector<FeatureChain>& chains, Domain& domain) {
    DisjointSets shells(plc.nodes.size());
    for (const TriCorners& c : plc.facets) {
        shells.unite(c[0], c[1]);
        shells.unite(c[0], c[2]);
    }
    std::vector<char> found(plc.nodes.size(), 0);
    for (const FeatureChain& chain : chains) {
        found[shells.root(chain.nodes.front())] = 1;
    }
    for (Index i = 0; i < plc.nodes.size(); ++i) {
        if (shells.root(i) == i && found[i] == 0) {
            domain.add_corner(to_point(plc.nodes[i]));
        }
    }
}

/// The number of each curve of the domain.
std::map<Domain::Curve_index, int> add_chains(const Problem& problem, double degrees, Domain& domain) {
    std::map<Domain::Curve_index, int> numbers;
    const std::vector<FeatureChain> chains = feature_chains(problem, degrees);
    add_missing_corners(problem.plc, chains, domain);
    for (const FeatureChain& chain : chains) {
        std::vector<std::vector<Point>> lines(1);
        for (const Index node : chain.nodes) {
            lines[0].push_back(to_point(problem.plc.nodes[node]));
        }
        std::vector<Domain::Curve_index> index;
        domain.add_features(lines.begin(), lines.end(), std::back_inserter(index));
        numbers[index.at(0)] = chain.number;
    }
    for (const TaggedNode& vertex : problem.surface->vertices) {
        domain.add_corner(to_point(problem.plc.nodes[vertex.node]));
    }
    return numbers;
}

/// Reads the complex; points get their numbers in the order in which the tetrahedra name them.
class Reader {
public:
    explicit Reader(const Complex& complex) : complex_(complex) {}

    RawTets read(const Surface& surface, const std::map<Domain::Curve_index, int>& curves) {
        for (auto cell = complex_.cells_in_complex_begin(); cell != complex_.cells_in_complex_end(); ++cell) {
            for (int i = 0; i < 4; ++i) {
                raw_.tets.push_back(number(cell->vertex(i)));
            }
        }
        const Tree tree(faces(surface).first, faces(surface).second, surface);
        for (auto f = complex_.facets_in_complex_begin(); f != complex_.facets_in_complex_end(); ++f) {
            std::array<Point, 3> x;
            for (int k = 0; k < 3; ++k) {
                const auto vertex = f->first->vertex((f->second + 1 + k) % 4);
                raw_.facets.push_back(number(vertex));
                x[static_cast<std::size_t>(k)] = vertex->point().point();
            }
            const auto nearest = tree.closest_point_and_primitive(CGAL::centroid(x[0], x[1], x[2])).second;
            raw_.facet_numbers.push_back(first_number + static_cast<int>(static_cast<Surface::size_type>(nearest)));
        }
        for (auto e = complex_.edges_in_complex_begin(); e != complex_.edges_in_complex_end(); ++e) {
            const auto a = e->first->vertex(e->second);
            const auto b = e->first->vertex(e->third);
            raw_.edges.insert(raw_.edges.end(), {number(a), number(b)});
            raw_.edge_numbers.push_back(curves.at(complex_.curve_index(a, b)));
        }
        return std::move(raw_);
    }

private:
    int number(Triangulation::Vertex_handle vertex) {
        const auto [at, added] = numbers_.emplace(&*vertex, static_cast<int>(numbers_.size()));
        if (added) {
            const auto& x = vertex->point();
            raw_.nodes.insert(raw_.nodes.end(), {x.x(), x.y(), x.z()});
        }
        return at->second;
    }

    const Complex& complex_;
    RawTets raw_;
    std::map<const void*, int> numbers_;
};

}  // namespace

namespace {

RawTets refine(const Problem& problem, const RefinementGoal& goal) {
    CGAL::get_default_random() = CGAL::Random(1);
    const Surface surface = make_surface(problem.plc);
    Domain domain(surface, &CGAL::get_default_random());
    const std::map<Domain::Curve_index, int> curves = add_chains(problem, goal.degrees, domain);
    namespace p = CGAL::parameters;
    const Criteria criteria(p::edge_size = goal.edge, p::facet_angle = 25.0, p::facet_size = goal.edge,
                            p::facet_distance = 0.02 * goal.edge, p::cell_radius_edge_ratio = goal.quality,
                            p::cell_size = goal.edge);
    // Perturbation goes by addresses of cells: its result changes from run to run.
    const Complex complex = CGAL::make_mesh_3<Complex>(domain, criteria, p::no_perturb());
    return Reader(complex).read(surface, curves);
}

}  // namespace

RawTets run_cgal(const Problem& problem, const RefinementGoal& goal) {
    try {
        return refine(problem, goal);
    } catch (const CGAL::Failure_exception& error) {
        const std::string text = error.message();
        throw Error(ErrorCode::tetrahedra_failed, text.substr(0, text.find('\n')));
    }
}

}  // namespace pavior::detail
