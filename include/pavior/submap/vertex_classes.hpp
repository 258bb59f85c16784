#pragma once
/// \file
/// The corners of solids as corners of unions of cubes: which classes of the angles round a vertex fit together.

#include <pavior/brep/solid_boundary.hpp>
#include <pavior/lattice/signed_axis.hpp>
#include <pavior/lattice/submap_corners.hpp>

#include <algorithm>
#include <cmath>
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
[[nodiscard]] inline std::vector<Umbrella> umbrellas(const SolidBoundary& boundary) {
    std::vector<std::size_t> previous(boundary.half_edges.size());
    for (std::size_t h = 0; h < previous.size(); ++h) {
        previous[boundary.half_edges[h].next] = h;
    }
    std::vector<Umbrella> result;
    std::vector<bool> seen(previous.size(), false);
    for (std::size_t first = 0; first < previous.size(); ++first) {
        if (seen[first]) {
            continue;
        }
        Umbrella umbrella{boundary.half_edges[first].start, {}};
        for (std::size_t h = first; !seen[h]; h = boundary.half_edges[previous[h]].twin) {
            seen[h] = true;
            umbrella.half_edges.push_back(h);
        }
        result.push_back(std::move(umbrella));
    }
    return result;
}

/// Angle inside the solid between two faces from \p angle in (-inf, inf) to the class: 1 to 4 quarter turns whose
/// deviation is at most that of \p options.
[[nodiscard]] inline std::vector<std::uint8_t> dihedral_classes(double angle, const CornerOptions& options) {
    std::vector<std::uint8_t> result;
    for (const CornerClass c : corner_classes(angle, options)) {
        result.push_back(static_cast<std::uint8_t>(c));
    }
    return result;
}

namespace detail {

/// Depth-first search for the closed walks.
class UmbrellaSearch {
public:
    UmbrellaSearch(std::span<const double> corners, std::span<const double> dihedrals, const CornerOptions& options)
        : corners_(corners), dihedrals_(dihedrals) {
        for (std::size_t i = 0; i < corners.size(); ++i) {
            corner_choice_.push_back(corner_classes(corners[i], options));
            dihedral_choice_.push_back(dihedral_classes(dihedrals[i], options));
        }
        current_.corner.resize(corners.size());
        current_.dihedral.resize(corners.size());
        step(0, SignedAxis{1}, SignedAxis{3});
    }

    [[nodiscard]] std::vector<VertexClasses> take() { return std::move(found_); }

private:
    static constexpr std::size_t max_steps = 2'000'000;

    /// At half-edge i, which runs along \p d with the outward normal \p n of its face.
    void step(std::size_t i, SignedAxis d, SignedAxis n) {
        const std::size_t count = corners_.size();
        if (++steps_ > max_steps) {
            return;
        }
        if (i == count) {
            if (d == SignedAxis{1} && n == SignedAxis{3} && sound()) {
                found_.push_back(current_);
            }
            return;
        }
        const std::size_t next = (i + 1) % count;
        for (const CornerClass c : corner_choice_[i]) {
            const SignedAxis d_next = turned(d, n, static_cast<int>(c));
            for (const std::uint8_t m : dihedral_choice_[next]) {
                const double cost =
                    corner_cost(corners_[i], c) + 0.5 * corner_cost(dihedrals_[next], static_cast<CornerClass>(m));
                current_.corner[i] = c;
                current_.dihedral[next] = m;
                current_.cost += cost;
                step(i + 1, d_next, turned(n, d_next, m - 2));
                current_.cost -= cost;
            }
        }
    }

    /// Whether the octants inside the walk are between one and eight (Gauss and Bonnet).
    [[nodiscard]] bool sound() const {
        int octants = 4 - 2 * static_cast<int>(corners_.size());
        for (const std::uint8_t m : current_.dihedral) {
            octants += m;
        }
        return octants >= 1 && octants <= 8;
    }

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
