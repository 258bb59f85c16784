#pragma once
/// \file
/// Levels of caps: the layers of a body that is swept from many sources to many targets, by an integer program.

#include <pavior/core/compiled.hpp>
#include <pavior/core/disjoint_sets.hpp>
#include <pavior/intervals/solve_intervals.hpp>
#include <pavior/many_to_many/caps_over_cells.hpp>

#include <algorithm>
#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace pavior {

/// The number of layers below each entity, counted from the lowest one that it is connected with. Entities that meet
/// have one level: a cap, the curves that bound it, and their vertices.
struct CapLevels {
    std::vector<int> caps, curves, vertices;
    int count = 0;             ///< of the highest level
    double worst_ratio = 1.0;  ///< largest deviation of a number of layers from the wish, max(n / wish, wish / n)
    bool optimal = true;
};

/// When heights count as equal.
struct LevelTolerance {
    double height = 0;  ///< everywhere
    double slack = 0;   ///< on edges, for entities that are of one level anyhow: curves may have moved there
};

namespace detail {

/// Curves along each edge of the arrangement, ascending.
[[nodiscard]] PAVIOR_INLINE std::vector<std::vector<Index>> curves_of_edges(const PlaneArrangement& plane);

/// Entities of a body in one numbering: caps, then curves, then vertices; joined into classes of one level.
class LevelClasses {
public:
    explicit LevelClasses(const ExtrudedBody& body);

    [[nodiscard]] std::size_t cap_count() const { return body_.caps.size(); }
    [[nodiscard]] std::size_t curve_count() const { return body_.curves.size(); }
    [[nodiscard]] std::size_t size() const { return sets_.size(); }
    [[nodiscard]] std::size_t find(std::size_t i) const { return sets_.root(i); }
    void join(std::size_t a, std::size_t b) { sets_.unite(a, b); }
    /// A name for messages and the tag of a face, 0 if it is none.
    [[nodiscard]] std::pair<std::string, int> name(std::size_t item) const;

private:
    const ExtrudedBody& body_;
    DisjointSets<std::size_t> sets_;
};

/// An entity met by a line along the direction.
struct ColumnItem {
    double height;
    std::size_t item;

    friend constexpr auto operator<=>(const ColumnItem&, const ColumnItem&) = default;
};

/// What a line along the direction meets.
struct LevelColumn {
    std::vector<ColumnItem> items;  ///< ascending
    bool inside = false;            ///< the line runs inside a cell, not on an edge
};

/// The vertex of the arrangement at which each vertex of a body lies that is the end of a curve; no_index for others.
[[nodiscard]] PAVIOR_INLINE std::vector<Index> plane_vertices(const ExtrudedBody& body, const PlaneArrangement& plane);

/// Lines inside each cell, on each edge, and at each vertex of the arrangement. Curves count where they bound no cap,
/// given vertices of ribs between their ends.
template <extruded_geometry G>
[[nodiscard]] std::vector<LevelColumn> level_columns(const ExtrudedBody& body, const G& geometry,
                                                     const PlaneArrangement& plane,
                                                     const std::vector<CapsOverCell>& stacks) {
    const std::size_t first_edge = plane.cells.size();
    const std::size_t first_vertex = first_edge + plane.edges.size();
    std::vector<LevelColumn> columns(first_vertex + plane.vertices.size());
    const auto add_caps = [&](std::size_t column, Index cell, const Vec2& at) {
        for (const Index c : stacks[cell].caps) {
            columns[column].items.push_back({geometry.cap_height(c, at), c});
        }
    };
    std::vector<char> bounds_cap(body.curves.size(), 0);
    for (const ExtrudedCap& cap : body.caps) {
        for (const Index c : cap.curves) {
            bounds_cap[c] = 1;
        }
    }
    for (Index cell = 0; cell < plane.cells.size(); ++cell) {
        add_caps(cell, cell, plane.cells[cell].inside);
        columns[cell].inside = true;
    }
    const auto curves = curves_of_edges(plane);
    for (std::size_t e = 0; e < plane.edges.size(); ++e) {
        const PlaneEdge& edge = plane.edges[e];
        const auto add = [&](std::size_t column, const Vec2& at) {
            for (const Index cell : edge.cells) {
                if (cell != no_index) {
                    add_caps(column, cell, at);
                }
            }
            for (const Index c : curves[e]) {
                if (bounds_cap[c] == 0) {
                    const Vec3 point = geometry.curve_point(c, at);
                    columns[column].items.push_back({point[2], body.caps.size() + c});
                }
            }
        };
        add(first_edge + e, middle_point(edge));
        for (const Index v : edge.vertices) {
            add(first_vertex + v, plane.vertices[v]);
        }
    }
    const std::vector<Index> at = body.ribs.empty() ? std::vector<Index>{} : plane_vertices(body, plane);
    for (const ExtrudedRib& rib : body.ribs) {
        for (std::size_t i = 1; i + 1 < rib.vertices.size(); ++i) {
            columns[first_vertex + at[rib.vertices.front()]].items.push_back(
                {body.vertices[rib.vertices[i]][2], body.caps.size() + body.curves.size() + rib.vertices[i]});
        }
    }
    for (LevelColumn& column : columns) {
        std::sort(column.items.begin(), column.items.end());
        column.items.erase(std::unique(column.items.begin(), column.items.end()), column.items.end());
    }
    return columns;
}

/// Layers between two classes that follow each other in a column.
struct LevelGap {
    std::size_t low, high;            ///< classes
    std::size_t low_item, high_item;  ///< where it was found first
    double length = 0;                ///< sum over the columns
    int columns = 0;
};

/// The gaps between neighbouring classes of all columns; items of one height join their classes.
[[nodiscard]] PAVIOR_INLINE std::vector<LevelGap> level_gaps(const std::vector<LevelColumn>& columns,
                                                             LevelClasses& classes, const LevelTolerance& tolerance);

/// Numbers of layers as an interval system: one number a gap, and along every cycle of gaps they cancel.
class LevelSystem {
public:
    LevelSystem(const LevelClasses& classes, const std::vector<LevelGap>& gaps, double size);

    [[nodiscard]] const IntervalSystem& system() const { return system_; }

    /// Adds the demand that class \p high lies one layer above class \p low. \p text names both.
    void add_step(std::size_t low, std::size_t high, const std::string& text, int face);

    /// Levels of the classes, 0 for the lowest of each connected part.
    [[nodiscard]] std::vector<int> levels(const std::vector<int>& numbers) const;

private:
    struct Branch {
        std::size_t root = 0;
        std::vector<std::pair<std::size_t, int>> path;  ///< gaps from the root, + upwards
    };

    void check(const LevelGap& gap) const;

    void grow(std::size_t root, const std::multimap<std::size_t, std::size_t>& at, std::vector<bool>& done,
              std::vector<bool>& in_tree);

    void add_cycle(std::size_t g);

    /// The number of layers between two classes as a sum over gaps.
    [[nodiscard]] std::map<std::size_t, int> layers_between(std::size_t low, std::size_t high) const;

    const LevelClasses& classes_;
    const std::vector<LevelGap>& gaps_;
    std::vector<Branch> tree_;
    std::vector<std::size_t> order_;
    IntervalSystem system_;
};

/// The steps of \p body as demands of \p system, each pair of classes once.
PAVIOR_INLINE void add_steps(const ExtrudedBody& body, const LevelClasses& classes, LevelSystem& system);

}  // namespace detail

/// Assigns levels such that every entity that lies above another one has a higher level, and gaps are divided as
/// evenly into layers of height \p size as that allows; the steps of the body are one layer high. \p solver turns an
/// IntegerProgram into an IntegerSolution.
/// \throws UnmeshableError not_sweepable naming faces where slanted caps lead from one level to another that lies above
/// it; infeasible_intervals where no levels satisfy all columns and steps
template <extruded_geometry G, integer_solver Solver>
[[nodiscard]] CapLevels solve_level_program(const ExtrudedBody& body, const G& geometry, const PlaneArrangement& plane,
                                            const std::vector<CapsOverCell>& stacks, double size,
                                            const LevelTolerance& tolerance, Solver&& solver) {
    detail::LevelClasses classes(body);
    const std::vector<detail::LevelGap> gaps =
        detail::level_gaps(detail::level_columns(body, geometry, plane, stacks), classes, tolerance);
    detail::LevelSystem system(classes, gaps, size);
    detail::add_steps(body, classes, system);
    const IntervalResult solved = solve_intervals(system.system(), solver);
    if (solved.numbers.empty() && !gaps.empty()) {
        throw detail::interval_error(system.system(), solved, solver);
    }
    const std::vector<int> level = system.levels(solved.numbers);
    CapLevels result;
    result.optimal = solved.status == ProgramStatus::optimal;
    for (std::size_t i = 0; i < classes.size(); ++i) {
        const int at = level[classes.find(i)];
        result.count = std::max(result.count, at);
        (i < classes.cap_count()                           ? result.caps
         : i < classes.cap_count() + classes.curve_count() ? result.curves
                                                           : result.vertices)
            .push_back(at);
    }
    for (std::size_t g = 0; g < gaps.size(); ++g) {
        result.worst_ratio =
            std::max(result.worst_ratio, 1 + interval_cost(solved.numbers[g], system.system().edges[g].wish));
    }
    return result;
}

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/many_to_many/level_program-inl.hpp>
#endif
