#pragma once
/// \file
/// The reference mesh (section 5.4.2 \cite roca2009): tetrahedra that know which of their faces, edges and nodes lie on
/// the boundary features of the solid, and which inner faces are cuts.

#include <pavior/mesh/tagged_mesh.hpp>

#include <array>
#include <compare>
#include <concepts>
#include <cstdint>
#include <ranges>
#include <type_traits>
#include <vector>

namespace pavior {

/// What the dihedral angle asks of the hexahedra round a boundary curve (section 5.4.1 \cite roca2009).
enum class CurveKind : std::uint8_t {
    smooth,    ///< none: not a feature
    end,       ///< one stack of hexahedra
    corner,    ///< three stacks: two sheets continue the faces
    reversal,  ///< four stacks: two sheets continue the faces, one stands on the curve
};

/// A mesh edge on a feature curve; `curve` numbers the curves 0, 1, 2 ... (maximal chains between feature vertices).
struct FeatureEdge {
    std::array<Index, 2> nodes{};
    std::int32_t curve = 0;
    CurveKind kind = CurveKind::end;

    friend bool operator==(const FeatureEdge&, const FeatureEdge&) = default;
};

/// How the dual wing reads the features of a foreign tetrahedral mesh M, beside mesh_access<M>. Specialise with
///
///     template <> struct pavior::feature_access<MyTets> {
///         static range patches(const MyTets&);   // elements like TaggedTriangle: every boundary face once
///         static range curves(const MyTets&);    // elements like FeatureEdge
///         static range vertices(const MyTets&);  // elements like TaggedNode
///         static range layers(const MyTets&);    // elements like TriCorners: inner faces that are cuts (the list L)
///     };
template <class M>
struct feature_access;

namespace detail {
template <class R, class Element>
concept range_of = std::ranges::input_range<R> && std::convertible_to<std::ranges::range_reference_t<R>, Element>;
}  // namespace detail

/// M is a classified_tet_mesh if it is a tet_mesh and feature_access<M>
/// 1. has patches(m), curves(m), vertices(m), layers(m), input ranges, by value or by reference, of elements that
///    convert to the types above;
/// 2. (not checkable) patches lists every boundary face of the tetrahedra once; curves, layers and vertices name edges,
///    inner faces and nodes of the mesh, each once.
template <class M>
concept classified_tet_mesh = tet_mesh<M> && requires(const std::remove_cvref_t<M>& m) {
    requires detail::range_of<decltype(feature_access<std::remove_cvref_t<M>>::patches(m)), TaggedTriangle>;
    requires detail::range_of<decltype(feature_access<std::remove_cvref_t<M>>::curves(m)), FeatureEdge>;
    requires detail::range_of<decltype(feature_access<std::remove_cvref_t<M>>::vertices(m)), TaggedNode>;
    requires detail::range_of<decltype(feature_access<std::remove_cvref_t<M>>::layers(m)), TriCorners>;
};

/// A patch or curve of the reference mesh and a tag of the geometry that it carries.
struct TagOf {
    std::int32_t id = 0;
    std::int32_t tag = 0;

    friend auto operator<=>(const TagOf&, const TagOf&) = default;
};

/// The reference mesh as plain arrays.
struct ReferenceMesh {
    std::vector<Vec3> nodes;
    std::vector<TetCorners> tets;
    std::vector<TaggedTriangle> patches;  ///< boundary faces, counter-clockwise seen from outside; tag = patch
    std::vector<FeatureEdge> curves;      ///< edges on feature curves
    std::vector<TaggedNode> vertices;     ///< feature vertices; tag of the geometry, -1 where it has none
    std::vector<TriCorners> layers;       ///< inner faces of type layer: the cuts
    std::vector<TagOf> patch_tags;        ///< tags of the geometry that each patch carries, ascending; may be empty
    std::vector<TagOf> curve_tags;        ///< the same for curves
};

template <>
struct mesh_access<ReferenceMesh> : detail::tet_array_access<ReferenceMesh> {};

template <>
struct feature_access<ReferenceMesh> {
    static const auto& patches(const ReferenceMesh& m) { return m.patches; }
    static const auto& curves(const ReferenceMesh& m) { return m.curves; }
    static const auto& vertices(const ReferenceMesh& m) { return m.vertices; }
    static const auto& layers(const ReferenceMesh& m) { return m.layers; }
};

}  // namespace pavior
