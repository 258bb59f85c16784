#pragma once
/// \file
/// Affine maps between loops and point sets (chapters 2 and 3 \cite roca2009 ).

#include <pavior/affine/affinity.hpp>           // are two point sets affine images of each other?
#include <pavior/affine/fit.hpp>                // the affine map between two loops, by any of the methods
#include <pavior/affine/functionals.hpp>        // the functionals E, F, G and H of two point sets
#include <pavior/affine/method.hpp>             // the methods and their names
#include <pavior/affine/minimizers.hpp>         // minimum-norm minimisers of the functionals
#include <pavior/affine/offset_preserving.hpp>  // Algorithm 3.1: offsets kept
#include <pavior/affine/pseudo_area.hpp>        // pseudo-area and pseudo-normal of loops
#include <pavior/affine/theta.hpp>              // a linear map changed along one direction
