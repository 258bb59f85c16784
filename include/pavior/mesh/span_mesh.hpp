#pragma once
/// \file
/// Meshes as plain arrays: views over the user's spans, and owning vectors.

#include <pavior/mesh/mesh_access.hpp>

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace pavior {

/// Quad mesh over the user's arrays: nodes[i] is point_like, quads[q] four corner ids. Copies nothing.
template <point_like P = Vec3, class C = QuadCorners>
struct QuadMeshView {
    std::span<const P> nodes;
    std::span<const C> quads;
};

/// Hexahedral mesh over the user's arrays: nodes[i] is point_like, hexes[h] eight corner ids. Copies nothing.
template <point_like P = Vec3, class C = HexCorners>
struct HexMeshView {
    std::span<const P> nodes;
    std::span<const C> hexes;
};

/// Quad mesh that owns its arrays.
struct QuadMesh {
    std::vector<Vec3> nodes;
    std::vector<QuadCorners> quads;
};

/// Hexahedral mesh that owns its arrays.
struct HexMesh {
    std::vector<Vec3> nodes;
    std::vector<HexCorners> hexes;
};

/// Points alone: any contiguous range of them, e.g. the nodes of the target cap.
template <point_like P>
struct mesh_access<std::span<const P>> {
    static std::size_t node_count(std::span<const P> m) { return m.size(); }
    static const P& node(std::span<const P> m, Index i) { return m[i]; }
};
template <point_like P>
struct mesh_access<std::vector<P>> {
    static std::size_t node_count(const std::vector<P>& m) { return m.size(); }
    static const P& node(const std::vector<P>& m, Index i) { return m[i]; }
};

namespace detail {
template <class M>
struct quad_array_access {
    static std::size_t node_count(const M& m) { return m.nodes.size(); }
    static const auto& node(const M& m, Index i) { return m.nodes[i]; }
    static std::size_t quad_count(const M& m) { return m.quads.size(); }
    static const auto& quad(const M& m, Index q) { return m.quads[q]; }
};
template <class M>
struct hex_array_access {
    static std::size_t node_count(const M& m) { return m.nodes.size(); }
    static const auto& node(const M& m, Index i) { return m.nodes[i]; }
    static std::size_t hex_count(const M& m) { return m.hexes.size(); }
    static const auto& hex(const M& m, Index h) { return m.hexes[h]; }
};
}  // namespace detail

template <point_like P, class C>
struct mesh_access<QuadMeshView<P, C>> : detail::quad_array_access<QuadMeshView<P, C>> {};
template <point_like P, class C>
struct mesh_access<HexMeshView<P, C>> : detail::hex_array_access<HexMeshView<P, C>> {};
template <>
struct mesh_access<QuadMesh> : detail::quad_array_access<QuadMesh> {};
template <>
struct mesh_access<HexMesh> : detail::hex_array_access<HexMesh> {};

}  // namespace pavior
