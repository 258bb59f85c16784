#pragma once
/// \file
/// All numbers by which users know an entity: where solids were cut by each other, one may have several.

#include <pavior/brep/brep.hpp>

#include <algorithm>
#include <cstddef>
#include <map>
#include <optional>
#include <vector>

namespace pavior {

/// b.all_tags(dimension, index) where the model has such a call, else b.tag(dimension, index) alone.
template <brep B>
[[nodiscard]] std::vector<int> all_tags(const B& b, int dimension, std::size_t index) {
    if constexpr (requires { std::vector<int>(b.all_tags(dimension, index)); }) {
        return b.all_tags(dimension, index);
    } else {
        return {b.tag(dimension, index)};
    }
}

/// Whether \p tag is one of them.
template <brep B>
[[nodiscard]] bool has_tag(const B& b, int dimension, std::size_t index, int tag) {
    const std::vector<int> tags = all_tags(b, dimension, index);
    return std::find(tags.begin(), tags.end(), tag) != tags.end();
}

/// The smallest of the \p sizes that are given for any of them.
template <brep B>
[[nodiscard]] std::optional<double> size_by_tag(const B& b, int dimension, std::size_t index,
                                                const std::map<int, double>& sizes) {
    std::optional<double> smallest;
    for (const int tag : sizes.empty() ? std::vector<int>{} : all_tags(b, dimension, index)) {
        if (const auto own = sizes.find(tag); own != sizes.end()) {
            smallest = std::min(smallest.value_or(own->second), own->second);
        }
    }
    return smallest;
}

}  // namespace pavior
