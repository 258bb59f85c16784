#pragma once
/// \file
/// Patches of cells round seeds: what may move when a few cells are repaired.

#include <pavior/core/index.hpp>
#include <pavior/smooth/detail/cell_shape.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace pavior::detail {

/// Some free nodes and every cell that uses one of them.
template <int D>
struct Patch {
    std::vector<Index> nodes;           ///< ids in the mesh: the free ones first, ascending, then the others
    std::size_t free_count = 0;         ///< how many of nodes are free
    std::vector<Index> cell_ids;        ///< ids in the mesh, ascending
    std::vector<CellCorners<D>> cells;  ///< the same cells with corners as positions in nodes
    bool complete = false;              ///< no cell has a further node that could be freed
};

/// Finds patches. Construction is O(nodes + cells), a search O(size of the patches). Not thread-safe.
template <int D>
class PatchFinder {
public:
    using Corners = CellCorners<D>;

    /// \param fixed  one flag per node; corner ids lie in [0, fixed.size()). Both spans must outlive the finder.
    PatchFinder(std::span<const Corners> cells, std::span<const std::uint8_t> fixed)
        : cells_(cells),
          fixed_(fixed),
          reached_(fixed.size(), 0),
          local_(fixed.size(), no_index),
          taken_(cells.size(), 0) {
        offsets_.assign(fixed.size() + 1, 0);
        for (const Corners& cell : cells) {
            for (const Index i : cell) {
                ++offsets_[i + 1];
            }
        }
        for (std::size_t i = 0; i < fixed.size(); ++i) {
            offsets_[i + 1] += offsets_[i];
        }
        incident_.resize(offsets_.back());
        std::vector<std::size_t> next(offsets_.begin(), offsets_.end() - 1);
        for (std::size_t c = 0; c < cells.size(); ++c) {
            for (const Index i : cells[c]) {
                incident_[next[i]++] = static_cast<Index>(c);
            }
        }
    }

    /// Frees the nodes within \p rings >= 1 rings of cells round the seeds (1: the nodes of the seeds) and returns the
    /// connected components, which share no free node and no cell; in the order of their smallest free node.
    [[nodiscard]] std::vector<Patch<D>> find(std::span<const Index> seeds, int rings) {
        std::vector<Index> nodes = reach(seeds, rings);
        std::sort(nodes.begin(), nodes.end());
        std::vector<Patch<D>> patches;
        for (const Index i : nodes) {
            if (fixed_[i] == 0 && local_[i] == no_index) {
                patches.push_back(component(i));
            }
        }
        for (const Patch<D>& patch : patches) {
            release(patch);
        }
        for (const Index i : nodes) {
            reached_[i] = 0;
        }
        return patches;
    }

    /// The cells that use node i, ascending.
    [[nodiscard]] std::span<const Index> cells_round(Index i) const {
        return std::span(incident_).subspan(offsets_[i], offsets_[i + 1] - offsets_[i]);
    }

private:
    std::vector<Index> reach(std::span<const Index> seeds, int rings) {
        std::vector<Index> nodes;
        const auto add_cell = [&](Index c) {
            for (const Index i : cells_[c]) {
                if (reached_[i] == 0) {
                    reached_[i] = 1;
                    nodes.push_back(i);
                }
            }
        };
        for (const Index c : seeds) {
            add_cell(c);
        }
        std::size_t first = 0;
        for (int ring = 1; ring < rings && first < nodes.size(); ++ring) {
            const std::size_t last = nodes.size();
            for (; first < last; ++first) {
                for (const Index c : cells_round(nodes[first])) {
                    add_cell(c);
                }
            }
        }
        return nodes;
    }

    Patch<D> component(Index start) {
        Patch<D> patch;
        patch.complete = true;
        patch.nodes.push_back(start);
        local_[start] = 0;
        for (std::size_t k = 0; k < patch.nodes.size(); ++k) {
            for (const Index c : cells_round(patch.nodes[k])) {
                if (taken_[c] == 0) {
                    taken_[c] = 1;
                    patch.cell_ids.push_back(c);
                    free_corners(c, patch);
                }
            }
        }
        patch.free_count = patch.nodes.size();
        std::sort(patch.nodes.begin(), patch.nodes.end());
        std::sort(patch.cell_ids.begin(), patch.cell_ids.end());
        number(patch);
        return patch;
    }

    void free_corners(Index c, Patch<D>& patch) {
        for (const Index i : cells_[c]) {
            if (fixed_[i] != 0) {
                continue;
            }
            patch.complete = patch.complete && reached_[i] != 0;
            if (reached_[i] != 0 && local_[i] == no_index) {
                local_[i] = 0;
                patch.nodes.push_back(i);
            }
        }
    }

    /// Numbers the free nodes, then the others as they come, and translates the cells.
    void number(Patch<D>& patch) {
        for (std::size_t k = 0; k < patch.free_count; ++k) {
            local_[patch.nodes[k]] = static_cast<Index>(k);
        }
        patch.cells.reserve(patch.cell_ids.size());
        for (const Index c : patch.cell_ids) {
            Corners corners = cells_[c];
            for (Index& i : corners) {
                if (local_[i] == no_index) {
                    local_[i] = static_cast<Index>(patch.nodes.size());
                    patch.nodes.push_back(i);
                }
                i = local_[i];
            }
            patch.cells.push_back(corners);
        }
        for (std::size_t k = patch.free_count; k < patch.nodes.size(); ++k) {
            local_[patch.nodes[k]] = no_index;
        }
    }

    void release(const Patch<D>& patch) {
        for (std::size_t k = 0; k < patch.free_count; ++k) {
            local_[patch.nodes[k]] = no_index;
        }
        for (const Index c : patch.cell_ids) {
            taken_[c] = 0;
        }
    }

    std::span<const Corners> cells_;
    std::span<const std::uint8_t> fixed_;
    std::vector<std::size_t> offsets_;
    std::vector<Index> incident_;
    std::vector<std::uint8_t> reached_;
    std::vector<Index> local_;
    std::vector<std::uint8_t> taken_;
};

}  // namespace pavior::detail
