#pragma once

#ifndef PAVIOR_COMPILED
#include <pavior/core/one-inl.hpp>
#endif
