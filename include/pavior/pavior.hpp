#pragma once
/// \file
/// All rooms of pavior::pavior by their doors. One room alone compiles faster.

#include <pavior/affine.hpp>
#include <pavior/block.hpp>
#include <pavior/brep.hpp>
#include <pavior/contributions.hpp>
#include <pavior/core.hpp>
#include <pavior/decompose.hpp>
#include <pavior/dual.hpp>
#include <pavior/intervals.hpp>
#include <pavior/lattice.hpp>
#include <pavior/many_to_many.hpp>
#include <pavior/marking.hpp>
#include <pavior/math.hpp>
#include <pavior/mesh.hpp>
#include <pavior/one_to_one.hpp>
#include <pavior/part.hpp>
#include <pavior/smooth.hpp>
#include <pavior/submap.hpp>
#include <pavior/sweep.hpp>
