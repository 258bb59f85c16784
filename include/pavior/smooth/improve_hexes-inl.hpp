#pragma once

#include <pavior/core/error.hpp>
#include <pavior/smooth/detail/guided_model.hpp>
#include <pavior/smooth/detail/untangle.hpp>
#include <pavior/smooth/detail/worst_first.hpp>
#include <pavior/smooth/improve_hexes.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace pavior {

namespace detail {

inline void check_options(const ImproveOptions& options) {
    const auto require = [](bool condition, const char* message) {
        if (!condition) {
            throw InputError(ErrorCode::bad_option, message);
        }
    };
    require(options.target > 0.0 && options.target <= 1.0, "ImproveOptions::target must lie in (0, 1]");
    require(options.sufficient >= 0.0 && options.sufficient <= 1.0, "ImproveOptions::sufficient must lie in [0, 1]");
    require(options.gain > 0.0 && options.gain <= 0.5, "ImproveOptions::gain must lie in (0, 0.5]");
    require(options.rings >= 1 && options.rings <= 1000, "ImproveOptions::rings must lie in [1, 1000]");
    require(options.effort > 0.0, "ImproveOptions::effort must be above 0");
    require(options.attempts >= 1, "ImproveOptions::attempts must be at least 1");
}

PAVIOR_INLINE void check_guide(std::size_t known, std::size_t nodes) {
    if (known != nodes) {
        throw InputError(ErrorCode::size_mismatch,
                         "a guide of " + std::to_string(known) + " nodes for a mesh of " + std::to_string(nodes));
    }
}

PAVIOR_INLINE void check_improve(std::span<Vec3> nodes, std::span<const HexCorners> hexes,
                                 const ImproveOptions& options, std::span<const Vec3> reference) {
    check_options(options);
    check_mesh<3>(nodes, hexes, nodes.size(), reference);
}

/// Repairs, then raises the worst first; \p result holds what was before.
inline void repair_and_raise(std::span<Vec3> nodes, std::span<const HexCorners> hexes, GuidedModel& model,
                             std::span<const std::uint8_t> fixed, const UntangleOptions& untangling,
                             const ImproveOptions& options, SmoothReport& result) {
    const std::vector<Vec3> input(nodes.begin(), nodes.end());
    try {
        if (result.inverted_before != 0) {
            result.iterations = Untangler<3, GuidedModel>(model, hexes, fixed, untangling).run().iterations;
        }
        PatchFinder<3> finder(hexes, fixed);
        const WorstFirstOptions limits{
            options.target,    options.sufficient,
            options.gain,      options.rings,
            options.attempts,  options.effort,
            options.execution, result.inverted_before != 0 ? stage_of(options.progress, 0.5, 1.0) : options.progress};
        WorstFirst<GuidedModel> improver(model, hexes.size(), finder, limits);
        result.iterations += improver.run();
        for (std::size_t i = 0; i < nodes.size(); ++i) {
            result.moved_nodes += nodes[i] != input[i] ? 1U : 0U;
        }
        set_after(result, improver.quality(), options.max_ids);
    } catch (...) {
        std::copy(input.begin(), input.end(), nodes.begin());
        throw;
    }
}

PAVIOR_INLINE SmoothReport improve(std::span<Vec3> nodes, std::span<const HexCorners> hexes, const GuideView& guide,
                                   std::span<const Freedom> freedoms, const ImproveOptions& options,
                                   std::span<const Vec3> reference) {
    std::vector<std::uint8_t> fixed(nodes.size());
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        fixed[i] = freedoms[i] == Freedom::fixed ? 1 : 0;
    }
    UntangleOptions untangling;
    untangling.keep_minimum = true;
    untangling.sufficient_det = 0.0;  // the second step raises it
    untangling.positivity = options.positivity;
    untangling.execution = options.execution;
    untangling.progress = stage_of(options.progress, 0.0, 0.5);
    GuidedModel model(nodes, hexes, fixed, guide, freedoms, reference, untangling);
    SmoothReport result;
    const std::vector<double> quality = scan_quality(model, hexes.size(), options.execution);
    set_before(result, quality);
    if (result.inverted_before == 0 && result.min_det_before >= options.target - options.gain) {
        set_after(result, quality, options.max_ids);
    } else {
        repair_and_raise(nodes, hexes, model, fixed, untangling, options, result);
    }
    return result;
}

}  // namespace detail

}  // namespace pavior
