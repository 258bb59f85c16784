#pragma once

#ifndef PAVIOR_COMPILED
#include <pavior/core/owner-inl.hpp>
#endif
