#pragma once
/// \file
/// Quads on hexahedra: which hexahedra they are faces of, and turned so that they look outward.

#include <pavior/core/index.hpp>
#include <pavior/mesh/cells.hpp>
#include <pavior/mesh/face_table.hpp>
#include <pavior/mesh/grouped_mesh.hpp>
#include <pavior/mesh/mesh_access.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace pavior {

/// One face of a hexahedron.
struct HexFace {
    Index hex = no_index;  ///< no_index: none
    std::size_t face = 0;  ///< position in hex_faces

    friend bool operator==(const HexFace&, const HexFace&) = default;
};

namespace detail {

/// Quads by their sorted nodes; a mark for each node that is the smallest of a quad tells most faces off at once.
class QuadTable {
public:
    explicit QuadTable(std::span<const QuadCorners> quads) {
        rows_.reserve(quads.size());
        for (std::size_t q = 0; q < quads.size(); ++q) {
            rows_.emplace_back(sorted(quads[q]), q);
        }
        std::sort(rows_.begin(), rows_.end());
        known_.assign(rows_.empty() ? std::size_t{0} : std::size_t{rows_.back().first[0]} + 1, 0);
        for (const auto& row : rows_) {
            known_[row.first[0]] = 1;
        }
    }

    /// Calls body(q) for each quad with the nodes of \p face.
    template <class Body>
    void for_each(const QuadCorners& face, Body&& body) const {
        const Index smallest = std::min(std::min(face[0], face[1]), std::min(face[2], face[3]));
        if (smallest >= known_.size() || known_[smallest] == 0) {
            return;
        }
        const QuadCorners key = sorted(face);
        for (auto row = std::lower_bound(rows_.begin(), rows_.end(), std::pair(key, std::size_t{0}));
             row != rows_.end() && row->first == key; ++row) {
            body(row->second);
        }
    }

private:
    [[nodiscard]] static QuadCorners sorted(QuadCorners corners) {
        std::sort(corners.begin(), corners.end());
        return corners;
    }

    std::vector<std::pair<QuadCorners, std::size_t>> rows_;
    std::vector<char> known_;
};

}  // namespace detail

/// For each of \p quads the first two faces of hexahedra with its nodes, in whatever order, by ascending hexahedron;
/// equal quads have equal faces. Quads whose nodes are not those of a face have none. O(hexahedra + quads log quads).
template <hex_mesh M>
[[nodiscard]] std::vector<std::array<HexFace, 2>> faces_under_quads(const M& mesh, std::span<const QuadCorners> quads) {
    std::vector<std::array<HexFace, 2>> result(quads.size());
    const detail::QuadTable table(quads);
    for (const Index h : IndexRange(quads.empty() ? 0 : hex_count(mesh))) {
        const HexCorners corners = hex(mesh, h);
        for (std::size_t f = 0; f < hex_faces.size(); ++f) {
            table.for_each(hex_face(corners, f), [&](std::size_t q) {
                HexFace& place = result[q][result[q][0].hex == no_index ? 0 : 1];
                if (place.hex == no_index) {
                    place = {h, f};
                }
            });
        }
    }
    return result;
}

/// Turns the \p quads on \p mesh that look inward: each becomes counter-clockwise seen from outside of its hexahedron;
/// with hexahedra on both sides, seen from outside of the one whose group has the lower number. Quads between hexahedra
/// of one group, and those on none, stay as they are. A quad that is turned keeps its first node, the others keep all.
/// \param hex_groups  a group number a hexahedron, or empty: all in one. Must be as long as there are hexahedra
/// O(hexahedra + quads log quads).
template <hex_mesh M>
void turn_quads_outward(const M& mesh, std::span<const std::int32_t> hex_groups, std::span<QuadCorners> quads) {
    const auto faces = faces_under_quads(mesh, quads);
    const auto group = [&](const HexFace& face) { return hex_groups.empty() ? 0 : hex_groups[face.hex]; };
    for (std::size_t q = 0; q < quads.size(); ++q) {
        const auto& [first, second] = faces[q];
        const bool shared = first.hex != no_index && second.hex != no_index;
        if (first.hex == no_index || (shared && group(first) == group(second))) {
            continue;
        }
        const HexFace& own = shared && group(second) < group(first) ? second : first;
        const QuadCorners turned{quads[q][0], quads[q][3], quads[q][2], quads[q][1]};
        if (from_smallest(turned) == from_smallest(hex_face(hex(mesh, own.hex), own.face))) {
            quads[q] = turned;
        }
    }
}

/// The same for what a mesh file holds.
inline void turn_quads_outward(HexMeshData& data) { turn_quads_outward(data.mesh, data.hex_groups, data.quads); }

}  // namespace pavior
