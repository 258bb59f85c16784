#pragma once
/// \file
/// The nodes of a sweep, level by level: Algorithm 4.1 \cite roca2009.

#include <pavior/core/compiled.hpp>
#include <pavior/core/execution.hpp>
#include <pavior/core/progress.hpp>
#include <pavior/sweep/boundary_error.hpp>
#include <pavior/sweep/detail/cap_array.hpp>
#include <pavior/sweep/level_map.hpp>
#include <pavior/sweep/node_kernel.hpp>
#include <pavior/sweep/problem.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace pavior {

/// All nodes of a sweep without storing them: the position of node i of level k follows from the operator of the level
/// and from both caps. Nodes of a level are in source order. The caps and the boundary nodes are copied, not computed.
/// Every way out gives the same bits, for any number of threads and any order of levels. Immutable: any number of
/// threads may read one object. Memory O(n + m r).
class InnerLayers {
public:
    /// \pre verify_problem(problem) finds nothing, and \p maps are those of problem (make_level_maps).
    InnerLayers(SweepProblem problem, std::vector<LevelMap> maps, BoundaryCorrection correction);

    [[nodiscard]] const SweepProblem& problem() const { return problem_; }
    [[nodiscard]] std::span<const LevelMap> maps() const { return maps_; }
    [[nodiscard]] std::size_t level_count() const { return problem_.layers + 1; }
    [[nodiscard]] std::size_t level_size() const { return problem_.level_size(); }

    /// Writes the n nodes of level k, 0 <= k <= r, to \p out. O(n), with inverse-distance correction O(n m).
    /// \throws InputError size_mismatch (length of \p out), bad_index (k)
    void level(std::size_t k, std::span<Vec3> out, Execution execution = {}) const;

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
    void all_levels(std::span<Vec3> out, Execution execution = {}, const Progress& progress = {}) const;

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
        std::vector<std::size_t> column;  ///< first column of level first + j, or no_position
        std::size_t columns = 0;
        BoundaryError::Prepared source;
        BoundaryError::Prepared target;
    };

    [[nodiscard]] bool is_inner(std::size_t k) const { return k > 0 && k < problem_.layers; }

    [[nodiscard]] GroupCorrection correct(std::size_t first, std::size_t last, Execution execution) const;

    /// Residuals of level k, weighted as the maps are.
    void set_residuals(std::size_t k, Eigen::Ref<Eigen::MatrixXd> source, Eigen::Ref<Eigen::MatrixXd> target) const;

    /// Levels [first, last) to out[(k - first) * n + i].
    void write_levels(std::size_t first, std::size_t last, Vec3* out, Execution execution, bool stream) const;

    /// Nodes [begin, end) of the inner ones among the levels [first, last).
    void write_block(const GroupCorrection& group, std::size_t first, std::size_t last, std::size_t begin,
                     std::size_t end, Vec3* out, bool stream, std::vector<double>& field) const;

    /// The nodes of level k that are given: all of a cap, the loops elsewhere.
    void copy_given(std::size_t k, Vec3* nodes) const;

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

#ifndef PAVIOR_COMPILED
#include <pavior/sweep/inner_layers-inl.hpp>
#endif
