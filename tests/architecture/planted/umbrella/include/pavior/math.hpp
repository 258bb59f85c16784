#pragma once
#include <pavior/core/error.hpp>
#include <pavior/math/point.hpp>
