#pragma once

#include <pavior/math/quadrilateral.hpp>
#include <pavior/one_to_one/sweep_solid.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace pavior {

namespace detail {

PAVIOR_INLINE std::vector<Vec3> positions(const BoundaryMesh& mesh, std::span<const Index> ids) {
    std::vector<Vec3> points;
    points.reserve(ids.size());
    for (const Index id : ids) {
        points.push_back(mesh.nodes[id]);
    }
    return points;
}

PAVIOR_INLINE Loops local_loops(const LevelIds& levels, const PositionOf& position) {
    Loops loops;
    for (std::size_t l = 0; l + 1 < levels.offsets.size(); ++l) {
        std::vector<Index> loop;
        for (std::size_t i = levels.offsets[l]; i < levels.offsets[l + 1]; ++i) {
            loop.push_back(position(levels.level(0)[i]));
            PAVIOR_ASSERT(loop.back() != no_index);
        }
        loops.add(loop);
    }
    return loops;
}

PAVIOR_INLINE std::vector<Index> store_sweep(BoundaryMesh& mesh, const SweepMesh& swept, const Loops& loops,
                                             const LevelIds& levels, std::span<const Index> source_ids,
                                             std::span<const Index> target_ids) {
    std::vector<Index> ids(swept.nodes().size(), no_index);
    std::copy(source_ids.begin(), source_ids.end(), ids.begin());
    std::copy(target_ids.begin(), target_ids.end(), ids.end() - static_cast<std::ptrdiff_t>(target_ids.size()));
    for (std::size_t k = 1; k < swept.layer_count(); ++k) {
        const std::size_t first = k * swept.level_size();
        for (std::size_t i = 0; i < loops.nodes.size(); ++i) {
            ids[first + loops.nodes[i]] = levels.level(k)[i];
        }
        for (std::size_t i = first; i < first + swept.level_size(); ++i) {
            ids[i] = ids[i] == no_index ? mesh.add_node(swept.nodes()[i]) : ids[i];
        }
    }
    return ids;
}

}  // namespace detail

}  // namespace pavior
