#pragma once
/// \file
/// The switch between a compiled library and headers alone.
///
/// Without PAVIOR_COMPILED every header of pavior::pavior ends by including its `-inl.hpp`, where the functions that
/// are no templates have their bodies: headers are all there is. With it they only declare, and the bodies come from
/// the library pavior::compiled, which defines it for those who link. All units of a program must agree.

/// Precedes functions whose bodies stand in a `-inl.hpp`.
#ifdef PAVIOR_COMPILED
#define PAVIOR_INLINE
#else
#define PAVIOR_INLINE inline
#endif
