#pragma once
/// \file
/// Which methods are tried on solids that hang together, and which mesh is taken. There is no other place that decides.

#include <pavior/core/compiled.hpp>
#include <pavior/part/part_mesh.hpp>
#include <pavior/part/part_options.hpp>

#include <functional>
#include <vector>

namespace pavior {

/// Makes one try: \p seconds is its share of the time left, 0 without a limit.
using PartAttempt = std::function<MethodTry(PartMethod method, double seconds)>;

/// Tries the methods of \p options in turn until one gives a valid mesh with a least scaled Jacobian of
/// PartOptions::sufficient. Taken is the mesh with the greatest, a valid one before an invalid one, an earlier one
/// among equals. mixed is left out for a single solid unless it is the only method named. A third of the time is kept
/// for the last resort, whose mesh comes in the place of a valid one only if it is sufficient, or the other below a
/// quarter of that.
[[nodiscard]] PAVIOR_INLINE PartDecision decide(std::vector<SolidId> solids, const PartOptions& options,
                                                const PartAttempt& attempt);

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/part/decide-inl.hpp>
#endif
