#pragma once
/// \file
/// Numbers of intervals for models of submapped (and swept) solids.

#include <pavior/intervals/solve_intervals.hpp>
#include <pavior/one_to_one/intervals.hpp>
#include <pavior/submap/submap_check.hpp>
#include <pavior/submap/submap_distances.hpp>
#include <pavior/submap/submap_rules.hpp>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

namespace pavior {

/// How the vertices of a solid are lined up on its lattice, where the other rules admit it.
struct LevelOptions {
    /// Vertices of one height along a logical axis get one lattice coordinate, so that a solid with axis-parallel edges
    /// gets a grid of straight lines.
    bool agree = true;
    /// Vertices whose heights differ by more than this, relative to the size, get different coordinates. Less shear,
    /// but thinner layers. Infinity: only where an edge or a distance asks for it.
    double distinct = std::numeric_limits<double>::infinity();
};

/// An interval assignment with what submapping needs beside it.
struct SubmapIntervals {
    IntervalAssignment assignment;  ///< of edges, and layers of the sweeps
    SubmapNumbers numbers;          ///< the intervals of the edges again, and the places of inner loops
    std::vector<std::vector<double>>
        fractions;             ///< by edge id: places of its nodes, 0 to 1 of its length, so that they
                               ///< follow the layers of the lattice; empty for edges of sweeps only
    bool levels_agree = true;  ///< vertices of one height along a logical axis have one lattice coordinate
};

namespace detail {

/// Solves, adds the distance rules that the solution breaks, and so on until none is broken.
template <brep B, integer_solver Solver>
[[nodiscard]] IntervalResult solve_apart(IntervalSystem& system, const SubmapDistances<B>& distances, double margin,
                                         Solver& solver, bool relax, bool& angles_kept) {
    for (;;) {
        const IntervalResult result =
            relax ? solve_relaxing_angles(system, solver, angles_kept) : solve_intervals(system, solver);
        if (result.numbers.empty()) {
            return result;
        }
        std::vector<IntervalRule> more = distances.rules(result.numbers, margin);
        if (more.empty()) {
            return result;
        }
        system.rules.insert(system.rules.end(), more.begin(), more.end());
    }
}

}  // namespace detail

/// Assigns numbers of intervals to all edges of the solids of \p sweeps and \p submaps (one model, each solid once),
/// taken together so that shared faces agree. Rules for sweeps and the cost as in assign_intervals(). For submapped
/// solids: every loop of every face closes on the lattice, holes lie inside their faces, ways round holes and handles
/// agree, and faces that look at each other, through the solid or across a gap, stay at least one element apart.
/// Numbers of layers in \p options concern sweeps only.
/// \throws UnmeshableError infeasible_intervals as assign_intervals(); not_submappable naming faces if the lattice of a
/// solid would overlap itself whatever the numbers. InputError bad_option.
template <brep B, integer_solver Solver>
[[nodiscard]] SubmapIntervals assign_submap_intervals(const B& b, std::span<const SweepTopology> sweeps,
                                                      const SubmapModel& submaps, const IntervalOptions& options,
                                                      const LevelOptions& levels, Solver&& solver) {
    std::vector<SolidId> solids;
    for (const SubmapTopology& solid : submaps.solids) {
        solids.push_back(solid.solid);
    }
    detail::IntervalBuilder<B> builder(b, sweeps, options, solids);
    detail::SubmapRules<B> rules(b, submaps, builder, options);
    const detail::SubmapDistances<B> distances(b, submaps, rules.solids());
    SubmapIntervals result;
    const auto take = [&](const IntervalResult& solved) {
        result.numbers.edges.assign(b.edge_count(), 0);
        for (std::size_t i = 0; i < builder.edges().size(); ++i) {
            result.numbers.edges[builder.edges()[i].index()] = solved.numbers[i];
        }
        result.numbers.links = rules.links(solved.numbers);
        return overlapping_faces(b, submaps, result.numbers);
    };
    const auto try_levels = [&](double margin, bool& kept) {
        IntervalSystem tied = builder.system();
        const std::vector<IntervalRule> more = rules.level_rules(1e-4 * options.size, levels.distinct * options.size);
        tied.rules.insert(tied.rules.end(), more.begin(), more.end());
        return detail::solve_apart(tied, distances, margin, solver, false, kept);
    };
    IntervalResult solved;
    for (const double margin : {0.0, options.size}) {
        solved = levels.agree ? try_levels(margin, result.assignment.angles_kept) : IntervalResult{};
        result.levels_agree = !solved.numbers.empty();
        if (!result.levels_agree) {
            solved =
                detail::solve_apart(builder.system(), distances, margin, solver, true, result.assignment.angles_kept);
        }
        const std::vector<int> overlap = take(solved);
        if (overlap.empty()) {
            break;
        }
        if (margin > 0.0) {
            throw UnmeshableError(
                ErrorCode::not_submappable,
                "the logical boxes of " + detail::list({overlap.begin(), overlap.end()}, "face", "faces") + " overlap",
                Error::Ids(overlap.begin(), overlap.end()));
        }
    }
    result.fractions = rules.fractions(solved.numbers);
    detail::fill_assignment(builder.system(), builder.edges(), sweeps, b.edge_count(), solved, result.assignment);
    return result;
}

}  // namespace pavior
