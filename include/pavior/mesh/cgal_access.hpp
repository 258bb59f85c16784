#pragma once
/// \file
/// CGAL::Surface_mesh as a quad mesh. The only public header that needs CGAL.

#include <pavior/core/error.hpp>
#include <pavior/mesh/mesh_access.hpp>

#include <CGAL/Surface_mesh.h>
#include <CGAL/number_utils.h>

#include <cstddef>
#include <string>

namespace pavior {

/// CGAL::Surface_mesh<P> whose faces are all quads: node i is vertex i, quad q face q, in the order of its halfedges.
/// Counts throw InputError (bad_index) if removed elements have not been collected (collect_garbage()); quad() throws
/// InputError (bad_index, ids: the face) for a face that does not have four vertices.
template <class P>
struct mesh_access<CGAL::Surface_mesh<P>> {
    using Mesh = CGAL::Surface_mesh<P>;

    static std::size_t node_count(const Mesh& m) {
        require_dense(m);
        return m.number_of_vertices();
    }
    static Vec3 node(const Mesh& m, Index i) {
        const P& p = m.point(typename Mesh::Vertex_index(i));
        return {CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z())};
    }
    static std::size_t quad_count(const Mesh& m) {
        require_dense(m);
        return m.number_of_faces();
    }
    static QuadCorners quad(const Mesh& m, Index q) {
        auto at = m.halfedge(typename Mesh::Face_index(q));
        if (m.degree(typename Mesh::Face_index(q)) != 4) {
            throw InputError(ErrorCode::bad_index, "face " + std::to_string(q) + " is not a quad", {q});
        }
        QuadCorners corners{};
        for (Index& corner : corners) {
            corner = static_cast<Index>(m.source(at));
            at = m.next(at);
        }
        return corners;
    }

private:
    static void require_dense(const Mesh& m) {
        if (m.has_garbage()) {
            throw InputError(ErrorCode::bad_index, "the Surface_mesh has removed elements: call collect_garbage()");
        }
    }
};

}  // namespace pavior
