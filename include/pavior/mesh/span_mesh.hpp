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

/// Triangle mesh over the user's arrays: nodes[i] is point_like, triangles[t] three corner ids. Copies nothing.
template <point_like P = Vec3, class C = TriCorners>
struct TriMeshView {
    std::span<const P> nodes;
    std::span<const C> triangles;
};

/// Tetrahedral mesh over the user's arrays: nodes[i] is point_like, tets[t] four corner ids. Copies nothing.
template <point_like P = Vec3, class C = TetCorners>
struct TetMeshView {
    std::span<const P> nodes;
    std::span<const C> tets;
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

/// Triangle mesh that owns its arrays.
struct TriMesh {
    std::vector<Vec3> nodes;
    std::vector<TriCorners> triangles;
};

/// Tetrahedral mesh that owns its arrays.
struct TetMesh {
    std::vector<Vec3> nodes;
    std::vector<TetCorners> tets;
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
template <class M>
struct triangle_array_access {
    static std::size_t node_count(const M& m) { return m.nodes.size(); }
    static const auto& node(const M& m, Index i) { return m.nodes[i]; }
    static std::size_t triangle_count(const M& m) { return m.triangles.size(); }
    static const auto& triangle(const M& m, Index t) { return m.triangles[t]; }
};
template <class M>
struct tet_array_access {
    static std::size_t node_count(const M& m) { return m.nodes.size(); }
    static const auto& node(const M& m, Index i) { return m.nodes[i]; }
    static std::size_t tet_count(const M& m) { return m.tets.size(); }
    static const auto& tet(const M& m, Index t) { return m.tets[t]; }
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
template <point_like P, class C>
struct mesh_access<TriMeshView<P, C>> : detail::triangle_array_access<TriMeshView<P, C>> {};
template <point_like P, class C>
struct mesh_access<TetMeshView<P, C>> : detail::tet_array_access<TetMeshView<P, C>> {};
template <>
struct mesh_access<TriMesh> : detail::triangle_array_access<TriMesh> {};
template <>
struct mesh_access<TetMesh> : detail::tet_array_access<TetMesh> {};

}  // namespace pavior
