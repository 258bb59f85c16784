#pragma once

#ifndef PAVIOR_COMPILED
#include <pavior/core/two-inl.hpp>
#endif
