#include <pavior/cad/region_quads.hpp>

#include "plane_quads.hpp"

#include <pavior/core/error.hpp>
#include <pavior/smooth/quads.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace pavior {

namespace {

double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

void check_region(const PlaneRegion& region, const RegionOptions& options) {
    const std::size_t n = region.points.size();
    if (region.offsets.empty() || region.offsets.back() != n || n % 2 != 0) {
        throw InputError(ErrorCode::size_mismatch, "a region needs an even number of points, all of them in loops");
    }
    bool small = n < 4;
    for (std::size_t l = 0; l < region.size(); ++l) {
        small = small || region.offsets[l + 1] < region.offsets[l] + 3;
    }
    if (small) {
        throw InputError(ErrorCode::empty_input, "a loop of a region has fewer than three points, or all have three");
    }
    if (!std::all_of(region.points.begin(), region.points.end(), [](const Vec2& x) { return x.allFinite(); })) {
        throw InputError(ErrorCode::not_finite, "a point of a region is not finite");
    }
    if (!(options.size >= 0) || !std::isfinite(options.size)) {
        throw InputError(ErrorCode::bad_option, "RegionOptions::size must be finite and not negative");
    }
    double twice = 0;
    for (std::size_t i = 0; i < region.offsets[1]; ++i) {
        twice += cross(region.points[i] - region.points[0], region.points[region.next(0, i)] - region.points[0]);
    }
    if (!(twice > 0)) {
        throw InputError(ErrorCode::bad_orientation, "the outer loop of a region does not run counter-clockwise");
    }
}

/// A region in the making; coordinates are relative to its first point, in units of the mean spacing.
class RegionMaker {
public:
    RegionMaker(const PlaneRegion& region, const RegionOptions& options) : region_(region), options_(options) {
        loops_.offsets = region.offsets;
        origin_ = region.points.front();
        double length = 0;
        for (std::size_t l = 0; l < region.size(); ++l) {
            for (std::size_t i = region.offsets[l]; i < region.offsets[l + 1]; ++i) {
                length += (region.points[region.next(l, i)] - region.points[i]).norm();
            }
        }
        unit_ = length / static_cast<double>(region.points.size());
        for (const Vec2& x : region.points) {
            loops_.points.emplace_back((x - origin_) / unit_);
        }
    }

    PlaneQuadMesh make() {
        if (options_.structured) {
            consider(detail::grid_quads(loops_));
        }
        using Recipe = detail::QuadRecipe;
        const double size = options_.size / unit_;
        int failures = 0;
        for (const Recipe& recipe :
             {Recipe{6, 5, 1, 10}, Recipe{6, 0, 1, 10}, Recipe{5, 5, 1, 10}, Recipe{6, 5, 0.85, 10},
              Recipe{6, 5, 1.2, 10}, Recipe{5, 5, 0.8, 10}, Recipe{1, 5, 1, 10}, Recipe{6, 5, 0.7, 10}}) {
            if (quality_ < good && failures < allowed_failures) {
                failures += consider(detail::recombined_quads(loops_, size, recipe)) ? 0 : 1;
            }
        }
        for (const std::size_t first : {std::size_t{0}, std::size_t{1}}) {
            if (quality_ >= acceptable) {
                break;
            }
            const auto triangles = detail::subdivided_triangles(loops_, size, first);
            if (triangles && consider(triangles) && quality_ < acceptable) {
                consider(detail::pillowed(*triangles, loops_));
            }
        }
        if (best_.quads.empty() || quality_ < flat) {
            throw Error(ErrorCode::cad_failure, "a plane region of " + std::to_string(region_.points.size()) +
                                                    " boundary nodes cannot be filled with quads");
        }
        std::copy(region_.points.begin(), region_.points.end(), best_.nodes.begin());
        for (std::size_t i = region_.points.size(); i < best_.nodes.size(); ++i) {
            best_.nodes[i] = origin_ + unit_ * best_.nodes[i];
        }
        return std::move(best_);
    }

private:
    static constexpr double flat = 1e-5;  ///< a quad with a corner like this is as good as folded
    static constexpr double good = 0.5;
    static constexpr double acceptable = 0.35;
    static constexpr int allowed_failures = 4;

    bool consider(const std::optional<detail::PlaneQuads>& plane) {
        if (!plane) {
            return false;
        }
        PlaneQuadMesh mesh{plane->nodes, plane->quads};
        double quality = detail::smallest_corner(mesh.nodes, mesh.quads);
        if (quality < good) {
            std::vector<std::uint8_t> fixed(mesh.nodes.size(), 0);
            std::fill_n(fixed.begin(), region_.points.size(), std::uint8_t{1});
            UntangleOptions smoothing;
            smoothing.always = true;
            quality = untangle_quads(mesh.nodes, mesh.quads, fixed, smoothing).min_det_after;
        }
        if (best_.quads.empty() || quality > quality_) {
            best_ = std::move(mesh);
            quality_ = quality;
        }
        return true;
    }

    const PlaneRegion& region_;
    RegionOptions options_;
    Vec2 origin_ = Vec2::Zero();
    double unit_ = 1;
    detail::PlaneLoops loops_;
    PlaneQuadMesh best_;
    double quality_ = -2;
};

}  // namespace

PlaneQuadMesh mesh_region(const PlaneRegion& region, const RegionOptions& options) {
    check_region(region, options);
    return RegionMaker(region, options).make();
}

}  // namespace pavior
