#pragma once
/// \file
/// The quads of a hexahedral mesh, each with its hexahedra: flat arrays, no hashing.

#include <pavior/mesh/mesh_access.hpp>

#include <algorithm>
#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace pavior {

/// Quad \p face (0..5, as in hex_faces) of a hexahedron, counter-clockwise seen from outside.
[[nodiscard]] constexpr QuadCorners hex_face(const HexCorners& corners, std::size_t face) {
    const auto& local = hex_faces[face];
    return {corners[static_cast<std::size_t>(local[0])], corners[static_cast<std::size_t>(local[1])],
            corners[static_cast<std::size_t>(local[2])], corners[static_cast<std::size_t>(local[3])]};
}

/// The same quad, in the same sense, starting at its smallest node.
[[nodiscard]] constexpr QuadCorners from_smallest(const QuadCorners& quad) {
    std::size_t first = 0;
    for (std::size_t k = 1; k < 4; ++k) {
        first = quad[k] < quad[first] ? k : first;
    }
    return {quad[first], quad[(first + 1) % 4], quad[(first + 2) % 4], quad[(first + 3) % 4]};
}

/// True if \p b is \p a seen from the other side.
[[nodiscard]] constexpr bool opposite(const QuadCorners& a, const QuadCorners& b) {
    return from_smallest({a[3], a[2], a[1], a[0]}) == from_smallest(b);
}

/// All quads of a hexahedral mesh, filed under their smallest node. Corners must be in range.
/// 8 bytes a quad of a hexahedron and 8 a node; O(n), apart from sorting the few quads of each node.
class FaceTable {
public:
    /// One hexahedron on a quad.
    struct Use {
        std::array<Index, 3> others{};  ///< nodes of the quad but the smallest, ascending
        std::uint64_t face = 0;         ///< 6 * hexahedron + face, as in hex_faces

        [[nodiscard]] Index hex() const { return static_cast<Index>(face / 6); }
        [[nodiscard]] std::size_t local() const { return static_cast<std::size_t>(face % 6); }
        friend constexpr auto operator<=>(const Use&, const Use&) = default;
    };

    /// The quads of all hexahedra h but those with skip[h] != 0 (empty: all).
    template <hex_mesh M>
    explicit FaceTable(const M& mesh, std::span<const char> skip = {}) : ends_(pavior::node_count(mesh) + 1, 0) {
        const auto each_face = [&](auto&& body) {
            for (const Index h : IndexRange(pavior::hex_count(mesh))) {
                if (!skip.empty() && skip[h] != 0) {
                    continue;
                }
                const HexCorners corners = hex(mesh, h);
                for (std::size_t f = 0; f < 6; ++f) {
                    const QuadCorners c = hex_face(corners, f);
                    body(std::min(std::min(c[0], c[1]), std::min(c[2], c[3])), 6 * std::uint64_t{h} + f);
                }
            }
        };
        each_face([&](Index low, std::uint64_t) { ++ends_[low + std::size_t{1}]; });
        for (std::size_t i = 1; i < ends_.size(); ++i) {
            ends_[i] += ends_[i - 1];
        }
        faces_.resize(ends_.back());
        // From here ends_[i] runs from the begin of node i's quads to their end, which is the begin of node i + 1.
        each_face([&](Index low, std::uint64_t face) { faces_[ends_[low]++] = face; });
    }

    /// Nodes of the mesh.
    [[nodiscard]] std::size_t node_count() const { return ends_.size() - 1; }

    /// Calls visit(low, uses) for every quad whose smallest node `low` lies in [first, last), ascending by its nodes;
    /// `uses` is a span of Use, ascending by hexahedron. \p mesh is the one the table was made of. Thread-safe.
    template <hex_mesh M, class Visit>
    void for_each(const M& mesh, std::size_t first, std::size_t last, Visit&& visit) const {
        std::vector<Use> uses;
        for (std::size_t low = first; low < last; ++low) {
            uses.clear();
            for (std::size_t i = low == 0 ? 0 : ends_[low - 1]; i < ends_[low]; ++i) {
                uses.push_back(use(mesh, faces_[i]));
            }
            std::sort(uses.begin(), uses.end());
            for (std::size_t i = 0; i < uses.size();) {
                std::size_t end = i + 1;
                while (end < uses.size() && uses[end].others == uses[i].others) {
                    ++end;
                }
                visit(static_cast<Index>(low), std::span<const Use>(uses).subspan(i, end - i));
                i = end;
            }
        }
    }

private:
    template <hex_mesh M>
    [[nodiscard]] static Use use(const M& mesh, std::uint64_t face) {
        QuadCorners c = hex_face(hex(mesh, static_cast<Index>(face / 6)), static_cast<std::size_t>(face % 6));
        std::sort(c.begin(), c.end());
        return {{c[1], c[2], c[3]}, face};
    }

    std::vector<std::size_t> ends_;
    std::vector<std::uint64_t> faces_;
};

}  // namespace pavior
