#pragma once

#include <pavior/brep/node_entities.hpp>
#include <pavior/brep/touching_solids.hpp>
#include <pavior/core/error.hpp>
#include <pavior/core/stopwatch.hpp>
#include <pavior/mesh/append_mesh.hpp>
#include <pavior/part/decide.hpp>
#include <pavior/part/entity_groups.hpp>
#include <pavior/part/local_lengths.hpp>
#include <pavior/part/mesh_part.hpp>
#include <pavior/part/try_method.hpp>

#include <algorithm>
#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace pavior {

namespace detail {

/// \p options for a group of which with those after it \p solids are left, so many seconds after the call began.
[[nodiscard]] inline PartOptions within_call(PartOptions options, double seconds, std::size_t solids) {
    if (options.call_seconds > 0) {
        const double share = std::max(options.call_seconds - seconds, 0.01) / static_cast<double>(solids);
        options.seconds = options.seconds > 0 ? std::min(options.seconds, share) : share;
    }
    return options;
}

PAVIOR_INLINE PartMesh mesh_groups(const AnyModel& b, const PartOptions& given, const GroupAttempt& attempt) {
    check_options(given);
    PartMesh result;
    const Stopwatch watch;
    PartOptions options = given;
    options.local = lengths_by_tag(b, given.local);
    options.size = given.size > 0 ? given.size : diagonal_of(b) / 12;
    const std::vector<SolidId> solids = all_solids(b);
    require_expected_at_most(expected_hexahedra(b, solids, options.size, options.local.solid), options.max_hexahedra,
                             options.size);
    std::size_t left = solids.size();
    const auto most = static_cast<double>(std::max<std::size_t>(options.methods.size(), 7));
    const std::vector<std::vector<SolidId>> groups = touching_solids(b, std::span<const SolidId>(solids));
    for (const std::vector<SolidId>& group : groups) {
        const double first = static_cast<double>(result.decisions.size()) / static_cast<double>(groups.size());
        std::size_t tries = 0;
        const PartOptions own = within_call(options, watch.total(), left);
        left -= group.size();
        result.decisions.push_back(decide(group, own, [&](PartMethod method, double seconds) {
            const double share = static_cast<double>(tries++) / (most * static_cast<double>(groups.size()));
            report(options.progress, to_string(method), first + share);
            return attempt(method, group, own, seconds);
        }));
    }
    bool first = true;
    for (PartDecision& decision : result.decisions) {
        if (decision.taken) {
            const CadDeviation& own = decision.tries[*decision.taken].deviation;
            result.deviation = std::exchange(first, false) ? own : result.deviation + own;
            MethodTry& taken = decision.tries[*decision.taken];
            HexMeshData part = std::exchange(taken.data, {});
            result.hex_solid.insert(result.hex_solid.end(), taken.hex_solid.begin(), taken.hex_solid.end());
            result.quad_face.insert(result.quad_face.end(), taken.quad_face.begin(), taken.quad_face.end());
            append_mesh(part.mesh, part.quads, result.data.mesh, result.data.quads);
            result.data.hex_groups.insert(result.data.hex_groups.end(), part.hex_groups.begin(), part.hex_groups.end());
            result.data.quad_groups.insert(result.data.quad_groups.end(), part.quad_groups.begin(),
                                           part.quad_groups.end());
        }
    }
    result.data.groups = entity_groups(b, solids);
    result.check = check_mesh(result.data.mesh, options.execution);
    if (options.node_entities && result.valid()) {
        const HexMeshData& data = result.data;
        result.entities =
            node_entities(b, data.mesh.nodes, data.mesh.hexes, result.hex_solid, data.quads, result.quad_face);
    }
    result.seconds = watch.total();
    report(options.progress, "done", 1);
    return result;
}

}  // namespace detail

PAVIOR_INLINE PartMesh mesh_part(const AnyModel& model, const PartOptions& options, const Kernels& kernels) {
    PartOptions possible = options;
    possible.last_resort = options.last_resort && kernels.tets != nullptr;
    possible.decompose = options.decompose && kernels.cut != nullptr;
    return detail::mesh_groups(
        model, possible,
        [&](PartMethod method, std::span<const SolidId> solids, const PartOptions& own, double seconds) {
            const Stopwatch watch;
            return try_method(method, model, solids, own, kernels,
                              {.out_of_time = [&] { return seconds > 0 && watch.total() > 0.7 * seconds; },
                               .no_time_to_check = [&] { return seconds > 0 && watch.total() > seconds; },
                               .seconds = seconds});
        });
}

}  // namespace pavior
