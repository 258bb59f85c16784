#pragma once
/// \file
/// The nodes of a sweep, level by level: Algorithm 4.1 \cite roca2009.

#include <pavior/core/execution.hpp>
#include <pavior/core/parallel_for.hpp>
#include <pavior/core/progress.hpp>
#include <pavior/sweep/boundary_error.hpp>
#include <pavior/sweep/detail/cap_array.hpp>
#include <pavior/sweep/level_map.hpp>
#include <pavior/sweep/node_kernel.hpp>
#include <pavior/sweep/problem.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace pavior {

/// All nodes of a sweep without storing them: the position of node i of level k follows from the operator of the level
/// and from both caps. Nodes of a level are in source order. The caps and the boundary nodes are copied, not computed.
/// Every way out gives the same bits, for any number of threads and any order of levels. Immutable: any number of
/// threads may read one object. Memory O(n + m r).
class InnerLayers {
public:
    /// \pre verify_problem(problem) finds nothing, and \p maps are those of problem (make_level_maps).
    InnerLayers(SweepProblem problem, std::vector<LevelMap> maps, BoundaryCorrection correction)
        : problem_(std::move(problem)),
          maps_(std::move(maps)),
          source_centre_(maps_.empty() ? Vec3(Vec3::Zero()) : maps_.front().from_source.cx),
          target_centre_(maps_.empty() ? Vec3(Vec3::Zero()) : maps_.back().from_target.cx),
          caps_(maps_.empty()
                    ? detail::CapArray()
                    : detail::CapArray(problem_.source_nodes, problem_.target_nodes, source_centre_, target_centre_)) {
        for (const LevelMap& map : maps_) {
            operators_.push_back(fold(map, source_centre_, target_centre_));
        }
        const bool exact = std::all_of(maps_.begin(), maps_.end(), [](const LevelMap& map) { return map.exact; });
        correction_ = exact ? BoundaryCorrection::none : correction;
        source_error_ = BoundaryError(correction_, problem_.source_nodes, problem_.quads, problem_.loops.nodes);
        target_error_ = BoundaryError(correction_, problem_.target_nodes, problem_.quads, problem_.loops.nodes);
    }

    [[nodiscard]] const SweepProblem& problem() const { return problem_; }
    [[nodiscard]] std::span<const LevelMap> maps() const { return maps_; }
    [[nodiscard]] std::size_t level_count() const { return problem_.layers + 1; }
    [[nodiscard]] std::size_t level_size() const { return problem_.level_size(); }

    /// Writes the n nodes of level k, 0 <= k <= r, to \p out. O(n), with inverse-distance correction O(n m).
    /// \throws InputError size_mismatch (length of \p out), bad_index (k)
    void level(std::size_t k, std::span<Vec3> out, Execution execution = {}) const {
        check(k < level_count(), ErrorCode::bad_index, "no level " + std::to_string(k));
        check(out.size() == level_size(), ErrorCode::size_mismatch,
              "a level has " + std::to_string(level_size()) + " nodes, not " + std::to_string(out.size()));
        write_levels(k, k + 1, out.data(), execution, false);
    }

    /// Calls sink(k, nodes) for k = 0, 1, ... r with the n nodes of the level as a std::span<const Vec3> that is valid
    /// during the call. Levels are made in groups that share the weights of the correction: memory for at most 16
    /// levels and at most 64 MB (but one level at least), whatever r is.
    template <class Sink>
    void for_each_level(Sink&& sink, Execution execution = {}, const Progress& progress = {}) const {
        const std::size_t bytes = std::max<std::size_t>(1, level_size() * sizeof(Vec3));
        const std::size_t group = std::clamp<std::size_t>((std::size_t{64} << 20) / bytes, 1, 16);
        std::vector<Vec3> buffer(std::min(group, level_count()) * level_size());
        for (std::size_t first = 0; first < level_count(); first += group) {
            const std::size_t last = std::min(first + group, level_count());
            write_levels(first, last, buffer.data(), execution, false);
            for (std::size_t k = first; k < last; ++k) {
                sink(k, std::span<const Vec3>(buffer).subspan((k - first) * level_size(), level_size()));
                report(progress, "nodes", static_cast<double>(k + 1) / static_cast<double>(level_count()));
            }
        }
    }

    /// Writes all (r + 1) n nodes, level by level. \throws InputError size_mismatch (length of \p out)
    void all_levels(std::span<Vec3> out, Execution execution = {}, const Progress& progress = {}) const {
        check(out.size() == level_size() * level_count(), ErrorCode::size_mismatch,
              "the sweep has " + std::to_string(level_size() * level_count()) + " nodes, not " +
                  std::to_string(out.size()));
        const bool stream = out.size_bytes() > stream_threshold;
        // Levels that share one pass over the weights; harmonic fields are held for all nodes of a group at once.
        const std::size_t group = correction_ == BoundaryCorrection::none  ? level_count()
                                  : correction_ == BoundaryCorrection::idw ? 64
                                                                           : 16;
        for (std::size_t first = 0; first < level_count(); first += group) {
            const std::size_t last = std::min(first + group, level_count());
            write_levels(first, last, out.data() + first * level_size(), execution, stream);
            report(progress, "nodes", static_cast<double>(last) / static_cast<double>(level_count()));
        }
    }

private:
    /// Nodes that one thread brings to all levels of a group before it goes on: their caps stay in its cache.
    static constexpr std::size_t block = 1024;
    /// Outputs beyond this (bytes) are written past the caches.
    static constexpr std::size_t stream_threshold = std::size_t{32} << 20;

    static void check(bool good, ErrorCode code, const std::string& message) {
        if (!good) {
            throw InputError(code, message);
        }
    }

    /// What the correction of a group of levels needs: the columns of each, and both caps' prepared residuals.
    struct GroupCorrection {
        std::vector<std::size_t> column;  ///< first column of level first + j, or none
        std::size_t columns = 0;
        BoundaryError::Prepared source;
        BoundaryError::Prepared target;
    };
    static constexpr std::size_t none = static_cast<std::size_t>(-1);

    [[nodiscard]] bool is_inner(std::size_t k) const { return k > 0 && k < problem_.layers; }

    [[nodiscard]] GroupCorrection correct(std::size_t first, std::size_t last, Execution execution) const {
        GroupCorrection group;
        for (std::size_t k = first; k < last; ++k) {
            const bool wanted = correction_ != BoundaryCorrection::none && is_inner(k) && !maps_[k - 1].exact;
            group.column.push_back(wanted ? group.columns : none);
            group.columns += wanted ? 3 : 0;
        }
        if (group.columns == 0) {
            return group;
        }
        const auto m = static_cast<Eigen::Index>(problem_.loops.nodes.size());
        Eigen::MatrixXd source(m, static_cast<Eigen::Index>(group.columns));
        Eigen::MatrixXd target(m, static_cast<Eigen::Index>(group.columns));
        for (std::size_t k = first; k < last; ++k) {
            if (group.column[k - first] != none) {
                const auto column = static_cast<Eigen::Index>(group.column[k - first]);
                set_residuals(k, source.middleCols<3>(column), target.middleCols<3>(column));
            }
        }
        group.source = source_error_.prepare(source, execution);
        group.target = target_error_.prepare(target, execution);
        return group;
    }

    /// Residuals of level k, weighted as the maps are.
    void set_residuals(std::size_t k, Eigen::Ref<Eigen::MatrixXd> source, Eigen::Ref<Eigen::MatrixXd> target) const {
        const LevelMap& map = maps_[k - 1];
        for (std::size_t i = 0; i < problem_.loops.nodes.size(); ++i) {
            const Vec3& x = problem_.level(k)[i];
            const auto row = static_cast<Eigen::Index>(i);
            source.row(row) = (1.0 - map.blending) * (x - map.from_source(problem_.level(0)[i])).transpose();
            target.row(row) = map.blending * (x - map.from_target(problem_.level(problem_.layers)[i])).transpose();
        }
    }

    /// Levels [first, last) to out[(k - first) * n + i].
    void write_levels(std::size_t first, std::size_t last, Vec3* out, Execution execution, bool stream) const {
        const GroupCorrection group = correct(first, last, execution);
        parallel_for(execution, level_size(), block, [&](std::size_t begin, std::size_t end) {
            std::vector<double> field(group.columns * block);
            for (std::size_t b = begin; b < end; b += block) {
                write_block(group, first, last, b, std::min(b + block, end), out, stream, field);
            }
            finish_streaming();
        });
        parallel_for(execution, last - first, 1, [&](std::size_t begin, std::size_t end) {
            for (std::size_t j = begin; j < end; ++j) {
                copy_given(first + j, out + j * level_size());
            }
        });
    }

    /// Nodes [begin, end) of the inner ones among the levels [first, last).
    void write_block(const GroupCorrection& group, std::size_t first, std::size_t last, std::size_t begin,
                     std::size_t end, Vec3* out, bool stream, std::vector<double>& field) const {
        if (group.columns != 0) {
            std::fill(field.begin(), field.end(), 0.0);
            source_error_.add(group.source, begin, end, field.data(), block);
            target_error_.add(group.target, begin, end, field.data(), block);
        }
        KernelOptions options;
        options.stream = stream;
        for (std::size_t k = first; k < last; ++k) {
            if (is_inner(k)) {
                const std::size_t column = group.column[k - first];
                const double* correction = column == none ? nullptr : field.data() + column * block;
                double* nodes = out[(k - first) * level_size() + begin].data();
                apply_level(operators_[k - 1], caps_.rows(), correction, block, begin, end, nodes, options);
            }
        }
    }

    /// The nodes of level k that are given: all of a cap, the loops elsewhere.
    void copy_given(std::size_t k, Vec3* nodes) const {
        if (is_inner(k)) {
            const std::span<const Vec3> points = problem_.level(k);
            for (std::size_t i = 0; i < points.size(); ++i) {
                nodes[problem_.loops.nodes[i]] = points[i];
            }
        } else {
            const std::vector<Vec3>& cap = k == 0 ? problem_.source_nodes : problem_.target_nodes;
            std::copy(cap.begin(), cap.end(), nodes);
        }
    }

    SweepProblem problem_;
    std::vector<LevelMap> maps_;
    Vec3 source_centre_;
    Vec3 target_centre_;
    detail::CapArray caps_;
    std::vector<LevelOperator> operators_;
    BoundaryCorrection correction_ = BoundaryCorrection::none;
    BoundaryError source_error_;
    BoundaryError target_error_;
};

}  // namespace pavior
