#pragma once
/// \file
/// The tags of the geometry on the patches of a reference mesh.

#include <pavior/block/detail/nearest_weights.hpp>
#include <pavior/dual/reference_mesh.hpp>
#include <pavior/mesh/tagged_mesh.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <set>
#include <vector>

namespace pavior::detail {

/// Which tag a place on a patch has. Queries to patches with one tag cost O(log n); for the others the triangles of the
/// patch lie in the order of one coordinate, and only those near in it are looked at.
class TagFinder {
public:
    TagFinder(const ReferenceMesh& reference, const TaggedSurface& surface) : surface_(surface) {
        for (const TagOf& entry : reference.patch_tags) {
            patches_[entry.id].tags.insert(entry.tag);
        }
    }

    /// The tag of the nearest triangle of \p patch, the first among equally near ones; 0 where the patch has none >= 1.
    [[nodiscard]] std::int32_t tag(std::int32_t patch, const Vec3& x) {
        const auto at = patches_.find(patch);
        if (at == patches_.end() || *at->second.tags.begin() < 1) {
            return 0;
        }
        if (at->second.tags.size() == 1 || surface_.face_tags.empty()) {
            return *at->second.tags.begin();
        }
        return nearest(at->second, x);
    }

private:
    struct Patch {
        std::set<std::int32_t> tags;
        std::vector<std::size_t> triangles;  ///< by their lowest x coordinate
        std::vector<double> lowest;          ///< of each of those
        double widest = 0;                   ///< largest extent of one in x
    };

    [[nodiscard]] std::array<Vec3, 3> corners(std::size_t t) const {
        const TriCorners& c = surface_.mesh.triangles[t];
        return {surface_.mesh.nodes[c[0]], surface_.mesh.nodes[c[1]], surface_.mesh.nodes[c[2]]};
    }

    void prepare(Patch& patch) const {
        std::vector<std::pair<double, std::size_t>> order;
        for (std::size_t t = 0; t < surface_.mesh.triangles.size(); ++t) {
            if (patch.tags.count(surface_.face_tags[t]) != 0) {
                const auto x = corners(t);
                const auto [low, high] = std::minmax({x[0][0], x[1][0], x[2][0]});
                order.emplace_back(low, t);
                patch.widest = std::max(patch.widest, high - low);
            }
        }
        std::sort(order.begin(), order.end());
        for (const auto& [low, t] : order) {
            patch.lowest.push_back(low);
            patch.triangles.push_back(t);
        }
    }

    [[nodiscard]] std::int32_t nearest(Patch& patch, const Vec3& x) const {
        if (patch.triangles.empty()) {
            prepare(patch);
        }
        double best = std::numeric_limits<double>::infinity();
        std::size_t found = surface_.mesh.triangles.size();
        const auto visit = [&](std::size_t i) {
            const std::size_t t = patch.triangles[i];
            const auto c = corners(t);
            const Eigen::Vector3d w = nearest_weights(x, c[0], c[1], c[2]);
            const double d = (w[0] * c[0] + w[1] * c[1] + w[2] * c[2] - x).squaredNorm();
            if (d < best || (d == best && t < found)) {
                best = d;
                found = t;
            }
        };
        const auto middle = static_cast<std::size_t>(std::lower_bound(patch.lowest.begin(), patch.lowest.end(), x[0]) -
                                                     patch.lowest.begin());
        const auto beyond = [&](double gap) { return gap > 0 && gap * gap > best; };
        std::size_t right = middle, left = middle;
        bool more = true;
        while (more) {
            more = false;
            if (right < patch.lowest.size() && !beyond(patch.lowest[right] - x[0])) {
                visit(right++);
                more = true;
            }
            if (left > 0 && !beyond(x[0] - patch.lowest[left - 1] - patch.widest)) {
                visit(--left);
                more = true;
            }
        }
        return found < surface_.face_tags.size() ? surface_.face_tags[found] : *patch.tags.begin();
    }

    const TaggedSurface& surface_;
    std::map<std::int32_t, Patch> patches_;
};

}  // namespace pavior::detail
