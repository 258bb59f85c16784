#pragma once
/// \file
/// Solids cut into pieces that the methods take.

#include <pavior/decompose/best_cuts.hpp>       // the search for cuts after which all pieces are meshed
#include <pavior/decompose/cut_candidates.hpp>  // where a solid might be cut
#include <pavior/decompose/solid_cut.hpp>       // cuts as data
