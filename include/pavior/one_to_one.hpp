#pragma once
/// \file
/// One-to-one sweeps of the solids of a CAD model.

#include <pavior/one_to_one/intervals.hpp>       // how many mesh edges each edge gets
#include <pavior/one_to_one/recognition.hpp>     // which solids are sweeps, and between which faces
#include <pavior/one_to_one/sweep_model.hpp>     // one conforming mesh of all solids of a model
#include <pavior/one_to_one/sweep_solid.hpp>     // one solid whose cap and sides are meshed
#include <pavior/one_to_one/sweep_topology.hpp>  // caps, linking sides and their logical sides
