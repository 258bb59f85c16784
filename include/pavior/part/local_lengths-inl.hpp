#pragma once

#include <pavior/brep/all_tags.hpp>
#include <pavior/core/error.hpp>
#include <pavior/part/local_lengths.hpp>
#include <pavior/part/model_extras.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace pavior {

namespace detail {

[[noreturn]] inline void refuse_length(const std::string& text) { throw InputError(ErrorCode::bad_option, text); }

inline void append_tags(const AnyModel& b, int dimension, std::size_t index, std::vector<int>& tags) {
    for (const int tag : all_tags(b, dimension, index)) {
        tags.push_back(tag);
    }
}

}  // namespace detail

PAVIOR_INLINE void require_tags(const std::map<int, double>& lengths, std::vector<int> known, std::string_view kind) {
    std::sort(known.begin(), known.end());
    for (const auto& [tag, length] : lengths) {
        if (!std::binary_search(known.begin(), known.end(), tag)) {
            detail::refuse_length("a local size for " + std::string(kind) + " " + std::to_string(tag) +
                                  ", which the model does not have" +
                                  (known.empty() ? ""
                                                 : ": its tags go from " + std::to_string(known.front()) + " to " +
                                                       std::to_string(known.back())));
        }
    }
}

PAVIOR_INLINE LocalLengths lengths_by_tag(const AnyModel& b, const LocalLengths& lengths) {
    LocalLengths result = lengths;
    result.named.clear();
    const auto check = [](const auto& sizes) {
        for (const auto& [key, size] : sizes) {
            if (!(size > 0) || !std::isfinite(size)) {
                detail::refuse_length("local sizes must be positive numbers");
            }
        }
    };
    check(lengths.edge);
    check(lengths.face);
    check(lengths.solid);
    check(lengths.named);
    std::vector<int> edges;
    for (std::size_t e = 0; e < b.edge_count(); ++e) {
        detail::append_tags(b, 1, e, edges);
    }
    std::vector<int> faces;
    std::map<std::string, std::vector<int>> faces_called, solids_called;
    for (std::size_t f = 0; f < b.face_count(); ++f) {
        detail::append_tags(b, 2, f, faces);
        faces_called[name_of(b, FaceId{static_cast<std::int32_t>(f)})].push_back(b.tag(2, f));
    }
    std::vector<int> solids;
    for (const SolidId s : all_solids(b)) {
        detail::append_tags(b, 3, s.index(), solids);
        solids_called[name_of(b, s)].push_back(b.tag(3, s.index()));
    }
    require_tags(lengths.edge, std::move(edges), "edge");
    require_tags(lengths.face, std::move(faces), "face");
    require_tags(lengths.solid, std::move(solids), "solid");
    for (const auto& [name, size] : lengths.named) {
        if (name.empty() || (!faces_called.contains(name) && !solids_called.contains(name))) {
            detail::refuse_length("no face and no solid is called '" + name + "'");
        }
        for (const int tag : faces_called[name]) {
            result.face.emplace(tag, size);
        }
        for (const int tag : solids_called[name]) {
            result.solid.emplace(tag, size);
        }
    }
    return result;
}

PAVIOR_INLINE double expected_hexahedra(const AnyModel& b, std::span<const SolidId> solids, double size,
                                        const std::map<int, double>& solid_size) {
    double sum = 0;
    for (const SolidId s : solids) {
        const double length = size_by_tag(b, 3, s.index(), solid_size).value_or(size);
        sum += volume_of(b, s).value_or(0) / (length * length * length);
    }
    return sum;
}

PAVIOR_INLINE void require_expected_at_most(double expected, double most, double size) {
    if (most <= 0 || !(expected > most)) {
        return;
    }
    const double fits = size * std::cbrt(expected / most);
    const double step = std::pow(10.0, std::floor(std::log10(fits)) - 1);
    std::ostringstream text;
    text.precision(2);
    text << "about " << expected << " hexahedra are expected, more than the limit of " << most << "; size "
         << std::ceil(fits / step) * step << " instead of " << size << " would fit";
    detail::refuse_length(text.str());
}

}  // namespace pavior
