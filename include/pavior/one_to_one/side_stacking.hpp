#pragma once
/// \file
/// Linking sides that lie above each other along the sweep: a search for consistent logical sides.

#include <pavior/brep/solid_boundary.hpp>
#include <pavior/core/compiled.hpp>
#include <pavior/one_to_one/sweep_topology.hpp>

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace pavior {

/// Which vertices of a side face may be corners of its logical rectangle, or union of rectangles. Only for solids with
/// sides above each other.
struct StackingOptions {
    double corner_tolerance = 65.0;  ///< a corner's interior angle is 90 +- this, degrees
    double notch_tolerance = 40.0;   ///< a corner between two parts of an L-shaped side has 270 +- this, degrees
    double kink_tolerance = 50.0;    ///< at a vertex inside a logical side it is 180 +- this, degrees
    /// A vertex of 270 degrees may also lie inside a logical side, which runs round it: two quads share its angle. Ways
    /// to see a face with fewer such vertices come first.
    bool flat_notches = false;
    std::size_t max_tests = 5000000;  ///< ways to see a face tried for one solid before the search gives up
};

namespace detail {

/// A role for each half-edge of a face.
using RolePattern = std::vector<SideRole>;

/// All ways to see each face of a solid as a rectangle, or a union of rectangles, that its angles allow, best angles
/// first. Independent of the caps, so made once a solid.
class RolePatterns {
public:
    RolePatterns(const SolidBoundary& solid, const StackingOptions& options) : patterns_(solid.faces.size()) {
        for (std::size_t face = 0; face < solid.faces.size(); ++face) {
            make(solid, solid.faces[face], options, patterns_[face]);
        }
    }

    [[nodiscard]] const std::vector<RolePattern>& operator[](std::size_t face) const { return patterns_[face]; }

private:
    using Weighted = std::vector<std::pair<double, RolePattern>>;
    static constexpr std::size_t max_free = 12;    ///< of the vertices that may be corners, the sharpest are tried
    static constexpr std::size_t max_notches = 6;  ///< of the vertices that may be flattened, the first are

    static void make(const SolidBoundary& solid, const SolidBoundary::Face& f, const StackingOptions& options,
                     std::vector<RolePattern>& result);

    /// Makes \p missing more corners of vertices of \p free from position \p at on, in all ways.
    static void choose_corners(const std::vector<double>& angles, const std::vector<std::size_t>& free, std::size_t at,
                               int missing, std::vector<int>& turns, Weighted& result);

    /// Sees vertices of \p notches from position \p at on as flat or not, in all ways, then chooses corners.
    static void flatten_notches(const std::vector<double>& angles, const std::vector<std::size_t>& notches,
                                std::size_t at, const std::vector<std::size_t>& free, int missing,
                                std::vector<int>& turns, Weighted& result);

    static void add_rotations(const std::vector<double>& angles, const std::vector<int>& turns, Weighted& result);

    std::vector<std::vector<RolePattern>> patterns_;
};

/// Depth-first search over the ways to see each side face as a rectangle, most constrained face first, best angles
/// first; the first consistent assignment that makes a sweep is taken.
class StackingSearch {
public:
    /// \p tests_left counts down the ways to see a face that are tried, over all searches of a solid.
    StackingSearch(const SolidBoundary& solid, const RolePatterns& patterns, std::size_t source, std::size_t target,
                   std::size_t& tests_left)
        : solid_(solid), patterns_(patterns), source_(source), target_(target), tests_left_(tests_left) {}

    [[nodiscard]] std::optional<SweepTopology> run();

private:
    /// Every side face has a pattern.
    [[nodiscard]] bool possible() const;

    /// The pattern agrees with the caps and the roles given so far. \p known counts the half-edges that it had to meet.
    [[nodiscard]] bool fits(std::size_t face, const RolePattern& pattern, std::size_t& known) const;

    /// The patterns of a face that fit; \p known tells whether the face had anything to meet.
    [[nodiscard]] std::vector<const RolePattern*> fitting_patterns(std::size_t face, bool& known);

    /// The unfinished face with the fewest fitting patterns, of those that have something to meet if there are any;
    /// faces.size() if all are done.
    [[nodiscard]] std::size_t pick(std::vector<const RolePattern*>& fitting);

    void extend();

    [[nodiscard]] std::ptrdiff_t offset(std::size_t face) const {
        return static_cast<std::ptrdiff_t>(solid_.faces[face].begin);
    }
    [[nodiscard]] std::ptrdiff_t end_offset(std::size_t face) const {
        return static_cast<std::ptrdiff_t>(solid_.faces[face].end);
    }

    const SolidBoundary& solid_;
    const RolePatterns& patterns_;
    std::size_t source_, target_;
    std::size_t& tests_left_;
    std::vector<SideRole> roles_;
    std::vector<bool> done_;
    std::optional<SweepTopology> found_;
};

/// A sweep from \p source to \p target (positions) with sides above each other, or nothing. Exact for the angles that
/// \p patterns allow as long as \p tests_left, which is counted down, does not reach 0.
[[nodiscard]] inline std::optional<SweepTopology> find_stacked_sweep(const SolidBoundary& solid,
                                                                     const RolePatterns& patterns, std::size_t source,
                                                                     std::size_t target, std::size_t& tests_left) {
    return tests_left == 0 ? std::nullopt : StackingSearch(solid, patterns, source, target, tests_left).run();
}

}  // namespace detail

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/one_to_one/side_stacking-inl.hpp>
#endif
