#pragma once

#include <pavior/lattice/submap_lattice.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace pavior {

PAVIOR_INLINE FaceTrace trace_face(const LogicalFace& face, std::span<const int> edges,
                                   std::span<const std::array<int, 2>> links) {
    FaceTrace result;
    for (std::size_t l = 0; l < face.loops.size(); ++l) {
        LatticePoint<2> at{0, 0};
        if (l > 0) {
            for (std::size_t a = 0; a < 2; ++a) {
                at[a] = result[0][face.links[l - 1].anchor[a]][a] + links[l - 1][a];
            }
        }
        const LatticePoint<2> first = at;
        const LogicalLoop& loop = face.loops[l];
        std::vector<LatticePoint<2>> starts;
        for (std::size_t i = 0; i < loop.uses.size(); ++i) {
            starts.push_back(at);
            const LatticePoint<2> step = lattice_step(loop.heading[i]);
            for (std::size_t a = 0; a < 2; ++a) {
                at[a] += step[a] * edges[loop.uses[i].edge.index()];
            }
        }
        if (at != first) {
            throw InputError(ErrorCode::infeasible_intervals,
                             "loop " + std::to_string(l) + " of a submapped face does not close",
                             {static_cast<std::int64_t>(l)});
        }
        result.push_back(std::move(starts));
    }
    return result;
}

PAVIOR_INLINE std::vector<LatticeFacet<2>> trace_facets(const LogicalFace& face, const FaceTrace& trace,
                                                        std::span<const int> edges) {
    std::vector<LatticeFacet<2>> result;
    Index number = 0;
    for (std::size_t l = 0; l < face.loops.size(); ++l) {
        for (std::size_t i = 0; i < face.loops[l].uses.size(); ++i, ++number) {
            const int heading = face.loops[l].heading[i];
            const LatticePoint<2> step = lattice_step(heading);
            LatticePoint<2> at = trace[l][i];
            for (int k = 0; k < edges[face.loops[l].uses[i].edge.index()]; ++k) {
                const LatticePoint<2> next{at[0] + step[0], at[1] + step[1]};
                result.push_back({{std::min(at[0], next[0]), std::min(at[1], next[1])},
                                  heading % 2 == 0 ? 1 : 0,
                                  heading == 1 || heading == 2 ? 1 : -1,
                                  number});
                at = next;
            }
        }
    }
    return result;
}

PAVIOR_INLINE LatticeFacet<3> SidePlace::facet(const LatticePoint<2>& cell, Index entity) const {
    const LatticePoint<3> a = (*this)(cell), c = (*this)({cell[0] + 1, cell[1] + 1});
    const SignedAxis n = side.outward();
    return {{std::min(a[0], c[0]), std::min(a[1], c[1]), std::min(a[2], c[2])},
            static_cast<int>(n.axis()),
            n.sign(),
            entity};
}

}  // namespace pavior
