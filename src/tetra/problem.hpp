#pragma once
// A surface made ready for the engines. Internal to the tetra component.

#include "plc.hpp"

namespace pavior::detail {

/// What facet number first_number + i of a complex was made of. (TetGen has its own ideas about numbers 0 and 1.)
struct FacetSource {
    Vec3 normal = Vec3::Zero();  ///< not unit; outward for facets of the boundary
    std::int32_t tag = 0;
    bool inner = false;  ///< tetrahedra on both sides
};
inline constexpr int first_number = 2;

struct Problem {
    const TaggedSurface* surface = nullptr;
    Plc plc;
    std::vector<FacetSource> sources;
    bool keep_surface = true;  ///< facet i of the complex is triangle i, and must come out as it is
    bool keep_nodes = true;    ///< the nodes of the surface come out first
    double tolerance = 1e-9;   ///< by how much volume and lengths of tagged edges may differ, relatively
};

/// Every triangle a facet of its own: those of the surface, then the inner ones.
[[nodiscard]] Problem make_problem(const TaggedSurface& surface, std::span<const TaggedTriangle> inner);

/// The same surface, free to be triangulated anew: triangles in one plane with one tag, not parted by a tagged edge,
/// have one number.
[[nodiscard]] Problem merge_coplanar(const Problem& problem);

/// The same surface with all edges longer than \p length (in the coordinates of the frame) halved until none is left.
[[nodiscard]] Problem split_edges(const Problem& problem, double length);

}  // namespace pavior::detail
