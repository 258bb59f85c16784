// Built where CGAL is found.
#include "support/catch.hpp"
#include "support/shapes.hpp"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Simple_cartesian.h>

#include <pavior/mesh/boundary_loops.hpp>
#include <pavior/mesh/cgal_access.hpp>
#include <pavior/mesh/quality.hpp>
#include <pavior/mesh/verify_quads.hpp>

using namespace pavior;

namespace {
template <class Kernel>
CGAL::Surface_mesh<typename Kernel::Point_3> to_cgal(const QuadMesh& mesh) {
    CGAL::Surface_mesh<typename Kernel::Point_3> out;
    using Vertex = typename CGAL::Surface_mesh<typename Kernel::Point_3>::Vertex_index;
    for (const Vec3& x : mesh.nodes) {
        out.add_vertex(typename Kernel::Point_3(x.x(), x.y(), x.z()));
    }
    for (const QuadCorners& q : mesh.quads) {
        out.add_face(Vertex(q[0]), Vertex(q[1]), Vertex(q[2]), Vertex(q[3]));
    }
    return out;
}
using Plain = CGAL::Simple_cartesian<double>;
using Exact = CGAL::Exact_predicates_exact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Plain::Point_3>;
}  // namespace

static_assert(quad_mesh<Mesh> && !hex_mesh<Mesh>);

TEST_CASE("a Surface_mesh is read, checked and measured like arrays") {
    const QuadMesh ring = shapes::square_ring(2);
    const Mesh mesh = to_cgal<Plain>(ring);
    CHECK(node_count(mesh) == ring.nodes.size());
    CHECK(quad_count(mesh) == ring.quads.size());
    CHECK(node(mesh, 17) == ring.nodes[17]);
    CHECK(verify_quads(mesh).ok());
    CHECK(boundary_loops(mesh) == boundary_loops(ring));
    CHECK(quad_quality(mesh).shape.mean == Approx(quad_quality(ring).shape.mean));
    const QuadCorners c = quad(mesh, 3);
    CHECK(std::is_permutation(c.begin(), c.end(), ring.quads[3].begin()));
    CHECK(verify_quads(to_cgal<Exact>(ring)).ok());
    CHECK(node(to_cgal<Exact>(ring), 17) == ring.nodes[17]);
}

TEST_CASE("faces that are no quads, and garbage") {
    Mesh mesh = to_cgal<Plain>(shapes::grid_cap(1, 1));
    const auto tip = mesh.add_vertex(Plain::Point_3(0, 5, 0));
    mesh.add_face(Mesh::Vertex_index(2), Mesh::Vertex_index(3), tip);
    try {
        static_cast<void>(verify_quads(mesh));
        FAIL("did not throw");
    } catch (const InputError& error) {
        CHECK(error.code() == ErrorCode::bad_index);
        CHECK(error.ids() == Error::Ids{1});
    }
    mesh.remove_face(Mesh::Face_index(1));
    CHECK_THROWS_AS(quad_count(mesh), InputError);
    mesh.collect_garbage();
    CHECK(quad_count(mesh) == 1);
}
