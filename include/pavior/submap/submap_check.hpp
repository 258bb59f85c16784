#pragma once
/// \file
/// Whether submapped solids fit into the integer lattice without touching or covering themselves.

#include <pavior/core/compiled.hpp>
#include <pavior/lattice/submap_lattice.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <set>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

namespace pavior {

namespace detail {

/// A lattice point of the boundary and the vertex (dimension 0), edge or face that owns the node there.
struct LatticeClaim {
    LatticePoint<3> point{};
    int dimension = 0;
    std::int32_t entity = 0;
    std::size_t side = 0;  ///< a side that has the entity

    friend bool operator<(const LatticeClaim& a, const LatticeClaim& b) {
        return std::tie(a.point, a.dimension, a.entity, a.side) < std::tie(b.point, b.dimension, b.entity, b.side);
    }
};

/// Claims of the vertices and edges of side \p f.
template <brep B>
void claim_loops(const B& b, const LogicalFace& face, const FaceTrace& trace, const SidePlace& place, std::size_t f,
                 std::span<const int> edges, std::vector<LatticeClaim>& claims) {
    for (std::size_t l = 0; l < face.loops.size(); ++l) {
        for (std::size_t i = 0; i < face.loops[l].uses.size(); ++i) {
            const OrientedEdge use = face.loops[l].uses[i];
            const LatticePoint<2> step = lattice_step(face.loops[l].heading[i]);
            LatticePoint<2> at = trace[l][i];
            claims.push_back({place(at), 0, b.edge_vertices(use.edge)[use.forward ? 0 : 1].value, f});
            for (int k = 1; k < edges[use.edge.index()]; ++k) {
                at = {at[0] + step[0], at[1] + step[1]};
                claims.push_back({place(at), 1, use.edge.value, f});
            }
        }
    }
}

/// Positions of sides of \p solid that claim one lattice point for different nodes.
[[nodiscard]] PAVIOR_INLINE std::set<std::size_t> contested(std::vector<LatticeClaim> claims);

/// Positions of sides of \p solid that overlap or touch where they should not; empty if the solid is sound.
template <brep B>
[[nodiscard]] std::set<std::size_t> overlapping_sides(const B& b, const SubmapModel& model, const SubmapTopology& solid,
                                                      const SubmapNumbers& numbers) {
    const SolidLattice lattice = solid_lattice(b, model, solid, numbers);
    std::vector<LatticeClaim> claims;
    std::vector<LatticeFacet<3>> facets;
    for (std::size_t f = 0; f < solid.sides.size(); ++f) {
        const FaceId id = solid.sides[f].face.face;
        const LogicalFace& face = model.faces[id.index()];
        const FaceTrace trace = trace_face(face, numbers.edges, numbers.links[id.index()]);
        const LogicalGrid<2> grid(trace_facets(face, trace, numbers.edges));
        if (!grid.ok()) {
            return {f};
        }
        const SidePlace& place = lattice.sides[f];
        claim_loops(b, face, trace, place, f, numbers.edges, claims);
        grid.for_each_node([&](Index, const LatticePoint<2>& p) {
            if (grid.inner(p)) {
                claims.push_back({place(p), 2, id.value, f});
            }
        });
        grid.for_each_cell([&](const LatticePoint<2>& p) { facets.push_back(place.facet(p, static_cast<Index>(f))); });
    }
    std::set<std::size_t> result = contested(std::move(claims));
    if (result.empty()) {
        const LogicalGrid<3> grid(facets);
        result.insert(grid.overlap().begin(), grid.overlap().end());
    }
    return result;
}

}  // namespace detail

/// Tags of faces that make a solid of \p model cover lattice cells twice or touch itself where it does not in space;
/// empty if the lattice of every solid is sound. O(n log n) for n boundary nodes, plus the bounding box of the lattice.
template <brep B>
[[nodiscard]] std::vector<int> overlapping_faces(const B& b, const SubmapModel& model, const SubmapNumbers& numbers) {
    for (const SubmapTopology& solid : model.solids) {
        const std::set<std::size_t> sides = detail::overlapping_sides(b, model, solid, numbers);
        std::vector<int> tags;
        for (const std::size_t side : sides) {
            tags.push_back(b.tag(2, solid.sides[side].face.face.index()));
        }
        if (!tags.empty()) {
            std::sort(tags.begin(), tags.end());
            return tags;
        }
    }
    return {};
}

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/submap/submap_check-inl.hpp>
#endif
