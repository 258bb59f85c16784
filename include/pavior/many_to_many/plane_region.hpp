#pragma once
/// \file
/// A region of the plane between given boundary nodes, and the quads that fill it.

#include <pavior/math/point.hpp>
#include <pavior/mesh/cells.hpp>

#include <concepts>
#include <cstddef>
#include <functional>
#include <vector>

namespace pavior {

/// Closed polygons: loop l is points[offsets[l]] .. points[offsets[l + 1] - 1], the outer one first and
/// counter-clockwise, the holes clockwise.
struct PlaneRegion {
    std::vector<Vec2> points;
    std::vector<std::size_t> offsets{0};

    [[nodiscard]] std::size_t size() const { return offsets.size() - 1; }
    [[nodiscard]] std::size_t next(std::size_t loop, std::size_t i) const {
        return i + 1 < offsets[loop + 1] ? i + 1 : offsets[loop];
    }
};

/// Quads counter-clockwise; nodes 0 .. n-1 are the n points of the region, bit by bit; inner nodes follow.
struct PlaneQuadMesh {
    std::vector<Vec2> nodes;
    std::vector<QuadCorners> quads;
};

/// F fills regions: f(region) is convertible to a PlaneQuadMesh without folded quads, whose boundary edges are those of
/// the region and no others. The number of points of the region is even.
template <class F>
concept region_mesher = requires(F&& f, const PlaneRegion& region) {
    { f(region) } -> std::convertible_to<PlaneQuadMesh>;
};

/// Any region_mesher that can be copied, behind one type; std::ref() of one that cannot.
using RegionMesher = std::function<PlaneQuadMesh(const PlaneRegion& region)>;

}  // namespace pavior
