#pragma once
/// \file
/// Touching solids, each by the method that suits it.

#include <pavior/part/mixed_model.hpp>    // some swept, some submapped, beside meshes that are there
#include <pavior/part/mixed_solids.hpp>   // each solid by its own method, conforming
#include <pavior/part/solid_methods.hpp>  // which method meshes which solid
