#pragma once
#include <pavior/mesh/cells.hpp>
