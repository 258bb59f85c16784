#pragma once
#include "other.hpp"
