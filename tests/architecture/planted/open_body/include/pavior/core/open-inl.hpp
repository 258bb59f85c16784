#pragma once
#include <pavior/core/open.hpp>
