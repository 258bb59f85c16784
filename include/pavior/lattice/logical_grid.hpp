#pragma once
/// \file
/// A region that is a union of unit squares or cubes of the integer lattice, given by its boundary.

#include <pavior/core/assert.hpp>
#include <pavior/core/error.hpp>
#include <pavior/core/index.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace pavior {

/// A point of the lattice; of a cell or facet the corner with the smallest coordinates.
template <std::size_t D>
using LatticePoint = std::array<int, D>;

/// A unit facet of the boundary of a region: a segment (D = 2) or square (D = 3) normal to `axis`.
template <std::size_t D>
struct LatticeFacet {
    LatticePoint<D> low{};
    int axis = 0;
    int outward = 1;   ///< +1 if the outside lies at larger coordinates, -1 if at smaller ones
    Index entity = 0;  ///< what the facet belongs to; for reports
};

/// The cells of a region and the numbers of its nodes, D = 2 or 3.
///
/// Nodes and cells are numbered in lexicographic order with the first coordinate running fastest:
/// \verbatim
///  6---7              cells 0, 1 below, 2 above
///  | 2 |              node 4 = (1, 1)
///  3---4---5
///  | 0 | 1 |
///  0---1---2
/// \endverbatim
/// Memory: five bytes per lattice point of the bounding box.
template <std::size_t D>
class LogicalGrid {
public:
    using Point = LatticePoint<D>;
    static_assert(D == 2 || D == 3);

    /// The region bounded by \p facets. Cells covered twice, or facets that do not close, leave ok() false and
    /// overlap() with the entities of the facets on a line of cells where that shows. Facets of one place that cancel
    /// out are not noticed.
    /// \throws InputError empty_input without facets, overflow if the bounding box has more than 2^31 points.
    explicit LogicalGrid(std::span<const LatticeFacet<D>> facets) {
        bound(facets);
        fill(facets);
        if (ok()) {
            number_nodes();
        }
    }

    [[nodiscard]] bool ok() const { return overlap_.empty(); }
    [[nodiscard]] const std::vector<Index>& overlap() const { return overlap_; }

    [[nodiscard]] const Point& low() const { return low_; }    ///< smallest coordinates of a node
    [[nodiscard]] const Point& high() const { return high_; }  ///< largest coordinates of a node
    [[nodiscard]] std::size_t node_count() const { return node_count_; }
    [[nodiscard]] std::size_t cell_count() const { return cell_count_; }

    /// Whether the unit cell at \p low belongs to the region; false outside the box.
    [[nodiscard]] bool has_cell(const Point& low) const {
        for (std::size_t a = 0; a < D; ++a) {
            if (low[a] < low_[a] || low[a] >= high_[a]) {
                return false;
            }
        }
        return cell_[position(low)] != 0;
    }
    /// Number of the node at \p p, no_index if there is none.
    [[nodiscard]] Index node(const Point& p) const {
        for (std::size_t a = 0; a < D; ++a) {
            if (p[a] < low_[a] || p[a] > high_[a]) {
                return no_index;
            }
        }
        return node_[position(p)];
    }
    /// Whether all cells round \p p belong to the region.
    [[nodiscard]] bool inner(const Point& p) const {
        for (std::size_t c = 0; c < (std::size_t{1} << D); ++c) {
            if (!has_cell(neighbour(p, c))) {
                return false;
            }
        }
        return true;
    }
    /// Calls f(node number, point) for all nodes in order.
    template <class F>
    void for_each_node(F&& f) const {
        walk([&](const Point& p, std::size_t at) {
            if (node_[at] != no_index) {
                f(node_[at], p);
            }
        });
    }
    /// Calls f(point) for all cells in order.
    template <class F>
    void for_each_cell(F&& f) const {
        walk([&](const Point& p, std::size_t at) {
            if (cell_[at] != 0) {
                f(p);
            }
        });
    }

private:
    [[nodiscard]] std::size_t position(const Point& p) const {
        std::size_t at = 0;
        for (std::size_t a = 0; a < D; ++a) {
            at += static_cast<std::size_t>(p[a] - low_[a]) * stride_[a];
        }
        return at;
    }
    /// The cell on side c of p; bit a of c set: the one at p[a], else the one before.
    [[nodiscard]] static Point neighbour(Point p, std::size_t c) {
        for (std::size_t a = 0; a < D; ++a) {
            p[a] -= (c >> a & 1U) != 0 ? 0 : 1;
        }
        return p;
    }
    template <class F>
    void walk(F&& f) const {
        Point p = low_;
        for (std::size_t at = 0; at < cell_.size(); ++at) {
            f(p, at);
            for (std::size_t a = 0; a < D && ++p[a] > high_[a]; ++a) {
                p[a] = low_[a];
            }
        }
    }

    void bound(std::span<const LatticeFacet<D>> facets) {
        if (facets.empty()) {
            throw InputError(ErrorCode::empty_input, "a region needs a boundary");
        }
        low_.fill(std::numeric_limits<int>::max());
        high_.fill(std::numeric_limits<int>::min());
        for (const LatticeFacet<D>& f : facets) {
            for (std::size_t a = 0; a < D; ++a) {
                low_[a] = std::min(low_[a], f.low[a]);
                high_[a] = std::max(high_[a], f.low[a] + (static_cast<int>(a) == f.axis ? 0 : 1));
            }
        }
        std::size_t points = 1;
        for (std::size_t a = 0; a < D; ++a) {
            stride_[a] = points;
            points *= static_cast<std::size_t>(high_[a] - low_[a]) + 1;
            if (points > std::numeric_limits<std::int32_t>::max()) {
                throw InputError(ErrorCode::overflow, "the logical box of the region has more than 2^31 points");
            }
        }
        cell_.assign(points, 0);
    }

    void fill(std::span<const LatticeFacet<D>> facets) {
        std::vector<std::int8_t> change(cell_.size(), 0);
        for (const LatticeFacet<D>& f : facets) {
            if (f.axis == 0) {
                std::int8_t& at = change[position(f.low)];
                at = static_cast<std::int8_t>(at - f.outward);
            }
        }
        int winding = 0;
        walk([&](const Point& p, std::size_t at) {
            winding += change[at];
            const bool last = p[0] == high_[0];
            if (overlap_.empty() && (winding < 0 || winding > (last ? 0 : 1))) {
                note_overlap(facets, p);
            }
            cell_[at] = winding > 0 ? 1 : 0;
            cell_count_ += winding > 0 ? 1U : 0U;
            winding = last ? 0 : winding;
        });
    }

    void note_overlap(std::span<const LatticeFacet<D>> facets, const Point& p) {
        for (const LatticeFacet<D>& f : facets) {
            if (f.axis == 0 && std::equal(p.begin() + 1, p.end(), f.low.begin() + 1)) {
                overlap_.push_back(f.entity);
            }
        }
        std::sort(overlap_.begin(), overlap_.end());
        overlap_.erase(std::unique(overlap_.begin(), overlap_.end()), overlap_.end());
    }

    void number_nodes() {
        node_.assign(cell_.size(), no_index);
        walk([&](const Point& p, std::size_t at) {
            bool used = false;
            for (std::size_t c = 0; !used && c < (std::size_t{1} << D); ++c) {
                used = has_cell(neighbour(p, c));
            }
            if (used) {
                node_[at] = static_cast<Index>(node_count_++);
            }
        });
    }

    Point low_{}, high_{};
    std::array<std::size_t, D> stride_{};
    std::vector<std::uint8_t> cell_;  ///< per lattice point of the box: 1 if the cell there belongs to the region
    std::vector<Index> node_;         ///< per lattice point of the box
    std::vector<Index> overlap_;
    std::size_t node_count_ = 0, cell_count_ = 0;
};

}  // namespace pavior
