#pragma once
/// \file
/// Surface files: triangles with tags, read from what CAD programs, scanners and mesh tools write.

#include <pavior/mesh/tagged_mesh.hpp>

#include <string>
#include <string_view>

namespace pavior {

/// How read_surface() works.
struct SurfaceReadOptions {
    /// Nodes not farther apart than this become one, in the units of the file. 0 (default): nodes in exactly the same
    /// place; negative: none, every corner of an STL file is a node of its own.
    double weld_distance = 0.0;
};

/// True if read_surface() knows the extension of \p file: .stl .obj .off .ply (any case).
[[nodiscard]] bool can_read_surface(std::string_view file);

/// Reads a triangle surface; the format follows the extension:
///   .stl  ASCII (coordinates with all their digits) or binary; if there are several solids, solid k has face tag k,
///         from 1
///   .obj  v and f with their variants; if there are groups (g, or else o), the k-th one named has face tag k, from 1
///   .off  also COFF, NOFF and the like
///   .ply  ASCII, binary of both byte orders
/// Polygons are cut into triangles (by ears, in the plane that fits them). Nodes are welded; triangles that lose a
/// corner by that, and nodes of no triangle, are dropped; the rest keeps the order of the file. Nothing else is mended:
/// see check_surface(). Without groups there are no face tags; solids and groups with a name give it to their tag.
/// O(n log n).
/// \throws FileError naming the line, vertex or face that cannot be read (also as ids()); InputError (bad_option) for a
///         weld distance that is not a number
[[nodiscard]] TaggedSurface read_surface(const std::string& file, const SurfaceReadOptions& options = {});

}  // namespace pavior
