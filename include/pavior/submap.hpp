#pragma once
/// \file
/// Structured meshes of solids that are logical unions of boxes.

#include <pavior/submap/submap_model.hpp>        // one conforming mesh of the solids of a model
#include <pavior/submap/submap_recognition.hpp>  // which solids are unions of boxes
#include <pavior/submap/submap_solid.hpp>        // one solid between the meshes of its faces
