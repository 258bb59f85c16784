#pragma once
/// \file
/// What holds the nodes of a mesh that is smoothed: nothing, a surface, a curve or a fixed place.

#include <pavior/core/index.hpp>
#include <pavior/math/point.hpp>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>

namespace pavior {

/// How many ways a node may go.
enum class Freedom : std::uint8_t {
    fixed = 0,    ///< does not move by a bit
    curve = 1,    ///< slides on a curve
    surface = 2,  ///< slides on a surface
    space = 3,    ///< moves freely
};

/// G is a node_guide if, for a const G& g, a node i and a point x,
/// 1. g.freedom(i) is a Freedom;
/// 2. g.project(i, x) is convertible to Vec3: the point of the curve or surface of node i next to x. Asked only for
///    nodes that slide. A result that is not finite is a refusal: the node stays where it is for now;
/// 3. (optional) g.direction(i, x) is convertible to Vec3: the tangent of the curve, or normal of the surface, at the
///    point x of it; any length and sense, null where there is none (the node rests then). Without it the direction is
///    estimated from four calls of project;
/// 4. (optional) g.concurrent() is true if project and direction may be called from several threads; assumed false;
/// 5. (optional) g.size() is convertible to std::size_t: the number of nodes it knows, refused (InputError
///    size_mismatch) unless that of the mesh;
/// 6. (not checkable) answers depend on the arguments alone; g.project(i, x) is x for a point x of the curve or surface
///    (up to rounding) and continuous near it.
/// One concept serves CAD faces (closest point), patches of triangles and analytic surfaces.
template <class G>
concept node_guide = requires(const std::remove_cvref_t<G>& g, Index i, const Vec3& x) {
    { g.freedom(i) } -> std::same_as<Freedom>;
    { g.project(i, x) } -> std::convertible_to<Vec3>;
};

/// The node_guide of nodes that are fixed or free.
struct FixedNodes {
    std::span<const std::uint8_t> fixed;  ///< one flag per node; 0: moves freely

    [[nodiscard]] std::size_t size() const { return fixed.size(); }
    [[nodiscard]] Freedom freedom(Index i) const { return fixed[i] != 0 ? Freedom::fixed : Freedom::space; }
    [[nodiscard]] static Vec3 project(Index, const Vec3& x) { return x; }
    [[nodiscard]] static bool concurrent() { return true; }
};

/// The node_guide of a callable Vec3 project(Index node, const Vec3& x), e.g. a lambda:
///
///     GuidedNodes guide{freedom, [&](Index, const Vec3& x) { return Vec3(radius * x.normalized()); }};
template <class Project>
requires std::is_invocable_r_v<Vec3, const Project&, Index, const Vec3&>
struct GuidedNodes {
    std::span<const Freedom> freedoms;  ///< one per node
    Project projection;
    bool thread_safe = false;  ///< the callable may be called from several threads

    [[nodiscard]] std::size_t size() const { return freedoms.size(); }
    [[nodiscard]] Freedom freedom(Index i) const { return freedoms[i]; }
    [[nodiscard]] Vec3 project(Index i, const Vec3& x) const { return projection(i, x); }
    [[nodiscard]] bool concurrent() const { return thread_safe; }
};
template <class Project>
GuidedNodes(std::span<const Freedom>, Project) -> GuidedNodes<Project>;
template <class Project>
GuidedNodes(std::span<const Freedom>, Project, bool) -> GuidedNodes<Project>;

namespace detail {

[[nodiscard]] constexpr bool slides(Freedom freedom) {
    return freedom == Freedom::curve || freedom == Freedom::surface;
}

template <node_guide G>
[[nodiscard]] bool guide_concurrent(const G& guide) {
    if constexpr (requires { guide.concurrent(); }) {
        return static_cast<bool>(guide.concurrent());
    }
    return false;
}

/// \p x brought to the curve or surface of node i; \p fallback if the guide refuses.
template <node_guide G>
[[nodiscard]] Vec3 guided_point(const G& guide, Index i, const Vec3& x, const Vec3& fallback) {
    const Vec3 y = guide.project(i, x);
    return y.allFinite() ? y : fallback;
}

/// Unit tangent of the curve or normal of the surface of node i at its point \p x; null where there is none.
/// \param step  length of the differences that estimate it, if the guide does not tell; small against the elements.
template <node_guide G>
[[nodiscard]] Vec3 guided_direction(const G& guide, Freedom freedom, Index i, const Vec3& x, double step) {
    Vec3 best = Vec3::Zero();
    if constexpr (requires { guide.direction(i, x); }) {
        best = guide.direction(i, x);
    } else {
        std::array<Vec3, 3> column;  // the derivative of a projection is the projector on the tangent space
        const Vec3 base = guide.project(i, x);
        for (Eigen::Index k = 0; k < 3; ++k) {
            column[static_cast<std::size_t>(k)] = (guide.project(i, x + step * Vec3::Unit(k)) - base) / step;
        }
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3 next = freedom == Freedom::curve ? column[k] : column[k].cross(column[(k + 1) % 3]);
            best = next.squaredNorm() > best.squaredNorm() ? next : best;
        }
        if (!(best.norm() > 1e-3)) {
            return Vec3::Zero();
        }
    }
    const double length = best.stableNorm();
    return best.allFinite() && length > 0.0 ? Vec3(best / length) : Vec3(Vec3::Zero());
}

}  // namespace detail

}  // namespace pavior
