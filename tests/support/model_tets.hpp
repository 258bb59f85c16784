#pragma once
// Tetrahedra of models built in code, with the tags of what they lie on: a tet_mesher without a CAD kernel.
#include "support/test_brep.hpp"

#include <pavior/brep/nearest_edge.hpp>
#include <pavior/brep/solids_tets.hpp>
#include <pavior/mesh/cells.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <numbers>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

namespace pavior::test {

/// Finds the faces of the triangles at which solids end, and the edges and vertices of the model among mesh edges and
/// nodes; everything must lie on the model.
template <brep B>
SolidsTets tagged_tets(const B& b, TetMesh mesh, std::vector<SolidId> tet_solid) {
    SolidsTets result;
    result.tet_solid = std::move(tet_solid);
    const auto& x = mesh.nodes;
    const auto on_face = [&](FaceId f, Index i) {
        return (b.face_point(f, b.closest_on_face(f, x[i])) - x[i]).norm() < 1e-9;
    };
    std::map<TriCorners, std::pair<TriCorners, std::set<SolidId>>> sides;
    std::map<TriCorners, int> count;
    std::set<std::array<Index, 2>> edges;
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
        for (const auto& local : tet_faces) {
            TriCorners c;
            for (std::size_t k = 0; k < 3; ++k) {
                c[k] = mesh.tets[t][static_cast<std::size_t>(local[k])];
            }
            TriCorners key = c;
            std::sort(key.begin(), key.end());
            sides.try_emplace(key, c, std::set<SolidId>{}).first->second.second.insert(result.tet_solid[t]);
            ++count[key];
        }
    }
    std::map<FaceId, std::vector<TaggedTriangle>> by_face;
    for (const auto& [key, side] : sides) {
        const auto& [c, solids] = side;
        if (count[key] == 2 && solids.size() == 1) {
            continue;
        }
        FaceId found;
        for (const OrientedFace& f : b.solid_faces(*solids.begin())) {
            const bool on = std::all_of(c.begin(), c.end(), [&, face = f.face](Index i) { return on_face(face, i); });
            found = on ? f.face : found;
        }
        if (!found.valid()) {
            throw std::logic_error("a side of a tetrahedron lies on no face");
        }
        by_face[found].push_back({c, found.value});
        for (std::size_t k = 0; k < 3; ++k) {
            edges.insert({std::min(c[k], c[(k + 1) % 3]), std::max(c[k], c[(k + 1) % 3])});
        }
    }
    for (const auto& [face, triangles] : by_face) {
        result.tets.triangles.insert(result.tets.triangles.end(), triangles.begin(), triangles.end());
    }
    std::map<EdgeId, std::set<FaceId>> edge_faces;
    for (std::size_t f = 0; f < b.face_count(); ++f) {
        for (const EdgeLoop& loop : b.face_loops(FaceId{static_cast<std::int32_t>(f)})) {
            for (const OrientedEdge& use : loop) {
                edge_faces[use.edge].insert(FaceId{static_cast<std::int32_t>(f)});
            }
        }
    }
    NearestEdge<B> nearest(b);
    for (const auto& [i, j] : edges) {
        for (const auto& [e, faces] : edge_faces) {
            if (faces.size() > 1 && nearest.closest(e, x[i]).distance < 1e-9 &&
                nearest.closest(e, x[j]).distance < 1e-9) {
                result.tets.edges.push_back({{i, j}, e.value});
            }
        }
    }
    for (std::size_t v = 0; v < b.vertex_count(); ++v) {
        for (Index i = 0; i < x.size(); ++i) {
            if ((b.vertex_point(VertexId{static_cast<std::int32_t>(v)}) - x[i]).norm() < 1e-9) {
                result.tets.vertices.push_back({i, static_cast<std::int32_t>(v)});
            }
        }
    }
    result.tets.mesh = std::move(mesh);
    return result;
}

/// Three tetrahedra in the prism over triangle \p c, whose upper nodes are \p n further on; neighbours conform.
inline void add_prism_tets(TetMesh& mesh, TriCorners c, Index n) {
    std::sort(c.begin(), c.end());
    for (const TetCorners& t : {TetCorners{c[0], c[1], c[2], c[2] + n}, TetCorners{c[0], c[1], c[1] + n, c[2] + n},
                                TetCorners{c[0], c[0] + n, c[1] + n, c[2] + n}}) {
        const auto& x = mesh.nodes;
        const bool positive = (x[t[1]] - x[t[0]]).cross(x[t[2]] - x[t[0]]).dot(x[t[3]] - x[t[0]]) > 0;
        mesh.tets.push_back(positive ? t : TetCorners{t[0], t[1], t[3], t[2]});
    }
}

/// The solids of add_box_row() at \p x with n x n squares in each section and n layers in each box.
template <brep B>
SolidsTets box_row_tets(const B& b, const std::vector<double>& x, Index n) {
    TetMesh mesh;
    std::vector<SolidId> solids;
    const Index section = (n + 1) * (n + 1);
    for (std::size_t s = 0; s + 1 < x.size(); ++s) {
        for (Index layer = s == 0 ? 0 : 1; layer <= n; ++layer) {
            for (Index i = 0; i < section; ++i) {
                mesh.nodes.emplace_back(x[s] + (x[s + 1] - x[s]) * layer / n, double(i % (n + 1)) / n,
                                        double(i / (n + 1)) / n);
            }
        }
    }
    for (Index layer = 0; layer + 1 < mesh.nodes.size() / section; ++layer) {
        for (Index k = 0; k < n; ++k) {
            for (Index j = 0; j < n; ++j) {
                const Index at = layer * section + k * (n + 1) + j;
                add_prism_tets(mesh, {at, at + 1, at + n + 2}, section);
                add_prism_tets(mesh, {at, at + n + 1, at + n + 2}, section);
                solids.insert(solids.end(), 6, SolidId{static_cast<std::int32_t>(layer / n)});
            }
        }
    }
    return tagged_tets(b, std::move(mesh), std::move(solids));
}

/// add_cylinder() with one radius: \p around nodes on each circle, \p layers layers, one ring.
template <brep B>
SolidsTets cylinder_tets(const B& b, double radius, double height, Index around, Index layers) {
    TetMesh mesh;
    for (Index layer = 0; layer <= layers; ++layer) {
        const double z = height * layer / layers;
        mesh.nodes.emplace_back(0, 0, z);
        for (Index i = 0; i < around; ++i) {
            const double angle = 2 * std::numbers::pi * i / around;
            mesh.nodes.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
        }
    }
    for (Index layer = 0; layer < layers; ++layer) {
        const Index first = layer * (around + 1);
        for (Index i = 0; i < around; ++i) {
            add_prism_tets(mesh, {first, first + 1 + i, first + 1 + (i + 1) % around}, around + 1);
        }
    }
    std::vector<SolidId> solids(mesh.tets.size(), SolidId{0});
    return tagged_tets(b, std::move(mesh), std::move(solids));
}

/// add_pyramid() as two tetrahedra.
template <brep B>
SolidsTets pyramid_tets(const B& b) {
    TetMesh mesh;
    mesh.nodes = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0), Vec3(0.5, 0.5, 1)};
    mesh.tets = {{0, 1, 2, 4}, {0, 2, 3, 4}};
    return tagged_tets(b, std::move(mesh), {SolidId{0}, SolidId{0}});
}

}  // namespace pavior::test
