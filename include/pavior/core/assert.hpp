#pragma once
/// \file
/// Assertions for our own bugs. Callers' mistakes throw (error.hpp), geometric outcomes are reported.

#include <cassert>

/// Checked in debug builds only; a failure is a defect of pavior.
#define PAVIOR_ASSERT(condition) assert(condition)
