#pragma once
// The topology of a Gmsh model in flat arrays. Internal to the cad component.

#include "face_loops.hpp"
#include "gmsh_model.hpp"

#include <pavior/brep/brep.hpp>

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace pavior::detail {

/// One use of an edge by a face.
struct EdgeUse {
    EdgeId edge;
    bool forward = true;   ///< the loop runs along the edge
    int side = 0;          ///< which of the two curves of a seam, as Gmsh counts
    bool seam = false;     ///< the face uses the edge twice
    std::vector<Vec2> uv;  ///< samples at equal steps of the edge's parameter, continuous
};

/// A piece of a loop of a face: one of its curves, and the use that it is; no_position for a degenerate curve.
struct LoopPiece {
    std::size_t curve = 0;
    bool forward = true;
    std::size_t use = 0;
};

struct EdgeData {
    int tag = 0;
    std::array<VertexId, 2> vertices;
    std::array<double, 2> range{};
    double length = 0;
};

struct FaceData {
    int tag = 0;
    std::array<Vec2, 2> bounds;
    std::array<double, 2> period{};
    std::array<bool, 2> closed{};  ///< the box spans exactly one period
    std::string kind;
    std::string name;
    double area = 0;
    std::vector<EdgeLoop> loops;
    std::vector<EdgeUse> uses;
    std::vector<BoundaryCurve> curves;           ///< with the degenerate ones
    std::vector<std::vector<LoopPiece>> chains;  ///< the loops as pieces, with the degenerate ones
    Vec2 interior = Vec2::Zero();
};

struct SolidData {
    int tag = 0;
    std::string name;
    double volume = 0;
    std::vector<OrientedFace> faces;
};

struct Topology {
    std::vector<int> vertex_tags;
    std::vector<Vec3> vertices;
    std::vector<EdgeData> edges;
    std::vector<FaceData> faces;
    std::vector<SolidData> solids;
    double diagonal = 0;
    /// Of solids that were intersected: the tags in the file, by dimension and index. Else empty: the tags above.
    std::array<std::vector<std::vector<int>>, 4> file_tags;
};

/// Reads everything that bounds a solid of \p model. Error(cad_failure) or (non_manifold) names what does not fit.
Topology read_topology(const GmshModel& model);

/// \p uv brought into the box of a closed face by whole periods.
Vec2 wrapped(const FaceData& face, Vec2 uv);

/// \p uv moved by whole periods as near to \p reference as can be.
Vec2 shifted_to(const FaceData& face, Vec2 uv, const Vec2& reference);

/// Parameters next to \p x: Gmsh's projection, checked, else Newton's method from the best of a grid.
Vec2 closest_parameters(const GmshModel& model, const FaceData& face, const Vec3& x);

/// Parameters on the face of points of an edge, checked against the points in space, next to `use.uv`.
void use_parameters(const GmshModel& model, const EdgeData& edge, const FaceData& face, const EdgeUse& use,
                    std::span<const double> t, std::span<Vec2> uv, double diagonal);

/// Gives each face of \p solid its sense. Error if no consistent one exists.
void orient_solid(const GmshModel& model, const Topology& topology, SolidData& solid);

}  // namespace pavior::detail
