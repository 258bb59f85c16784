#pragma once
/// \file
/// Where the vertices, chains, patches and cells of a cell complex lie.

#include <pavior/block/chain_curve.hpp>
#include <pavior/block/patch_map.hpp>
#include <pavior/core/compiled.hpp>
#include <pavior/core/execution.hpp>
#include <pavior/core/parallel_for.hpp>
#include <pavior/dual/cell_complex.hpp>
#include <pavior/dual/reference_mesh.hpp>
#include <pavior/dual/tet_topology.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace pavior {

/// The shapes of the entities of a cell complex, each in its numbering.
struct BlockGeometry {
    std::vector<Vec3> vertices;
    std::vector<ChainCurve> chains;
    std::vector<std::array<Index, 2>> chain_ends;       ///< vertices where the polyline begins and ends
    std::vector<PatchMap> patches;                      ///< side s of the map is patch_sides[p][s]
    std::vector<std::vector<PatchSide>> patch_sides;    ///< as in the cell complex
    std::vector<std::vector<std::int32_t>> patch_tags;  ///< boundary patches: tag of each triangle; inner ones: empty
    std::vector<Vec3> cells;                            ///< centroids of volume
};

namespace detail {

[[noreturn]] inline void throw_invalid(const std::string& what, Index id) {
    throw InputError(ErrorCode::invalid_dual, what + " " + std::to_string(id) + " has the wrong topology", {id});
}

/// Members of each class: those of class c are items[begin[c]] .. items[begin[c + 1] - 1], ascending.
struct Members {
    std::vector<std::size_t> begin;
    std::vector<Index> items;

    Members(const std::vector<Index>& class_of, std::size_t classes);
    [[nodiscard]] std::span<const Index> of(std::size_t c) const {
        return std::span(items).subspan(begin[c], begin[c + 1] - begin[c]);
    }
};

/// Faces of a patch as triangles seen from outside of the cell of smaller number.
template <tet_mesh M>
[[nodiscard]] std::vector<TriCorners> patch_triangles(const M& mesh, const TetTopology& topology,
                                                      const CellComplex& complex, std::span<const Index> faces) {
    std::vector<TriCorners> triangles;
    for (const Index f : faces) {
        auto [t, other] = topology.face_tets[f];
        if (other != no_index && complex.tet_cell[other] < complex.tet_cell[t]) {
            t = other;
        }
        triangles.push_back(tet_face(tet(mesh, t), local_face(topology, t, f)));
    }
    return triangles;
}

/// Nodes along one side of a patch, from its vertex.
[[nodiscard]] PAVIOR_INLINE std::vector<Index> side_nodes(const CellComplex& complex, const PatchSide& side);

/// The disc of a patch, numbered from 0, turned as its sides run.
template <tet_mesh M>
[[nodiscard]] PatchDisc patch_disc(const M& mesh, std::vector<TriCorners> triangles,
                                   const std::vector<std::vector<Index>>& sides) {
    const auto runs = [&](const TriCorners& c) {
        for (std::size_t k = 0; k < 3; ++k) {
            if (c[k] == sides[0][0] && c[(k + 1) % 3] == sides[0][1]) {
                return true;
            }
        }
        return false;
    };
    const bool turned = std::none_of(triangles.begin(), triangles.end(), runs);
    std::vector<Index> nodes;
    for (TriCorners& c : triangles) {
        if (turned) {
            std::swap(c[1], c[2]);
        }
        nodes.insert(nodes.end(), c.begin(), c.end());
    }
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    const auto local = [&](Index i) {
        return static_cast<Index>(std::lower_bound(nodes.begin(), nodes.end(), i) - nodes.begin());
    };
    PatchDisc disc;
    for (const Index i : nodes) {
        disc.points.push_back(node(mesh, i));
    }
    for (const TriCorners& c : triangles) {
        disc.triangles.push_back({local(c[0]), local(c[1]), local(c[2])});
    }
    for (const auto& side : sides) {
        disc.sides.emplace_back();
        std::transform(side.begin(), side.end(), std::back_inserter(disc.sides.back()), local);
    }
    return disc;
}

template <tet_mesh M>
[[nodiscard]] PatchMap patch_map(const M& mesh, const TetTopology& topology, const CellComplex& complex,
                                 std::span<const Index> faces, Index patch) {
    if (complex.patch_loops[patch + 1] != complex.patch_loops[patch] + 1) {
        throw_invalid("patch", patch);
    }
    std::vector<std::vector<Index>> sides;
    for (const PatchSide& side : complex.loop(complex.patch_loops[patch])) {
        if (side.vertex == no_index || side.chain == no_index) {
            throw_invalid("patch", patch);
        }
        sides.push_back(side_nodes(complex, side));
    }
    try {
        return PatchMap(patch_disc(mesh, patch_triangles(mesh, topology, complex, faces), sides));
    } catch (const InputError&) {
        throw_invalid("patch", patch);
    }
}

template <tet_mesh M>
[[nodiscard]] std::vector<Vec3> cell_centroids(const M& mesh, const std::vector<Index>& cell_of_tet,
                                               std::size_t cells) {
    std::vector<Vec3> sum(cells, Vec3::Zero());
    std::vector<double> volume(cells, 0.0);
    for (std::size_t t = 0; t < cell_of_tet.size(); ++t) {
        const TetCorners c = tet(mesh, static_cast<Index>(t));
        const Vec3 a = node(mesh, c[0]);
        const Vec3 ab = node(mesh, c[1]) - a;
        const Vec3 ac = node(mesh, c[2]) - a;
        const Vec3 ad = node(mesh, c[3]) - a;
        // A cell of flat tetrahedra still gets a centre: no weight is null.
        const double size = std::max({ab.norm(), ac.norm(), ad.norm()});
        const double weight = std::abs(ab.cross(ac).dot(ad)) + 1e-12 * size * size * size;
        sum[cell_of_tet[t]] += weight * (a + (ab + ac + ad) / 4.0);
        volume[cell_of_tet[t]] += weight;
    }
    for (std::size_t c = 0; c < cells; ++c) {
        sum[c] /= volume[c];
    }
    return sum;
}

}  // namespace detail

/// The shapes of the vertices, chains, patches and cells of \p complex. The polygon of a patch turns as its sides in
/// the complex: counter-clockwise seen from outside for patches on the boundary.
/// \throws InputError invalid_dual naming a chain that does not join two vertices, or a patch that is not a disc with
/// three corners or more (verify_dual.hpp says more). O(n log n), and one sparse factorisation a patch that is not a
/// convex plane polygon. The same bytes for any number of threads.
template <classified_tet_mesh M>
[[nodiscard]] BlockGeometry block_geometry(const M& mesh, const TetTopology& topology, const CellComplex& complex,
                                           Execution execution = sequential) {
    BlockGeometry geometry;
    for (const Index i : complex.vertices) {
        geometry.vertices.push_back(node(mesh, i));
    }
    for (const Index c : IndexRange(complex.chains.size())) {
        const auto ends = complex.chains[c].ends;
        if (ends[0] == no_index || ends[1] == no_index) {
            detail::throw_invalid("chain", c);
        }
        std::vector<Vec3> points;
        for (const Index i : complex.chain_path(c)) {
            points.push_back(node(mesh, i));
        }
        geometry.chains.emplace_back(std::move(points));
        geometry.chain_ends.push_back(ends);
    }
    std::vector<std::int32_t> tag_of_face(topology.faces.size(), 0);
    for (const TaggedTriangle triangle : feature_access<M>::patches(mesh)) {
        if (const Index f = topology.face(triangle.nodes); f != no_index) {
            tag_of_face[f] = triangle.tag;
        }
    }
    const std::size_t patches = complex.patches.size();
    const detail::Members faces(complex.face_patch, patches);
    geometry.patches.resize(patches);
    geometry.patch_sides.resize(patches);
    geometry.patch_tags.resize(patches);
    parallel_for(execution, patches, 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t p = begin; p < end; ++p) {
            geometry.patches[p] = detail::patch_map(mesh, topology, complex, faces.of(p), static_cast<Index>(p));
            const auto sides = complex.loop(complex.patch_loops[p]);
            geometry.patch_sides[p].assign(sides.begin(), sides.end());
            if (topology.boundary(faces.of(p).front())) {
                for (const Index f : faces.of(p)) {
                    geometry.patch_tags[p].push_back(tag_of_face[f]);
                }
            }
        }
    });
    geometry.cells = detail::cell_centroids(mesh, complex.tet_cell, complex.cells.size());
    return geometry;
}

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/block/block_geometry-inl.hpp>
#endif
