#pragma once

#include <pavior/mesh/face_table.hpp>
#include <pavior/mesh/outward_quads.hpp>

#include <algorithm>
#include <utility>

namespace pavior {

namespace detail {

[[nodiscard]] inline QuadCorners sorted_corners(QuadCorners corners) {
    std::sort(corners.begin(), corners.end());
    return corners;
}

/// Quads by their sorted nodes; found by a table of their smallest nodes first.
class QuadTable {
public:
    explicit QuadTable(std::span<const QuadCorners> quads) {
        rows_.reserve(quads.size());
        for (std::size_t q = 0; q < quads.size(); ++q) {
            rows_.emplace_back(sorted_corners(quads[q]), q);
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
        const QuadCorners key = sorted_corners(face);
        for (auto row = std::lower_bound(rows_.begin(), rows_.end(), std::pair(key, std::size_t{0}));
             row != rows_.end() && row->first == key; ++row) {
            body(row->second);
        }
    }

private:
    std::vector<std::pair<QuadCorners, std::size_t>> rows_;
    std::vector<char> known_;  ///< by node: is it the smallest of a quad?
};

}  // namespace detail

PAVIOR_INLINE std::vector<std::array<HexFace, 2>> faces_under_quads(std::span<const HexCorners> hexes,
                                                                    std::span<const QuadCorners> quads) {
    std::vector<std::array<HexFace, 2>> result(quads.size());
    const detail::QuadTable table(quads);
    for (std::size_t h = 0; h < hexes.size() && !quads.empty(); ++h) {
        for (std::size_t f = 0; f < hex_faces.size(); ++f) {
            table.for_each(hex_face(hexes[h], f), [&](std::size_t q) {
                HexFace& place = result[q][result[q][0].hex == no_index ? 0 : 1];
                if (place.hex == no_index) {
                    place = {static_cast<Index>(h), f};
                }
            });
        }
    }
    return result;
}

PAVIOR_INLINE void turn_quads_outward(HexMeshData& data) {
    const auto faces = faces_under_quads(data.mesh.hexes, data.quads);
    const auto group = [&](const HexFace& face) { return data.hex_groups.empty() ? 0 : data.hex_groups[face.hex]; };
    for (std::size_t q = 0; q < data.quads.size(); ++q) {
        const auto& [first, second] = faces[q];
        const bool shared = first.hex != no_index && second.hex != no_index;
        if (first.hex == no_index || (shared && group(first) == group(second))) {
            continue;
        }
        const HexFace& own = shared && group(second) < group(first) ? second : first;
        QuadCorners& quad = data.quads[q];
        const QuadCorners turned{quad[0], quad[3], quad[2], quad[1]};
        if (from_smallest(turned) == from_smallest(hex_face(data.mesh.hexes[own.hex], own.face))) {
            quad = turned;
        }
    }
}

}  // namespace pavior
