#pragma once

#include <pavior/brep/node_entities.hpp>
#include <pavior/brep/touching_solids.hpp>
#include <pavior/core/error.hpp>
#include <pavior/core/stopwatch.hpp>
#include <pavior/mesh/append_mesh.hpp>
#include <pavior/part/decide.hpp>
#include <pavior/part/entity_groups.hpp>
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

/// PartOptions::named_size as sizes by tag. \throws InputError bad_option for a name that nothing bears
[[nodiscard]] inline PartOptions with_named_sizes(const AnyModel& b, PartOptions options) {
    const auto named = std::exchange(options.named_size, {});
    const std::map<int, FaceId> faces = faces_by_tag(b);
    for (const auto& [name, size] : named) {
        bool found = false;
        for (const auto& [tag, face] : faces) {
            if (name_of(b, face) == name) {
                options.face_size[tag] = size;
                found = true;
            }
        }
        for (const SolidId s : all_solids(b)) {
            if (name_of(b, s) == name) {
                options.solid_size[b.tag(3, s.index())] = size;
                found = true;
            }
        }
        if (!found) {
            throw InputError(ErrorCode::bad_option, "no face and no solid is called '" + name + "'");
        }
    }
    return options;
}

PAVIOR_INLINE PartMesh mesh_groups(const AnyModel& b, const PartOptions& given, const GroupAttempt& attempt) {
    check_options(given);
    const PartOptions options = with_named_sizes(b, given);
    PartMesh result;
    const Stopwatch watch;
    const std::vector<SolidId> solids = all_solids(b);
    const auto most = static_cast<double>(std::max<std::size_t>(options.methods.size(), 5));
    const std::vector<std::vector<SolidId>> groups = touching_solids(b, std::span<const SolidId>(solids));
    for (const std::vector<SolidId>& group : groups) {
        const double first = static_cast<double>(result.decisions.size()) / static_cast<double>(groups.size());
        std::size_t tries = 0;
        result.decisions.push_back(decide(group, options, [&](PartMethod method, double seconds) {
            const double share = static_cast<double>(tries++) / (most * static_cast<double>(groups.size()));
            report(options.progress, to_string(method), first + share);
            return attempt(method, group, options, seconds);
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
    return detail::mesh_groups(
        model, options,
        [&](PartMethod method, std::span<const SolidId> solids, const PartOptions& own, double seconds) {
            const Stopwatch watch;
            return try_method(method, model, solids, own, kernels,
                              {.out_of_time = [&] { return seconds > 0 && watch.total() > 0.7 * seconds; },
                               .no_time_to_check = [&] { return seconds > 0 && watch.total() > seconds; }});
        });
}

}  // namespace pavior
