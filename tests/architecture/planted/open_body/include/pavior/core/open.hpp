#pragma once
#include <pavior/core/open-inl.hpp>
