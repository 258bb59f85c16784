#pragma once

#include <pavior/core/parallel_for.hpp>
#include <pavior/sweep/inner_layers.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace pavior {

PAVIOR_INLINE InnerLayers::InnerLayers(SweepProblem problem, std::vector<LevelMap> maps, BoundaryCorrection correction)
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

PAVIOR_INLINE void InnerLayers::level(std::size_t k, std::span<Vec3> out, Execution execution) const {
    check(k < level_count(), ErrorCode::bad_index, "no level " + std::to_string(k));
    check(out.size() == level_size(), ErrorCode::size_mismatch,
          "a level has " + std::to_string(level_size()) + " nodes, not " + std::to_string(out.size()));
    write_levels(k, k + 1, out.data(), execution, false);
}

PAVIOR_INLINE void InnerLayers::all_levels(std::span<Vec3> out, Execution execution, const Progress& progress) const {
    check(
        out.size() == level_size() * level_count(), ErrorCode::size_mismatch,
        "the sweep has " + std::to_string(level_size() * level_count()) + " nodes, not " + std::to_string(out.size()));
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

PAVIOR_INLINE InnerLayers::GroupCorrection InnerLayers::correct(std::size_t first, std::size_t last,
                                                                Execution execution) const {
    GroupCorrection group;
    for (std::size_t k = first; k < last; ++k) {
        const bool wanted = correction_ != BoundaryCorrection::none && is_inner(k) && !maps_[k - 1].exact;
        group.column.push_back(wanted ? group.columns : no_position);
        group.columns += wanted ? 3 : 0;
    }
    if (group.columns == 0) {
        return group;
    }
    const auto m = static_cast<Eigen::Index>(problem_.loops.nodes.size());
    Eigen::MatrixXd source(m, static_cast<Eigen::Index>(group.columns));
    Eigen::MatrixXd target(m, static_cast<Eigen::Index>(group.columns));
    for (std::size_t k = first; k < last; ++k) {
        if (group.column[k - first] != no_position) {
            const auto column = static_cast<Eigen::Index>(group.column[k - first]);
            set_residuals(k, source.middleCols<3>(column), target.middleCols<3>(column));
        }
    }
    group.source = source_error_.prepare(source, execution);
    group.target = target_error_.prepare(target, execution);
    return group;
}

PAVIOR_INLINE void InnerLayers::set_residuals(std::size_t k, Eigen::Ref<Eigen::MatrixXd> source,
                                              Eigen::Ref<Eigen::MatrixXd> target) const {
    const LevelMap& map = maps_[k - 1];
    for (std::size_t i = 0; i < problem_.loops.nodes.size(); ++i) {
        const Vec3& x = problem_.level(k)[i];
        const auto row = static_cast<Eigen::Index>(i);
        source.row(row) = (1.0 - map.blending) * (x - map.from_source(problem_.level(0)[i])).transpose();
        target.row(row) = map.blending * (x - map.from_target(problem_.level(problem_.layers)[i])).transpose();
    }
}

PAVIOR_INLINE void InnerLayers::write_levels(std::size_t first, std::size_t last, Vec3* out, Execution execution,
                                             bool stream) const {
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

PAVIOR_INLINE void InnerLayers::write_block(const GroupCorrection& group, std::size_t first, std::size_t last,
                                            std::size_t begin, std::size_t end, Vec3* out, bool stream,
                                            std::vector<double>& field) const {
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
            const double* correction = column == no_position ? nullptr : field.data() + column * block;
            double* nodes = out[(k - first) * level_size() + begin].data();
            apply_level(operators_[k - 1], caps_.rows(), correction, block, begin, end, nodes, options);
        }
    }
}

PAVIOR_INLINE void InnerLayers::copy_given(std::size_t k, Vec3* nodes) const {
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

}  // namespace pavior
