#pragma once

#include <pavior/one_to_one/recognition.hpp>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace pavior {

namespace detail {

PAVIOR_INLINE void add_closest_refusals(const SolidBoundary& solid, std::size_t count,
                                        std::vector<SweepRefusal>& refusals) {
    if (solid.faces.size() < 3) {
        refusals.push_back(too_few_faces(solid));
        return;
    }
    for (const auto& [source, target] : closest_pairs(solid, count)) {
        const auto known = [&, s = solid.faces[source].face.face, t = solid.faces[target].face.face](const auto& r) {
            return (r.source == s && r.target == t) || (r.source == t && r.target == s);
        };
        if (refusals.size() < count && std::none_of(refusals.begin(), refusals.end(), known)) {
            refusals.push_back(explain_refusal(solid, source, target));
        }
    }
}

}  // namespace detail

}  // namespace pavior
