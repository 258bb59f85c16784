#pragma once
/// \file
/// Tetrahedra of the solids of a CAD model that know the faces, edges and vertices of the model; and how long they are.

#include <pavior/brep/brep.hpp>
#include <pavior/math/point.hpp>
#include <pavior/mesh/tagged_mesh.hpp>

#include <map>
#include <stop_token>
#include <vector>

namespace pavior {

/// A length near a point.
struct TetSizeAt {
    Vec3 point = Vec3::Zero();
    double size = 0;
};

/// How long the edges of tetrahedra are to be, in the unit of the model.
struct TetSizes {
    double size = 0;   ///< largest length, roughly; above 0
    double least = 0;  ///< curved edges and faces ask for no length below this; above 0
    int per_turn = 6;  ///< edges along one full turn of a curved edge or face, at least 3
    int variant = 0;   ///< from 0 on; another number asks for another mesh, where the mesher knows several ways
    /// Other largest lengths; of several that apply to an edge its own, then the least of its faces, of its solids.
    std::map<EdgeId, double> edge = {};
    std::map<FaceId, double> face = {};
    std::map<SolidId, double> solid = {};
    /// Lengths are also no greater than that at a point and \c growth times the distance from it.
    std::vector<TetSizeAt> near = {};
    double growth = 0.4;
    double seconds = 0;         ///< limit; 0: none
    std::stop_token stop = {};  ///< ends the call by Stopped
};

/// Tetrahedra of some solids, which share the nodes of the faces between them. Tags are ids of the model: those of
/// triangles FaceId::value, of edges EdgeId::value, of vertices VertexId::value.
///
/// Every face of the solids is tiled by triangles, those between two solids once, seen from outside of the one whose
/// tetrahedra come first. Every edge between different faces is a chain of mesh edges; seams, where one face meets
/// itself, need not be. Vertices are nodes.
struct SolidsTets {
    TaggedTetMesh tets;
    std::vector<SolidId> tet_solid;  ///< one a tetrahedron
};

}  // namespace pavior
