#pragma once
/// \file
/// Any classified tetrahedral mesh as a ReferenceMesh.

#include <pavior/dual/reference_mesh.hpp>

#include <type_traits>

namespace pavior::detail {

/// A copy of \p mesh; a ReferenceMesh keeps everything it has. O(n).
template <classified_tet_mesh M>
[[nodiscard]] ReferenceMesh copy_reference(const M& mesh) {
    if constexpr (std::is_same_v<M, ReferenceMesh>) {
        return mesh;
    } else {
        ReferenceMesh out;
        out.nodes.reserve(node_count(mesh));
        for (const Index i : IndexRange(node_count(mesh))) {
            out.nodes.push_back(node(mesh, i));
        }
        out.tets.reserve(tet_count(mesh));
        for (const Index t : IndexRange(tet_count(mesh))) {
            out.tets.push_back(tet(mesh, t));
        }
        using access = feature_access<M>;
        for (const TaggedTriangle& face : access::patches(mesh)) {
            out.patches.push_back(face);
        }
        for (const FeatureEdge& edge : access::curves(mesh)) {
            out.curves.push_back(edge);
        }
        for (const TaggedNode& vertex : access::vertices(mesh)) {
            out.vertices.push_back(vertex);
        }
        for (const TriCorners& layer : access::layers(mesh)) {
            out.layers.push_back(layer);
        }
        return out;
    }
}

}  // namespace pavior::detail
