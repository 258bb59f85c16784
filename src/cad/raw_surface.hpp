#pragma once
// Triangles on the faces of the current Gmsh model, whoever made them, and how they become a surface. Internal to the
// cad component.

#include <pavior/cad/triangulation.hpp>
#include <pavior/math/point.hpp>

#include <cstddef>
#include <map>
#include <set>
#include <span>
#include <string>
#include <vector>

namespace pavior::detail {

/// Nodes have names of any kind; entities have Gmsh's tags.
struct RawSurface {
    std::map<std::size_t, Vec3> nodes;
    std::map<int, std::vector<std::size_t>> faces;   ///< corners of the triangles, three each
    std::map<int, std::vector<std::size_t>> curves;  ///< ends of the edges, two each
    std::map<int, std::size_t> vertices;
    double chord = 0;  ///< largest distance of edge middles and triangle centres from their faces
};

/// Tags of what bounds an entity of the current model, seams twice.
std::vector<int> boundary_of(int dimension, int tag);

/// Tags of the entities of that dimension.
std::vector<int> entities_of(int dimension);

/// The surface of \p solids of the current model, whose faces \p raw holds: numbered, oriented, curves and vertices
/// that part different faces, volume. \throws Error cad_failure naming faces that do not close
CadTriangulation surface_of(const RawSurface& raw, std::span<const int> solids);

/// Throws Error cad_failure that names the faces.
[[noreturn]] void fail_at(const std::string& message, const std::set<int>& faces = {});

}  // namespace pavior::detail
