#pragma once
/// \file
/// The door: hexahedra for all solids of a model, each group that hangs together by the method that suits it.

#include <pavior/brep/node_entities.hpp>
#include <pavior/brep/touching_solids.hpp>
#include <pavior/core/error.hpp>
#include <pavior/core/stopwatch.hpp>
#include <pavior/mesh/append_mesh.hpp>
#include <pavior/part/decide.hpp>
#include <pavior/part/entity_groups.hpp>
#include <pavior/part/kernels.hpp>
#include <pavior/part/part_mesh.hpp>
#include <pavior/part/try_method.hpp>

#include <algorithm>
#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace pavior {

namespace detail {

/// PartOptions::named_size as sizes by tag. \throws InputError bad_option for a name that nothing bears
template <brep B>
[[nodiscard]] PartOptions with_named_sizes(const B& b, PartOptions options) {
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

/// node_entities() of a mesh whose groups are tags of the entities of \p b.
template <brep B>
[[nodiscard]] NodeEntities entities_of(const B& b, const HexMeshData& data) {
    std::map<int, SolidId> solid;
    for (const SolidId s : all_solids(b)) {
        solid.emplace(b.tag(3, s.index()), s);
    }
    const std::map<int, FaceId> face = faces_by_tag(b);
    std::vector<SolidId> hex_solid;
    for (const int tag : data.hex_groups) {
        hex_solid.push_back(solid.at(tag));
    }
    std::vector<FaceId> quad_face;
    for (const int tag : data.quad_groups) {
        quad_face.push_back(face.at(tag));
    }
    return node_entities(b, data.mesh.nodes, data.mesh.hexes, hex_solid, data.quads, quad_face);
}

/// Decides group by group and joins what was taken. attempt(method, solids, seconds) makes a try.
template <brep B, class Attempt>
[[nodiscard]] PartMesh mesh_groups(const B& b, const PartOptions& options, const Attempt& attempt) {
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
            return attempt(method, std::span<const SolidId>(group), seconds);
        }));
    }
    for (PartDecision& decision : result.decisions) {
        if (decision.taken) {
            HexMeshData part = std::exchange(decision.tries[*decision.taken].data, {});
            append_mesh(part.mesh, part.quads, result.data.mesh, result.data.quads);
            result.data.hex_groups.insert(result.data.hex_groups.end(), part.hex_groups.begin(), part.hex_groups.end());
            result.data.quad_groups.insert(result.data.quad_groups.end(), part.quad_groups.begin(),
                                           part.quad_groups.end());
        }
    }
    result.data.groups = entity_groups(b, solids);
    result.check = check_mesh(result.data.mesh, options.execution);
    if (options.node_entities && result.valid()) {
        result.entities = entities_of(b, result.data);
    }
    result.seconds = watch.total();
    report(options.progress, "done", 1);
    return result;
}

}  // namespace detail

/// Meshes the solids of \p b with \p kernels, everything in this process: solids that touch are decided on together
/// (decide()), conforming; the meshes of the groups come one after the other.
/// Limits of time are kept as far as the methods ask for them: foreign code runs on. mesh_file() of pavior::part runs
/// each try in a process that is ended.
/// Deterministic if model and kernels are and no limit of time strikes; the same bytes for any number of threads.
/// \throws InputError bad_option (sizes, names). What cannot be meshed throws nothing: see PartMesh::decisions.
template <brep B, class K>
[[nodiscard]] PartMesh mesh_part(const B& b, const PartOptions& options, K&& kernels) {
    check_options(options);
    const PartOptions own = detail::with_named_sizes(b, options);
    return detail::mesh_groups(b, own, [&](PartMethod method, std::span<const SolidId> solids, double seconds) {
        const Stopwatch watch;
        return try_method(method, b, solids, own, kernels,
                          [&] { return seconds > 0 && watch.total() > 0.7 * seconds; });
    });
}

}  // namespace pavior
