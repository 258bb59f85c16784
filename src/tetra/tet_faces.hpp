#pragma once
// Who is beside whom in a set of tetrahedra. Internal to the tetra component.

#include <pavior/mesh/cells.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace pavior::detail {

/// Face \p face of a tetrahedron, counter-clockwise seen from outside.
[[nodiscard]] inline TriCorners tet_face(const TetCorners& tet, std::size_t face) {
    const auto& local = tet_faces[face];
    return {tet[static_cast<std::size_t>(local[0])], tet[static_cast<std::size_t>(local[1])],
            tet[static_cast<std::size_t>(local[2])]};
}

/// The faces of tetrahedra, filed under their smallest node. A face of a tetrahedron is called 4 * tet + face.
class TetFaceTable {
public:
    /// O(n), apart from sorting the few faces of each node; 4 bytes a face while it works.
    TetFaceTable(std::size_t node_count, std::span<const TetCorners> tets);

    /// The face on the other side of a face, or no_index.
    [[nodiscard]] std::uint32_t opposite(std::uint32_t face) const { return opposite_[face]; }
    /// A face with these three nodes, or no_index.
    [[nodiscard]] std::uint32_t find(const TriCorners& nodes) const;
    /// A face that more than two tetrahedra have, or no_index.
    [[nodiscard]] std::uint32_t overused() const { return overused_; }

private:
    [[nodiscard]] TriCorners sorted(std::uint32_t face) const;

    std::span<const TetCorners> tets_;
    std::vector<std::size_t> ends_;
    std::vector<std::uint32_t> faces_;
    std::vector<std::uint32_t> opposite_;
    std::uint32_t overused_ = no_index;
};

}  // namespace pavior::detail
