#pragma once

#include <pavior/brep/all_tags.hpp>
#include <pavior/part/detail/named_solids.hpp>
#include <pavior/submap/submap_recognition.hpp>

#include <algorithm>
#include <set>
#include <span>
#include <string>
#include <vector>

namespace pavior::detail {

PAVIOR_INLINE std::string solid_list(const AnyModel& b, std::span<const SolidId> solids) {
    std::set<int> tags;
    for (const SolidId solid : solids) {
        tags.insert(b.tag(3, solid.index()));
    }
    return list(tags, "solid", "solids");
}

PAVIOR_INLINE std::string message_of(const Error& error) {
    const std::string text = error.what();
    const std::string code(to_string(error.code()));
    return text.substr(text.starts_with(code + ": ") ? code.size() + 2 : 0);
}

PAVIOR_INLINE UnmeshableError naming_solids(const AnyModel& b, std::span<const SolidId> solids,
                                            const UnmeshableError& error) {
    const auto names = [&](const OrientedFace& f) {
        return std::any_of(error.ids().begin(), error.ids().end(),
                           [&](const std::int64_t id) { return has_tag(b, 2, f.face.index(), static_cast<int>(id)); });
    };
    std::vector<SolidId> guilty;
    for (const SolidId solid : solids) {
        const auto faces = b.solid_faces(solid);
        if (std::any_of(faces.begin(), faces.end(), names)) {
            guilty.push_back(solid);
        }
    }
    return {error.code(),
            solid_list(b, guilty.empty() ? solids : std::span<const SolidId>(guilty)) + ": " + message_of(error),
            error.ids()};
}

}  // namespace pavior::detail
