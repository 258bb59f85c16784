#pragma once
// Inside and outside of closed shells, exactly. Internal to the tetra component.

#include <pavior/math/point.hpp>
#include <pavior/mesh/cells.hpp>

#include "box_tree.hpp"

#include <optional>
#include <span>
#include <vector>

namespace pavior::detail {

/// Triangles that are in range, with corners at different places, in a tree. Keeps references to both spans.
class TriangleTree {
public:
    TriangleTree(std::span<const Vec3> nodes, std::span<const TriCorners> triangles);

    [[nodiscard]] const BoxTree& boxes() const { return boxes_; }

    /// How often a path from \p p to infinity crosses the triangles t with counts(t); those that contain p do not
    /// count.
    template <class Counts>
    [[nodiscard]] int crossings(const Vec3& p, const Counts& counts) const {
        for (int attempt = 0; attempt < most_attempts; ++attempt) {
            if (const std::optional<int> sum = crossings_to(p, far_point(attempt), counts)) {
                return *sum;
            }
        }
        return 0;
    }

    /// +1 if the normal of triangle \p t points out of what the triangles s with counts(s), itself among them, enclose;
    /// -1 if it points into it.
    template <class Counts>
    [[nodiscard]] int outwards(std::size_t t, const Counts& counts) const {
        for (int attempt = 0; attempt < most_attempts; ++attempt) {
            const Vec3 q = far_point(attempt);
            const int side = side_of(t, q);
            const auto others = [&](std::size_t s) { return s != t && counts(s); };
            const std::optional<int> sum = side == 0 ? std::nullopt : crossings_to(centre(t), q, others);
            if (sum) {
                return *sum % 2 == 0 ? side : -side;
            }
        }
        return 1;
    }

    /// Length of the way from the centre of triangle \p t along its normal to the next triangle; infinite if there is
    /// none. In double precision.
    [[nodiscard]] double clearance(std::size_t t) const;
    [[nodiscard]] Vec3 centre(std::size_t t) const;
    [[nodiscard]] Vec3 unit_normal(std::size_t t) const;

private:
    static constexpr int most_attempts = 256;

    template <class Counts>
    [[nodiscard]] std::optional<int> crossings_to(const Vec3& p, const Vec3& q, const Counts& counts) const {
        std::optional<int> sum = 0;
        boxes_.for_each_on_segment(p, q, [&](std::size_t t) {
            if (sum && counts(t)) {
                const std::optional<int> one = crosses(p, q, t);
                sum = one ? std::optional(*sum + *one) : std::nullopt;
            }
        });
        return sum;
    }

    /// On which side of the plane of a triangle a point lies: +1 where the normal points.
    [[nodiscard]] int side_of(std::size_t t, const Vec3& q) const;
    /// 0 or 1; nothing if the segment passes through an edge or lies in the plane.
    [[nodiscard]] std::optional<int> crosses(const Vec3& p, const Vec3& q, std::size_t t) const;
    [[nodiscard]] Vec3 far_point(int attempt) const;

    std::span<const Vec3> nodes_;
    std::span<const TriCorners> triangles_;
    BoxTree boxes_;
    Box<Vec3> all_;
};

/// The shells of a closed surface: triangles connected through edges.
struct Shells {
    std::vector<Index> of;       ///< shell of each triangle
    std::vector<Index> first;    ///< smallest triangle of each shell
    std::vector<char> outwards;  ///< the normals point out of what the shell encloses
};
[[nodiscard]] Shells find_shells(const TriangleTree& tree, std::span<const TriCorners> triangles);

}  // namespace pavior::detail
