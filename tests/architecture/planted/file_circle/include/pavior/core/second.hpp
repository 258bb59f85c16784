#pragma once
#include <pavior/core/third.hpp>
