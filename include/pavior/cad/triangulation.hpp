#pragma once
/// \file
/// CAD files as triangle surfaces whose triangles, edges and nodes know the faces, curves and vertices they lie on.

#include <pavior/cad/imprint_report.hpp>
#include <pavior/mesh/tagged_mesh.hpp>

#include <filesystem>
#include <vector>

namespace pavior {

/// How triangulate() works. Lengths are those of the model.
struct TriangulationOptions {
    /// Largest length of an edge, roughly; 0 (default): as coarse as the two limits below admit.
    double size = 0.0;
    /// Largest distance of an edge's middle and of a triangle's centre from its face; 0 (default): 1/200 of the
    /// diagonal of the box round the model.
    double chord = 0.0;
    /// Edges along one full turn of a curved curve or face, at least.
    int per_turn = 16;
    /// The file is read and meshed in a child process first, so that a crash or an endless loop of the CAD kernel
    /// becomes an error; the child may take this many seconds. 0: do it directly.
    double trial_seconds = 300.0;
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

/// Triangulates the solids of a .step, .stp, .iges, .igs or .brep file with Gmsh's surface mesher: plane faces with the
/// nodes of their curves alone (unless size says otherwise), curved ones finely enough for the chord. Touching solids
/// are made to share their faces. Closed shells without gaps; triangles counter-clockwise seen from outside the solid.
/// Coarse triangles of a thin curved wall may cross each other: check_surface() tells, a smaller chord helps.
/// NOT thread-safe (see GmshBrep). Deterministic.
/// \throws FileError for what cannot be read; Error(cad_failure) naming the faces that could not be meshed, or if the
///         chord is not reached; InputError(bad_option)
[[nodiscard]] CadTriangulation triangulate_solids(const std::filesystem::path& file,
                                                  const TriangulationOptions& options = {});

class GmshBrep;

/// The same for a model in memory, in this process; option trial_seconds is not heeded. Tags are those of the model.
/// \throws Error(cad_failure), InputError(bad_option)
[[nodiscard]] CadTriangulation triangulate_solids(const GmshBrep& model, const TriangulationOptions& options = {});

/// The same for solids that do not touch. \throws Error(cad_failure) if two solids share a face.
[[nodiscard]] TaggedSurface triangulate(const std::filesystem::path& file, const TriangulationOptions& options = {});

}  // namespace pavior
