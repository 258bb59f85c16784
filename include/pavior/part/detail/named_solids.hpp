#pragma once
/// \file
/// Errors that name the solids concerned.

#include <pavior/core/compiled.hpp>
#include <pavior/core/error.hpp>
#include <pavior/part/any_model.hpp>

#include <span>
#include <string>

namespace pavior::detail {

/// "solid 3" or "solids 3 and 5".
[[nodiscard]] PAVIOR_INLINE std::string solid_list(const AnyModel& b, std::span<const SolidId> solids);

/// \p error without its code, as it is found in the middle of a sentence.
[[nodiscard]] PAVIOR_INLINE std::string message_of(const Error& error);

/// "solids 3 and 5: ...", with the code and the ids of \p error: those of \p solids with a face that it names (by tag),
/// all of them if there is none.
[[nodiscard]] PAVIOR_INLINE UnmeshableError naming_solids(const AnyModel& b, std::span<const SolidId> solids,
                                                          const UnmeshableError& error);

}  // namespace pavior::detail

#ifndef PAVIOR_COMPILED
#include <pavior/part/detail/named_solids-inl.hpp>
#endif
