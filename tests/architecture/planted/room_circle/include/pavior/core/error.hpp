#pragma once
#include <pavior/math/point.hpp>
