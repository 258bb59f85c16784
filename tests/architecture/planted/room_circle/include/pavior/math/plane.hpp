#pragma once
#include <pavior/core/index.hpp>
