#pragma once
/// \file
/// Quality of meshes: statistics and histograms of the metrics of their cells.

#include <pavior/core/chunks.hpp>
#include <pavior/core/compiled.hpp>
#include <pavior/core/error.hpp>
#include <pavior/core/parallel_for.hpp>
#include <pavior/math/hexahedron.hpp>
#include <pavior/math/quadrilateral.hpp>
#include <pavior/mesh/mesh_access.hpp>

#include <array>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

namespace pavior {

/// Statistics of one metric over the cells of a mesh. All null for an empty mesh.
struct Statistics {
    std::size_t count = 0;
    double min = 0.0;
    double max = 0.0;
    double mean = 0.0;
    double stddev = 0.0;  ///< of the population: root of the mean square deviation
    Index worst = 0;      ///< cell of the smallest value, the smallest id if there are several
    double low = 0.0;     ///< where the histogram begins
    double high = 1.0;    ///< where it ends
    /// histogram[b]: cells in [low + b w, low + (b + 1) w), w = (high - low) / bins; values outside go to the end bins.
    std::vector<std::size_t> histogram;

    friend bool operator==(const Statistics&, const Statistics&) = default;
};

/// Options of hex_quality() and quad_quality().
struct QualityOptions {
    std::size_t bins = 10;  ///< bins of each histogram, at least 1
    Execution execution = sequential;
};

/// Result of hex_quality(). Histograms run over [0, 1], that of the scaled Jacobian over [-1, 1].
struct HexQuality {
    Statistics f_shape;          ///< hex_f_shape()
    Statistics verdict_shape;    ///< hex_verdict_shape()
    Statistics scaled_jacobian;  ///< hex_scaled_jacobian()
    std::size_t inverted = 0;    ///< hexahedra with a scaled Jacobian <= 0

    friend bool operator==(const HexQuality&, const HexQuality&) = default;
};

/// Result of quad_quality(). Histograms as in HexQuality.
struct QuadQuality {
    Statistics shape;            ///< quad_shape(), each quad seen along its own normal
    Statistics scaled_jacobian;  ///< quad_scaled_jacobian(), likewise
    std::size_t inverted = 0;    ///< quads with a scaled Jacobian <= 0: not convex seen along their normal

    friend bool operator==(const QuadQuality&, const QuadQuality&) = default;
};

namespace detail {

/// Statistics in the making: mean and the sum of square deviations, merged pairwise without cancellation.
class Tally {
public:
    Tally() = default;
    Tally(double low, double high, std::size_t bins) : low_(low), high_(high), histogram_(bins, 0) {}

    void add(double value, Index cell);
    /// Adds the cells of \p later, whose ids are greater.
    void merge(const Tally& later);
    [[nodiscard]] std::size_t not_positive() const { return not_positive_; }
    [[nodiscard]] Statistics result() const;

private:
    double count_ = 0.0;
    double min_ = std::numeric_limits<double>::infinity();
    double max_ = -std::numeric_limits<double>::infinity();
    double mean_ = 0.0;
    double squares_ = 0.0;
    Index worst_ = 0;
    std::size_t not_positive_ = 0;
    double low_ = 0.0;
    double high_ = 1.0;
    std::vector<std::size_t> histogram_;
};

template <std::size_t N, class M>
[[nodiscard]] std::array<Vec3, N> corner_points(const M& mesh, const std::array<Index, N>& corners) {
    std::array<Vec3, N> x;
    for (std::size_t i = 0; i < N; ++i) {
        x[i] = node(mesh, corners[i]);
    }
    return x;
}

/// Tallies of the N metrics that metrics(cell) gives; the last one is the scaled Jacobian.
template <std::size_t N, class Metrics>
[[nodiscard]] std::array<Tally, N> tally(std::size_t cells, const QualityOptions& options, const Metrics& metrics) {
    if (options.bins == 0) {
        throw InputError(ErrorCode::bad_option, "a histogram needs at least one bin");
    }
    std::array<Tally, N> all;
    all.fill(Tally(0.0, 1.0, options.bins));
    all.back() = Tally(-1.0, 1.0, options.bins);
    const auto chunks = map_chunks(options.execution, cells, 4096, [&](std::size_t begin, std::size_t end) {
        std::array<Tally, N> part = all;
        for (std::size_t cell = begin; cell < end; ++cell) {
            const std::array<double, N> values = metrics(static_cast<Index>(cell));
            for (std::size_t m = 0; m < N; ++m) {
                part[m].add(values[m], static_cast<Index>(cell));
            }
        }
        return part;
    });
    for (const auto& chunk : chunks) {
        for (std::size_t m = 0; m < N; ++m) {
            all[m].merge(chunk[m]);
        }
    }
    return all;
}

PAVIOR_INLINE void require_size(std::size_t size, std::size_t cells);

}  // namespace detail

/// The metrics of hexahedron \p h.
template <hex_mesh M>
[[nodiscard]] HexMetrics hex_metrics(const M& mesh, Index h) {
    return hex_metrics(detail::corner_points(mesh, hex(mesh, h)));
}

/// The metrics of quad \p q, seen along its own normal.
template <quad_mesh M>
[[nodiscard]] QuadMetrics quad_metrics(const M& mesh, Index q) {
    return quad_metrics(detail::corner_points(mesh, quad(mesh, q)));
}

/// Writes the metrics of hexahedron h to values[h]. O(n), no allocation; the same bytes for any number of threads.
/// Throws InputError (size_mismatch) unless values.size() is hex_count(mesh). Node ids must be in range.
template <hex_mesh M>
void hex_metrics(const M& mesh, std::span<HexMetrics> values, Execution execution = sequential) {
    detail::require_size(values.size(), hex_count(mesh));
    parallel_for(execution, values.size(), 4096, [&](std::size_t begin, std::size_t end) {
        for (std::size_t h = begin; h < end; ++h) {
            values[h] = hex_metrics(mesh, static_cast<Index>(h));
        }
    });
}

/// Writes the metrics of quad q to values[q]; otherwise as hex_metrics().
template <quad_mesh M>
void quad_metrics(const M& mesh, std::span<QuadMetrics> values, Execution execution = sequential) {
    detail::require_size(values.size(), quad_count(mesh));
    parallel_for(execution, values.size(), 4096, [&](std::size_t begin, std::size_t end) {
        for (std::size_t q = begin; q < end; ++q) {
            values[q] = quad_metrics(mesh, static_cast<Index>(q));
        }
    });
}

/// Statistics of the metrics of all hexahedra. Node ids must be in range (verify_hexes.hpp).
/// O(n), memory O(n / 4096); the same bytes for any number of threads. Throws InputError (bad_option) for bins = 0.
template <hex_mesh M>
[[nodiscard]] HexQuality hex_quality(const M& mesh, const QualityOptions& options = {}) {
    const auto all = detail::tally<3>(hex_count(mesh), options, [&](Index h) {
        const HexMetrics m = hex_metrics(mesh, h);
        return std::array{m.f_shape, m.verdict_shape, m.scaled_jacobian};
    });
    return {all[0].result(), all[1].result(), all[2].result(), all[2].not_positive()};
}

/// Statistics of the metrics of all quads; otherwise as hex_quality().
template <quad_mesh M>
[[nodiscard]] QuadQuality quad_quality(const M& mesh, const QualityOptions& options = {}) {
    const auto all = detail::tally<2>(quad_count(mesh), options, [&](Index q) {
        const QuadMetrics m = quad_metrics(mesh, q);
        return std::array{m.shape, m.scaled_jacobian};
    });
    return {all[0].result(), all[1].result(), all[1].not_positive()};
}

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/mesh/quality-inl.hpp>
#endif
