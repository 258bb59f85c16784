#include "tet_faces.hpp"

#include <algorithm>

namespace pavior::detail {

namespace {

TriCorners ascending(TriCorners nodes) {
    std::sort(nodes.begin(), nodes.end());
    return nodes;
}

}  // namespace

TriCorners TetFaceTable::sorted(std::uint32_t face) const { return ascending(tet_face(tets_[face / 4], face % 4)); }

TetFaceTable::TetFaceTable(std::size_t node_count, std::span<const TetCorners> tets)
    : tets_(tets), ends_(node_count + 1, 0), faces_(4 * tets.size()), opposite_(4 * tets.size(), no_index) {
    const auto count = static_cast<std::uint32_t>(faces_.size());
    for (std::uint32_t face = 0; face < count; ++face) {
        ++ends_[sorted(face)[0] + std::size_t{1}];
    }
    for (std::size_t i = 1; i < ends_.size(); ++i) {
        ends_[i] += ends_[i - 1];
    }
    for (std::uint32_t face = 0; face < count; ++face) {
        faces_[ends_[sorted(face)[0]]++] = face;
    }
    // Now the faces of node i end at ends_[i] and begin where those of node i - 1 end.
    std::size_t begin = 0;
    for (std::size_t node = 0; node < node_count; ++node) {
        const auto first = faces_.begin() + static_cast<std::ptrdiff_t>(begin);
        const auto last = faces_.begin() + static_cast<std::ptrdiff_t>(ends_[node]);
        std::sort(first, last, [&](std::uint32_t a, std::uint32_t b) {
            const TriCorners x = sorted(a);
            const TriCorners y = sorted(b);
            return x != y ? x < y : a < b;
        });
        for (auto at = first; at != last; ++at) {
            if (at != first && sorted(at[-1]) == sorted(at[0])) {
                overused_ = opposite_[at[-1]] != no_index ? *at : overused_;
                opposite_[at[-1]] = at[0];
                opposite_[at[0]] = at[-1];
            }
        }
        begin = ends_[node];
    }
}

std::uint32_t TetFaceTable::find(const TriCorners& nodes) const {
    const TriCorners key = ascending(nodes);
    if (std::size_t{key[2]} + 1 >= ends_.size()) {
        return no_index;
    }
    const auto first = faces_.begin() + static_cast<std::ptrdiff_t>(key[0] == 0 ? 0 : ends_[key[0] - 1]);
    const auto last = faces_.begin() + static_cast<std::ptrdiff_t>(ends_[key[0]]);
    const auto at = std::partition_point(first, last, [&](std::uint32_t face) { return sorted(face) < key; });
    return at != last && sorted(*at) == key ? *at : no_index;
}

}  // namespace pavior::detail
