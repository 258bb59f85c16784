#pragma once
/// \file
/// Is a triangle surface the boundary of solids? Compiled component `tetra`: the geometric tests are exact.

#include <pavior/core/error.hpp>
#include <pavior/mesh/mesh_access.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace pavior {

/// Kinds of faults of a surface, in the order in which they are reported.
enum class SurfaceFault : std::uint8_t {
    empty,             ///< no triangle
    not_finite,        ///< triangle with a NaN or infinite coordinate
    id_out_of_range,   ///< triangle with a node id that does not exist
    repeated_node,     ///< triangle that names a node twice
    unused_node,       ///< node of no triangle
    degenerate,        ///< triangle without area: its corners lie on a line, or as good as (1e-14 of its longest edge)
    duplicate,         ///< triangles on the same three nodes
    coincident_nodes,  ///< two nodes in one place: a surface not welded, or shells that touch there
    open_edge,         ///< edge of one triangle
    overused_edge,     ///< edge of more than two triangles: shells that touch along it, or a wall inside
    same_sense,        ///< edge whose two triangles run along it in the same sense: they see different sides
    touching_node,     ///< node where two fans of triangles meet that share no edge there
    intersection,      ///< two triangles that cross, overlap, or touch where they share no node
    inside_out,        ///< shell whose normals point to the wrong side (a cavity's point into the cavity)
};

/// One phrase about \p fault.
[[nodiscard]] std::string_view to_string(SurfaceFault fault) noexcept;

/// The error code that throw_if_bad() uses for \p fault.
[[nodiscard]] ErrorCode error_code(SurfaceFault fault) noexcept;

/// All faults of one kind: how many, and the first ones.
struct SurfaceFinding {
    /// One fault: the triangles that have it (all on the edge or in the place; the smallest one of a shell), and the
    /// nodes where it is, if it is at nodes.
    struct Item {
        std::vector<Index> triangles;
        std::vector<Index> nodes;

        friend bool operator==(const Item&, const Item&) = default;
    };

    SurfaceFault fault = SurfaceFault::empty;
    std::size_t count = 0;    ///< exact; intersections are counted up to 10000
    std::vector<Item> items;  ///< the first min(count, 16), in ascending order of their edges, nodes or triangles
};

/// Findings of check_surface(), at most one of a kind, in the order of SurfaceFault. Empty: the surface is sound.
class SurfaceReport {
public:
    [[nodiscard]] bool ok() const { return findings_.empty(); }
    [[nodiscard]] const std::vector<SurfaceFinding>& findings() const { return findings_; }
    /// The finding of this kind, null if there is none.
    [[nodiscard]] const SurfaceFinding* find(SurfaceFault fault) const;
    /// Number of faults of this kind.
    [[nodiscard]] std::size_t count(SurfaceFault fault) const;
    /// One line a finding: "2 open edges: 3 4 (triangle 7), 4 5 (triangle 9)"; empty if there is none.
    [[nodiscard]] std::string text() const;
    /// Throws InputError with the code of the first finding, the text of all, and the triangles of the first (its nodes
    /// where it has no triangles); nothing if there is none.
    void throw_if_bad() const;

    /// Records a fault.
    void add(SurfaceFault fault, SurfaceFinding::Item item);

private:
    std::vector<SurfaceFinding> findings_;
};

/// Checks that \p triangles, counter-clockwise seen from outside, are the boundary of one or several solids, with or
/// without cavities, and name each triangle that stands in the way. Intersections are looked for among triangles that
/// are not degenerate; shells are compared with each other where all edges are sound. Coordinates of any magnitude.
/// O(n log n) for surfaces without great heaps of overlapping triangles. Thread-safe; deterministic.
[[nodiscard]] SurfaceReport check_surface(std::span<const Vec3> nodes, std::span<const TriCorners> triangles);

/// The same for any triangle mesh.
template <triangle_mesh M>
[[nodiscard]] SurfaceReport check_surface(const M& mesh) {
    std::vector<Vec3> nodes;
    std::vector<TriCorners> triangles;
    nodes.reserve(node_count(mesh));
    triangles.reserve(triangle_count(mesh));
    for (const Index i : IndexRange(node_count(mesh))) {
        nodes.push_back(node(mesh, i));
    }
    for (const Index t : IndexRange(triangle_count(mesh))) {
        triangles.push_back(triangle(mesh, t));
    }
    return check_surface(std::span<const Vec3>(nodes), std::span<const TriCorners>(triangles));
}

}  // namespace pavior
