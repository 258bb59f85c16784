#pragma once
#include <pavior/core/first.hpp>
