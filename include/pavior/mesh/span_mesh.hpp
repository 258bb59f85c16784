#pragma once
/// \file
/// Meshes as plain arrays: views over the user's spans, and owning vectors.

#include <pavior/mesh/mesh_access.hpp>

#include <array>
#include <cstddef>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

namespace pavior {

namespace detail {

/// What stands in a contiguous range: vectors, arrays, spans.
template <class R>
using ArrayValue = typename decltype(std::span(std::declval<R&>()))::value_type;

/// A contiguous range whose elements outlive the expression: no temporary that owns them.
template <class R>
concept lasting_array = std::ranges::borrowed_range<R> && requires {
    typename ArrayValue<R>;
};

}  // namespace detail

/// Quad mesh over the user's arrays: nodes[i] is point_like, quads[q] four corner ids. Copies nothing. The types follow
/// from the arrays: QuadMeshView{nodes, quads}. So with the other views.
template <point_like P = Vec3, class C = QuadCorners>
struct QuadMeshView {
    std::span<const P> nodes;
    std::span<const C> quads;
};
template <detail::lasting_array P, detail::lasting_array C>
QuadMeshView(P&&, C&&) -> QuadMeshView<detail::ArrayValue<P>, detail::ArrayValue<C>>;

/// Hexahedral mesh over the user's arrays: nodes[i] is point_like, hexes[h] eight corner ids. Copies nothing.
template <point_like P = Vec3, class C = HexCorners>
struct HexMeshView {
    std::span<const P> nodes;
    std::span<const C> hexes;
};
template <detail::lasting_array P, detail::lasting_array C>
HexMeshView(P&&, C&&) -> HexMeshView<detail::ArrayValue<P>, detail::ArrayValue<C>>;

/// Triangle mesh over the user's arrays: nodes[i] is point_like, triangles[t] three corner ids. Copies nothing.
template <point_like P = Vec3, class C = TriCorners>
struct TriMeshView {
    std::span<const P> nodes;
    std::span<const C> triangles;
};
template <detail::lasting_array P, detail::lasting_array C>
TriMeshView(P&&, C&&) -> TriMeshView<detail::ArrayValue<P>, detail::ArrayValue<C>>;

/// Tetrahedral mesh over the user's arrays: nodes[i] is point_like, tets[t] four corner ids. Copies nothing.
template <point_like P = Vec3, class C = TetCorners>
struct TetMeshView {
    std::span<const P> nodes;
    std::span<const C> tets;
};
template <detail::lasting_array P, detail::lasting_array C>
TetMeshView(P&&, C&&) -> TetMeshView<detail::ArrayValue<P>, detail::ArrayValue<C>>;

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

/// Points alone, e.g. the nodes of the target cap: vectors with any allocator, arrays, spans, deques.
template <point_range R>
struct mesh_access<R> {
    static std::size_t node_count(const R& m) { return detail::count_of(m); }
    static decltype(auto) node(const R& m, Index i) { return m[i]; }
};

namespace detail {
template <vertex_mesh M>
void copy_nodes(const M& mesh, std::vector<Vec3>& nodes) {
    nodes.reserve(node_count(mesh));
    for (const Index i : IndexRange(node_count(mesh))) {
        nodes.push_back(node(mesh, i));
    }
}

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

/// Nodes and quads of any quad_mesh as arrays; ids as they are, right or wrong. O(n).
template <quad_mesh M>
[[nodiscard]] QuadMesh to_quad_mesh(const M& mesh) {
    QuadMesh result;
    detail::copy_nodes(mesh, result.nodes);
    result.quads.reserve(quad_count(mesh));
    for (const Index q : IndexRange(quad_count(mesh))) {
        result.quads.push_back(quad(mesh, q));
    }
    return result;
}

/// Nodes and hexahedra of any hex_mesh as arrays; ids as they are, right or wrong. O(n).
template <hex_mesh M>
[[nodiscard]] HexMesh to_hex_mesh(const M& mesh) {
    HexMesh result;
    detail::copy_nodes(mesh, result.nodes);
    result.hexes.reserve(hex_count(mesh));
    for (const Index h : IndexRange(hex_count(mesh))) {
        result.hexes.push_back(hex(mesh, h));
    }
    return result;
}

}  // namespace pavior
