#pragma once
/// \file
/// Any node_guide behind one type, so that what works with it is compiled once.

#include <pavior/core/index.hpp>
#include <pavior/math/point.hpp>
#include <pavior/smooth/node_guide.hpp>

namespace pavior::detail {

/// Refers to a node_guide, which must outlive it; a call through a pointer for each question.
class GuideView {
public:
    template <node_guide G>
    explicit GuideView(const G& guide)
        : guide_(&guide),
          concurrent_(guide_concurrent(guide)),
          point_([](const void* g, Index i, const Vec3& x, const Vec3& fallback) {
              return guided_point(*static_cast<const G*>(g), i, x, fallback);
          }),
          direction_([](const void* g, Freedom freedom, Index i, const Vec3& x, double step) {
              return guided_direction(*static_cast<const G*>(g), freedom, i, x, step);
          }) {}

    [[nodiscard]] bool concurrent() const { return concurrent_; }
    /// guided_point() of the guide.
    [[nodiscard]] Vec3 point(Index i, const Vec3& x, const Vec3& fallback) const {
        return point_(guide_, i, x, fallback);
    }
    /// guided_direction() of the guide.
    [[nodiscard]] Vec3 direction(Freedom freedom, Index i, const Vec3& x, double step) const {
        return direction_(guide_, freedom, i, x, step);
    }

private:
    const void* guide_;
    bool concurrent_;
    Vec3 (*point_)(const void*, Index, const Vec3&, const Vec3&);
    Vec3 (*direction_)(const void*, Freedom, Index, const Vec3&, double);
};

}  // namespace pavior::detail
