#pragma once
/// \file
/// Where sheets start: a corner or reversal curve, and a patch that the sheet continues past it.

#include <pavior/core/compiled.hpp>
#include <pavior/dual/boundary_surface.hpp>
#include <pavior/dual/reference_mesh.hpp>
#include <pavior/marking/patch_surface.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace pavior {

/// One side of a re-entrant curve.
struct Front {
    std::int32_t curve = 0;
    CurveKind kind = CurveKind::corner;
    std::int32_t patch = 0;     ///< the patch that the sheet continues
    PatchSurface surface;       ///< of the patch, or of its part next to the curve
    std::vector<Index> region;  ///< triangles of the boundary surface that the surface was fitted to
    std::vector<Index> chain;   ///< nodes of the curve in order; a closed one repeats its first node at the end
    std::vector<Vec3> ahead;    ///< per edge of the chain: unit direction in which the sheet leaves it
};

/// The boundary of a reference mesh as the fronts see it.
struct FrontBoundary {
    BoundarySurface surface;
    std::vector<std::int32_t> tags;  ///< per triangle, its patch
    std::vector<Facet> facets;       ///< per triangle
    std::vector<char> feature;       ///< per edge of the surface: 1 on a feature curve
    std::vector<char> on_surface;    ///< per node: 1 for feature vertices and where three facets or more meet
};

namespace detail {

[[nodiscard]] inline Facet make_facet(const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 n = (b - a).cross(c - a);
    const double twice = n.norm();
    return {(a + b + c) / 3.0, twice > 0 ? Vec3(n / twice) : Vec3(0, 0, 0), 0.5 * twice};
}

}  // namespace detail

/// O(n log n).
[[nodiscard]] PAVIOR_INLINE FrontBoundary front_boundary(const ReferenceMesh& mesh, const TetTopology& topology);

namespace detail {

/// Collects fronts of one reference mesh.
class FrontFinder {
public:
    FrontFinder(const ReferenceMesh& mesh, const TetTopology& topology, const FrontBoundary& boundary,
                double tolerance);

    [[nodiscard]] std::vector<Front> find();

private:
    /// The boundary triangle that runs from a to b along their edge.
    [[nodiscard]] Index triangle_along(Index a, Index b) const;

    void add_fronts(const FeatureEdge& curve, const std::vector<Index>& chain, std::vector<Front>& fronts);

    /// Triangles that hang together with the seeds across edges that are no features and satisfy `wanted`.
    template <class Wanted>
    [[nodiscard]] std::vector<Index> grow(const std::vector<Index>& seeds, const Wanted& wanted) const {
        std::vector<char> in(boundary_.facets.size(), 0);
        std::vector<Index> found;
        const auto take = [&](Index t) {
            if (in[t] == 0 && wanted(t)) {
                in[t] = 1;
                found.push_back(t);
            }
        };
        for (const Index t : seeds) {
            take(t);
        }
        for (std::size_t i = 0; i < found.size(); ++i) {
            for (const Index s : boundary_.surface.triangle_edges[found[i]]) {
                if (boundary_.feature[s] == 0) {
                    for (const Index t : boundary_.surface.edge_triangles[s]) {
                        take(t);
                    }
                }
            }
        }
        std::sort(found.begin(), found.end());
        return found;
    }

    /// Fits a surface to a set of triangles, through the nodes that are known to be on it.
    [[nodiscard]] PatchSurface fit_region(const std::vector<Index>& region) const;

    /// The whole patch if a simple surface fits it, otherwise its part next to the chain.
    void fit(const std::vector<Index>& along, Front& front) const;

    void grow_onto(const std::vector<Index>& along, const PatchSurface& strip, Front& front) const;

    const ReferenceMesh& mesh_;
    const TetTopology& topology_;
    const FrontBoundary& boundary_;
    double tolerance_;
    std::vector<Index> place_;
};

}  // namespace detail

/// The fronts of \p mesh: both sides of every corner and reversal curve, in the order of the curves. Surfaces are
/// fitted within \p tolerance, a length. O(n) a front.
[[nodiscard]] inline std::vector<Front> sheet_fronts(const ReferenceMesh& mesh, const TetTopology& topology,
                                                     const FrontBoundary& boundary, double tolerance) {
    return detail::FrontFinder(mesh, topology, boundary, tolerance).find();
}

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/marking/fronts-inl.hpp>
#endif
