#pragma once
#include <pavior/core/owner-inl.hpp>
