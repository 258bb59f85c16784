#pragma once
#include <pavior/core/owner.hpp>
