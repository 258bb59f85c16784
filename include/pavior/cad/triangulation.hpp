#pragma once
/// \file
/// CAD files as triangle surfaces whose triangles, edges and nodes know the faces, curves and vertices they lie on.

#include <pavior/brep/brep.hpp>
#include <pavior/cad/imprint_report.hpp>
#include <pavior/mesh/tagged_mesh.hpp>

#include <filesystem>
#include <limits>
#include <stop_token>
#include <vector>

namespace pavior {

/// How triangulate() works. Lengths are those of the model.
struct TriangulationOptions {
    /// Largest length of an edge, roughly; 0 (default): as coarse as the two limits below admit.
    double size = 0.0;
    /// Largest distance of an edge's middle and of a triangle's centre from its face; 0 (default): 1/200 of the
    /// diagonal of the box round the model.
    double chord = 0.0;
    /// Size of elements that are to lie on the triangles: the chord becomes a twentieth of it where that is less, but
    /// no less than 1/2000 of the diagonal. 0 (default): none.
    double element_size = 0.0;
    /// Edges along one full turn of a curved curve or face, at least.
    int per_turn = 16;
    /// Edges of curved faces are at most so many times as long as their bends admit, or 1/100 of the diagonal; infinite
    /// (default): as long as the faces are straight. 1: triangles of even shape.
    double longest = std::numeric_limits<double>::infinity();
    /// The file is read and meshed in a child process that hands over the result, so that a crash or an endless loop of
    /// the CAD kernel becomes an error; the child may take this many seconds. 0: do it in this process.
    double trial_seconds = 300.0;
    std::stop_token stop = {};  ///< ends the child by Stopped
};

/// The surface of a CAD model.
struct CadTriangulation {
    /// The outer boundary of all solids together. Tags are Gmsh's tags of faces, curves and vertices (for a file with
    /// one solid they follow the order of the file). Seams, which part a closed face from itself, are no curves here,
    /// and so are no vertices that only they need.
    TaggedSurface surface;
    /// Faces between two solids, seen from the one that comes first.
    std::vector<TaggedTriangle> inner_facets;
    double chord = 0;       ///< largest distance of edge middles and triangle centres from their faces
    double volume = 0;      ///< of all solids together, as the model knows it
    ImprintReport imprint;  ///< of a file with several solids
};

/// Triangulates the solids of a .step, .stp, .iges, .igs or .brep file. Every curve gets as many nodes as chord and
/// per_turn ask of it, equally many on arcs of one angle whose radii differ little. Plane faces and those that bend
/// one way have the nodes of their curves alone: triangles as long as they are straight; faces that bend both ways get
/// inner nodes where the chord asks for them. Where a size is asked for, and for faces whose parameters are no good,
/// Gmsh's surface mesher makes small triangles everywhere on curved faces. Touching solids are made to share their
/// faces. Closed shells without gaps; triangles counter-clockwise seen from outside the solid. Coarse triangles of a
/// thin curved wall may cross each other: check_surface() tells, a smaller chord helps. NOT thread-safe (see
/// GmshBrep). Deterministic.
/// \throws FileError for what cannot be read; Error(cad_failure) naming the faces that could not be meshed, or if the
///         chord is not reached; InputError(bad_option)
[[nodiscard]] CadTriangulation triangulate_solids(const std::filesystem::path& file,
                                                  const TriangulationOptions& options = {});

class GmshBrep;

/// The same for a model in memory, in this process; option trial_seconds is not heeded. Tags are those of the model.
/// \throws Error(cad_failure), InputError(bad_option)
[[nodiscard]] CadTriangulation triangulate_solids(const GmshBrep& model, const TriangulationOptions& options = {});

/// The same for one solid of it; faces that others touch belong to its surface.
[[nodiscard]] CadTriangulation triangulate_solid(const GmshBrep& model, SolidId solid,
                                                 const TriangulationOptions& options = {});

/// The same for solids that do not touch. \throws Error(cad_failure) if two solids share a face.
[[nodiscard]] TaggedSurface triangulate(const std::filesystem::path& file, const TriangulationOptions& options = {});

}  // namespace pavior
