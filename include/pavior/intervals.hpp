#pragma once
/// \file
/// Numbers of intervals on edges, tied together by rules.

#include <pavior/intervals/integer_program.hpp>  // integer programs as plain data, and what solves them
#include <pavior/intervals/interval_system.hpp>  // wishes and rules
#include <pavior/intervals/solve_intervals.hpp>  // the best numbers, or the rules that contradict each other
