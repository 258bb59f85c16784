#pragma once
/// \file
/// Submapped faces and solids on the integer lattice, once the numbers of intervals are known.

#include <pavior/core/assert.hpp>
#include <pavior/core/compiled.hpp>
#include <pavior/core/error.hpp>
#include <pavior/lattice/logical_grid.hpp>
#include <pavior/lattice/submap_topology.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace pavior {

/// The numbers that fix the lattice of a SubmapModel.
struct SubmapNumbers {
    std::vector<int> edges;                              ///< intervals, by edge id
    std::vector<std::vector<std::array<int, 2>>> links;  ///< by face id, per link: steps along s and t
};

/// Where the uses of a face start on the face's own lattice (s, t): per loop, per use. The first is (0, 0).
using FaceTrace = std::vector<std::vector<LatticePoint<2>>>;

/// Which way a heading leads on the face's lattice.
[[nodiscard]] constexpr LatticePoint<2> lattice_step(int heading) {
    return heading == 0   ? LatticePoint<2>{1, 0}
           : heading == 1 ? LatticePoint<2>{0, 1}
           : heading == 2 ? LatticePoint<2>{-1, 0}
                          : LatticePoint<2>{0, -1};
}

/// Follows the loops of \p face. \p edges by edge id, \p links one entry a link.
/// \throws InputError infeasible_intervals if a loop does not close (ids: the loop).
[[nodiscard]] PAVIOR_INLINE FaceTrace trace_face(const LogicalFace& face, std::span<const int> edges,
                                                 std::span<const std::array<int, 2>> links);

/// The boundary of a face as unit segments; their entity is the number of the use, counted through all loops.
[[nodiscard]] PAVIOR_INLINE std::vector<LatticeFacet<2>> trace_facets(const LogicalFace& face, const FaceTrace& trace,
                                                                      std::span<const int> edges);

/// Where a face lies on the lattice of a solid: (s, t) is at origin + s * side.s + t * side.t.
struct SidePlace {
    LogicalSide side;
    LatticePoint<3> origin{};

    [[nodiscard]] LatticePoint<3> operator()(const LatticePoint<2>& p) const {
        LatticePoint<3> x = origin;
        x[side.s.axis()] += side.s.sign() * p[0];
        x[side.t.axis()] += side.t.sign() * p[1];
        return x;
    }
    /// The unit square at \p cell.
    [[nodiscard]] LatticeFacet<3> facet(const LatticePoint<2>& cell, Index entity) const;
};

/// Lattice coordinates of the vertices of a solid.
using VertexLattice = std::map<VertexId, LatticePoint<3>>;

/// Vertices and sides of a solid on its lattice.
struct SolidLattice {
    VertexLattice vertices;
    std::vector<SidePlace> sides;  ///< in the order of SubmapTopology::sides
};

/// Places all faces of \p solid; the first vertex of its first face is at the origin.
/// \throws InputError infeasible_intervals if the numbers contradict each other (ids: the face).
template <brep B>
[[nodiscard]] SolidLattice solid_lattice(const B& b, const SubmapModel& model, const SubmapTopology& solid,
                                         const SubmapNumbers& numbers) {
    SolidLattice result;
    result.sides.resize(solid.sides.size());
    std::vector<FaceTrace> traces;
    std::map<VertexId, std::vector<std::size_t>> at_vertex;
    const auto face_of = [&](std::size_t f) -> const LogicalFace& {
        return model.faces[solid.sides[f].face.face.index()];
    };
    const auto start = [&](OrientedEdge use) { return b.edge_vertices(use.edge)[use.forward ? 0 : 1]; };
    for (std::size_t f = 0; f < solid.sides.size(); ++f) {
        traces.push_back(trace_face(face_of(f), numbers.edges, numbers.links[solid.sides[f].face.face.index()]));
        for (const LogicalLoop& loop : face_of(f).loops) {
            for (const OrientedEdge use : loop.uses) {
                at_vertex[start(use)].push_back(f);
            }
        }
    }
    std::vector<bool> placed(solid.sides.size(), false);
    std::vector<std::size_t> stack{0};
    result.vertices[start(face_of(0).loops[0].uses[0])] = {0, 0, 0};
    while (!stack.empty()) {
        const std::size_t f = stack.back();
        stack.pop_back();
        if (placed[f]) {
            continue;
        }
        placed[f] = true;
        SidePlace& place = result.sides[f];
        place.side = solid.sides[f];
        bool anchored = false;
        for (const bool second : {false, true}) {
            for (std::size_t l = 0; l < traces[f].size(); ++l) {
                for (std::size_t i = 0; i < traces[f][l].size(); ++i) {
                    const VertexId v = start(face_of(f).loops[l].uses[i]);
                    const auto known = result.vertices.find(v);
                    const LatticePoint<3> here = place(traces[f][l][i]);
                    if (!anchored && known != result.vertices.end()) {
                        for (std::size_t a = 0; a < 3; ++a) {
                            place.origin[a] = known->second[a] - here[a];
                        }
                        anchored = true;
                    } else if (second && known == result.vertices.end()) {
                        result.vertices[v] = here;
                        stack.insert(stack.end(), at_vertex[v].begin(), at_vertex[v].end());
                    } else if (second && known->second != here) {
                        const int tag = b.tag(2, solid.sides[f].face.face.index());
                        throw InputError(
                            ErrorCode::infeasible_intervals,
                            "the numbers of intervals round face " + std::to_string(tag) + " contradict each other",
                            {tag});
                    } else if (second) {
                        for (const std::size_t g : at_vertex[v]) {
                            if (!placed[g]) {
                                stack.push_back(g);
                            }
                        }
                    }
                }
            }
        }
    }
    PAVIOR_ASSERT(std::find(placed.begin(), placed.end(), false) == placed.end());
    return result;
}

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/lattice/submap_lattice-inl.hpp>
#endif
