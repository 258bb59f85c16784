#pragma once
/// \file
/// Points as the columns of a matrix, in place where they are doubles in memory.

#include <pavior/math/point.hpp>

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace pavior::detail {

/// Ranges whose points might be three doubles one after the other, at equal distances.
template <class R>
concept points_in_memory = point_range<R> && requires(const R& r) {
    requires std::is_bounded_array_v<R> || std::is_pointer_v<decltype(r.data())>;
    requires std::is_same_v<decltype(r[0][0]), const double&>;
    requires sizeof(r[0]) % sizeof(double) == 0;
};

/// 3 x m matrix of a point_range; it refers to the points, or to a copy of them where they are stored in another way.
class PointColumns {
public:
    using Map = Eigen::Map<const Eigen::Matrix3Xd, Eigen::Unaligned, Eigen::OuterStride<>>;

    template <point_range R>
    explicit PointColumns(const R& points) : count_(static_cast<Eigen::Index>(count_of(points))) {
        if constexpr (points_in_memory<R>) {
            if (count_ > 0 && in_a_row(points[0])) {
                first_ = &points[0][0];
                stride_ = sizeof(points[0]) / sizeof(double);
                return;
            }
        }
        copy_.resize(3, count_);
        for (Eigen::Index i = 0; i < count_; ++i) {
            copy_.col(i) = to_vec3(points[static_cast<std::size_t>(i)]);
        }
        first_ = copy_.data();
    }
    PointColumns(const PointColumns&) = delete;
    PointColumns& operator=(const PointColumns&) = delete;
    ~PointColumns() = default;

    [[nodiscard]] Map matrix() const { return {first_, 3, count_, Eigen::OuterStride<>(stride_)}; }

private:
    /// The coordinates stand inside the point, one after the other.
    template <class P>
    [[nodiscard]] static bool in_a_row(const P& point) {
        const auto begin = reinterpret_cast<std::uintptr_t>(&point);
        const auto at = reinterpret_cast<std::uintptr_t>(&point[0]);
        return at >= begin && at + 3 * sizeof(double) <= begin + sizeof(P) && &point[1] == &point[0] + 1 &&
               &point[2] == &point[0] + 2;
    }

    Eigen::Index count_;
    Eigen::Index stride_ = 3;
    const double* first_ = nullptr;
    Eigen::Matrix3Xd copy_;
};

}  // namespace pavior::detail
