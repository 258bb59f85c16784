#pragma once
/// \file
/// Layer faces: where the sheets of the dual run.

#include <pavior/marking/judge_marking.hpp>   // what a marking is worth
#include <pavior/marking/mark_published.hpp>  // Algorithm 5.12: faces that the mesh happens to have
#include <pavior/marking/mark_sheets.hpp>     // implicit sheets that cut the mesh
#include <pavior/marking/marking.hpp>         // options, sheets, outcome
