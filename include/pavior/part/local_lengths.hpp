#pragma once
/// \file
/// Other lengths of mesh edges than the general one, and how many hexahedra lengths make.

#include <pavior/core/compiled.hpp>
#include <pavior/part/any_model.hpp>
#include <pavior/part/part_options.hpp>

#include <map>
#include <span>
#include <string_view>
#include <vector>

namespace pavior {

/// \p lengths with those by name as lengths by tag; where an entity has both, the one by tag stays. O(entities).
/// \throws InputError bad_option for a tag or name that nothing in \p b bears, and for lengths that are not positive
[[nodiscard]] PAVIOR_INLINE LocalLengths lengths_by_tag(const AnyModel& b, const LocalLengths& lengths);

/// \throws InputError bad_option unless every tag of \p lengths is one of \p known; \p kind says of what: "edge"
PAVIOR_INLINE void require_tags(const std::map<int, double>& lengths, std::vector<int> known, std::string_view kind);

/// How many hexahedra of length \p size fill \p solids, by volume, each solid with its own length if it has one; 0 for
/// a model that does not know its volumes. An estimate: thin walls and small faces take more.
[[nodiscard]] PAVIOR_INLINE double expected_hexahedra(const AnyModel& b, std::span<const SolidId> solids, double size,
                                                      const std::map<int, double>& solid_size = {});

/// \throws InputError bad_option if more than \p most (0: any number) are \p expected, with the size that would fit
/// where \p size does not
PAVIOR_INLINE void require_expected_at_most(double expected, double most, double size);

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/part/local_lengths-inl.hpp>
#endif
