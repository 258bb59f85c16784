#pragma once
/// \file
/// The one adaptation point for foreign meshes, and the reading concepts built on it.

#include <pavior/core/index.hpp>
#include <pavior/math/point.hpp>
#include <pavior/mesh/cells.hpp>

#include <concepts>
#include <cstddef>
#include <type_traits>

namespace pavior {

/// How pavior reads a mesh of type M. Specialise it for your type with these static members, and nothing else:
///
///     template <> struct pavior::mesh_access<MyMesh> {
///         static std::size_t node_count(const MyMesh&);
///         static point_like  node(const MyMesh&, Index i);   // 0 <= i < node_count
///         static std::size_t quad_count(const MyMesh&);
///         static corners     quad(const MyMesh&, Index q);   // corners[0..3] convertible to Index
///     };
///
/// A triangle mesh has triangle_count and triangle (3 corners), a tetrahedral one tet_count and tet (4 corners), a
/// hexahedral one hex_count and hex (8 corners) instead.
/// Plain arrays need none: see QuadMeshView, HexMesh and their like (span_mesh.hpp).
template <class M>
struct mesh_access;

namespace detail {
template <class C>
concept corner_list = requires(const std::remove_cvref_t<C>& c) {
    { c[0] } -> std::convertible_to<Index>;
};
}  // namespace detail

/// M is a vertex_mesh if mesh_access<M>
/// 1. has node_count(m), convertible to std::size_t;
/// 2. has node(m, i), point_like, for every i in [0, node_count(m));
/// 3. (not checkable) both are O(1), do not change m, and may be called from several threads.
template <class M>
concept vertex_mesh = requires(const std::remove_cvref_t<M>& m, Index i) {
    { mesh_access<std::remove_cvref_t<M>>::node_count(m) } -> std::convertible_to<std::size_t>;
    { mesh_access<std::remove_cvref_t<M>>::node(m, i) } -> point_like;
};

/// M is a quad_mesh if it is a vertex_mesh and mesh_access<M>
/// 1. has quad_count(m), convertible to std::size_t;
/// 2. has quad(m, q) with four corners, node ids in [0, node_count(m));
/// 3. (not checkable) corners run counter-clockwise seen from the front, the same for all quads;
/// 4. (not checkable) O(1), read-only, thread-safe.
/// verify_quads() checks what the compiler cannot.
template <class M>
concept quad_mesh = vertex_mesh<M> && requires(const std::remove_cvref_t<M>& m, Index q) {
    { mesh_access<std::remove_cvref_t<M>>::quad_count(m) } -> std::convertible_to<std::size_t>;
    { mesh_access<std::remove_cvref_t<M>>::quad(m, q) } -> detail::corner_list;
};

/// M is a hex_mesh: as quad_mesh with hex_count(m) and hex(m, h), eight corners numbered as in HexCorners.
template <class M>
concept hex_mesh = vertex_mesh<M> && requires(const std::remove_cvref_t<M>& m, Index h) {
    { mesh_access<std::remove_cvref_t<M>>::hex_count(m) } -> std::convertible_to<std::size_t>;
    { mesh_access<std::remove_cvref_t<M>>::hex(m, h) } -> detail::corner_list;
};

/// M is a triangle_mesh: as quad_mesh with triangle_count(m) and triangle(m, t), three corners.
template <class M>
concept triangle_mesh = vertex_mesh<M> && requires(const std::remove_cvref_t<M>& m, Index t) {
    { mesh_access<std::remove_cvref_t<M>>::triangle_count(m) } -> std::convertible_to<std::size_t>;
    { mesh_access<std::remove_cvref_t<M>>::triangle(m, t) } -> detail::corner_list;
};

/// M is a tet_mesh: as quad_mesh with tet_count(m) and tet(m, t), four corners numbered as in TetCorners.
template <class M>
concept tet_mesh = vertex_mesh<M> && requires(const std::remove_cvref_t<M>& m, Index t) {
    { mesh_access<std::remove_cvref_t<M>>::tet_count(m) } -> std::convertible_to<std::size_t>;
    { mesh_access<std::remove_cvref_t<M>>::tet(m, t) } -> detail::corner_list;
};

/// Free-function spelling of the access, what algorithms use.
template <vertex_mesh M>
[[nodiscard]] std::size_t node_count(const M& mesh) {
    return static_cast<std::size_t>(mesh_access<M>::node_count(mesh));
}
template <vertex_mesh M>
[[nodiscard]] Vec3 node(const M& mesh, Index i) {
    return to_vec3(mesh_access<M>::node(mesh, i));
}
template <quad_mesh M>
[[nodiscard]] std::size_t quad_count(const M& mesh) {
    return static_cast<std::size_t>(mesh_access<M>::quad_count(mesh));
}
template <quad_mesh M>
[[nodiscard]] QuadCorners quad(const M& mesh, Index q) {
    const auto& c = mesh_access<M>::quad(mesh, q);
    return {static_cast<Index>(c[0]), static_cast<Index>(c[1]), static_cast<Index>(c[2]), static_cast<Index>(c[3])};
}
template <triangle_mesh M>
[[nodiscard]] std::size_t triangle_count(const M& mesh) {
    return static_cast<std::size_t>(mesh_access<M>::triangle_count(mesh));
}
template <triangle_mesh M>
[[nodiscard]] TriCorners triangle(const M& mesh, Index t) {
    const auto& c = mesh_access<M>::triangle(mesh, t);
    return {static_cast<Index>(c[0]), static_cast<Index>(c[1]), static_cast<Index>(c[2])};
}
template <tet_mesh M>
[[nodiscard]] std::size_t tet_count(const M& mesh) {
    return static_cast<std::size_t>(mesh_access<M>::tet_count(mesh));
}
template <tet_mesh M>
[[nodiscard]] TetCorners tet(const M& mesh, Index t) {
    const auto& c = mesh_access<M>::tet(mesh, t);
    return {static_cast<Index>(c[0]), static_cast<Index>(c[1]), static_cast<Index>(c[2]), static_cast<Index>(c[3])};
}
template <hex_mesh M>
[[nodiscard]] std::size_t hex_count(const M& mesh) {
    return static_cast<std::size_t>(mesh_access<M>::hex_count(mesh));
}
template <hex_mesh M>
[[nodiscard]] HexCorners hex(const M& mesh, Index h) {
    const auto& c = mesh_access<M>::hex(mesh, h);
    return {static_cast<Index>(c[0]), static_cast<Index>(c[1]), static_cast<Index>(c[2]), static_cast<Index>(c[3]),
            static_cast<Index>(c[4]), static_cast<Index>(c[5]), static_cast<Index>(c[6]), static_cast<Index>(c[7])};
}

}  // namespace pavior
