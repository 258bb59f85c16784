#pragma once
#include <pavior/core/second.hpp>
