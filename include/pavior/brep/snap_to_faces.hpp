#pragma once
/// \file
/// Boundary nodes of a mesh, moved onto the faces that they stand for.

#include <pavior/brep/brep.hpp>
#include <pavior/brep/face_distance.hpp>
#include <pavior/mesh/cells.hpp>

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace pavior {

/// Moves every node of \p quads onto the surfaces of the faces of its quads, by closest points on one after the other
/// until it stays, if that takes it no farther than \p within from where it was; otherwise it is not moved.
/// \param faces  the face of each quad
/// \return how many nodes were left because they would have moved too far
/// O(quads log quads), a few closest points for each node and face. \throws InputError size_mismatch
template <brep B>
std::size_t snap_to_faces(const B& body, std::span<Vec3> nodes, std::span<const QuadCorners> quads,
                          std::span<const FaceId> faces, double within) {
    detail::check_quad_faces(quads, faces);
    constexpr int rounds = 20;
    std::vector<std::pair<Index, FaceId>> uses;
    uses.reserve(4 * quads.size());
    for (std::size_t q = 0; q < quads.size(); ++q) {
        for (const Index i : quads[q]) {
            uses.emplace_back(i, faces[q]);
        }
    }
    std::sort(uses.begin(), uses.end());
    uses.erase(std::unique(uses.begin(), uses.end()), uses.end());
    std::size_t left = 0;
    for (std::size_t first = 0, last = 0; first < uses.size(); first = last) {
        const Index node = uses[first].first;
        while (last < uses.size() && uses[last].first == node) {
            ++last;
        }
        Vec3 x = nodes[node];
        double moved = within;
        for (int k = 0; k < rounds && moved > 1e-9 * within; ++k) {
            moved = 0.0;
            for (std::size_t u = first; u < last; ++u) {
                const Vec3 on = body.face_point(uses[u].second, body.closest_on_face(uses[u].second, x));
                moved = std::max(moved, (on - x).norm());
                x = on;
            }
        }
        const bool far = !((x - nodes[node]).norm() <= within);
        left += far ? 1U : 0U;
        nodes[node] = far ? nodes[node] : x;
    }
    return left;
}

}  // namespace pavior
