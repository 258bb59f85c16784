#pragma once
#include <pavior/core/one.hpp>
#include <pavior/core/two.hpp>
