#pragma once
/// \file
/// Points, cells and surfaces as formulas.

#include <pavior/math/affine_map.hpp>          // affine maps, centred
#include <pavior/math/any_surface.hpp>         // any parametric surface behind one type
#include <pavior/math/graph_laplacian.hpp>     // harmonic functions on weighted graphs
#include <pavior/math/hexahedron.hpp>          // Jacobians, volume and quality of one hexahedron
#include <pavior/math/parametric_surface.hpp>  // the concept of a parametric surface
#include <pavior/math/point.hpp>               // the concept of a point
#include <pavior/math/quadrilateral.hpp>       // normals, area and quality of one quadrilateral
#include <pavior/math/small_svd.hpp>           // singular values and rank of small matrices
