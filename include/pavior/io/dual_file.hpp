#pragma once
/// \file
/// Dual surfaces and regions as files, to look at.

#include <pavior/contributions/dual_surfaces.hpp>

#include <string>

namespace pavior {

/// Writes \p surfaces (polygons) and \p regions (tetrahedra, wedges and hexahedra: the pieces of the regions) to one
/// VTK file, .vtu (XML, appended binary) or .vtk (legacy, binary). Either may be empty. Points of the surfaces come
/// first, then those of the regions; so do cells. Cell arrays:
///   part       0 contribution, 1 piece of a region
///   colour     contributions: DualColour 0 .. 4 (red, orange, cyan, yellow, blue); pieces: -1
///   region     pieces: their region; contributions: -1
///   dimension  pieces: 0 vertex, 1 chain, 2 patch, 3 cell; contributions: -1
///   rgb        three bytes: the colour of section 5.7 \cite roca2009, one for each region
/// The file appears whole or not at all.
/// \throws FileError (extension, directory missing or not writable, disk full)
void write_dual(const std::string& file, const DualSurfaces& surfaces, const RegionPolyhedra& regions);

}  // namespace pavior
