#pragma once
/// \file
/// The corners of solids as corners of unions of cubes: which classes of the angles round a vertex fit together.

#include <pavior/brep/solid_boundary.hpp>
#include <pavior/core/compiled.hpp>
#include <pavior/lattice/signed_axis.hpp>
#include <pavior/lattice/submap_corners.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace pavior {

/// The faces round one vertex of a solid's boundary: half-edges that start there, each next one the other half-edge of
/// the edge that ends there in the face of the last. A vertex where the boundary touches itself has several umbrellas.
struct Umbrella {
    VertexId vertex;
    std::vector<std::size_t> half_edges;
};

/// Classes for an umbrella. The faces round the vertex become a closed walk on the octahedron of the six directions.
struct VertexClasses {
    std::vector<CornerClass> corner;     ///< of the face of each half-edge, at its start
    std::vector<std::uint8_t> dihedral;  ///< along each half-edge: quarter turns inside the solid, 1 to 4
    double cost = 0.0;                   ///< corner_cost() of the corners, and half of it of the dihedral angles
};

/// The umbrellas of a boundary, each half-edge in one of them. O(n).
[[nodiscard]] PAVIOR_INLINE std::vector<Umbrella> umbrellas(const SolidBoundary& boundary);

/// Angle inside the solid between two faces from \p angle in (-inf, inf) to the class: 1 to 4 quarter turns whose
/// deviation is at most that of \p options.
[[nodiscard]] PAVIOR_INLINE std::vector<std::uint8_t> dihedral_classes(double angle, const CornerOptions& options);

namespace detail {

/// Depth-first search for the closed walks.
class UmbrellaSearch {
public:
    UmbrellaSearch(std::span<const double> corners, std::span<const double> dihedrals, const CornerOptions& options);

    [[nodiscard]] std::vector<VertexClasses> take() { return std::move(found_); }

private:
    static constexpr std::size_t max_steps = 2'000'000;

    /// At half-edge i, which runs along \p d with the outward normal \p n of its face.
    void step(std::size_t i, SignedAxis d, SignedAxis n);

    /// Whether the octants inside the walk are between one and eight (Gauss and Bonnet).
    [[nodiscard]] bool sound() const;

    std::span<const double> corners_, dihedrals_;
    std::vector<std::vector<CornerClass>> corner_choice_;
    std::vector<std::vector<std::uint8_t>> dihedral_choice_;
    VertexClasses current_;
    std::vector<VertexClasses> found_;
    std::size_t steps_ = 0;
};

}  // namespace detail

/// All classes for an umbrella whose faces close round the vertex as the faces of a union of cubes do.
/// \param corners   interior angles of the faces at the vertex, degrees, in the order of Umbrella::half_edges
/// \param dihedrals angles inside the solid along the half-edges, degrees
/// Angles farther than options.max_deviation from a class do not take it. Exponential in the number of ambiguous
/// angles, cut off after two million steps.
[[nodiscard]] inline std::vector<VertexClasses> vertex_classes(std::span<const double> corners,
                                                               std::span<const double> dihedrals,
                                                               const CornerOptions& options = {}) {
    return detail::UmbrellaSearch(corners, dihedrals, options).take();
}

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/submap/vertex_classes-inl.hpp>
#endif
