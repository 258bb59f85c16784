#pragma once
/// \file
/// Surfaces and tetrahedra with the tags of the CAD or the user: what readers, triangulators and tetrahedralizers
/// hand on.

#include <pavior/mesh/span_mesh.hpp>

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace pavior {

/// A mesh edge that lies on a curve of the geometry.
struct TaggedEdge {
    std::array<Index, 2> nodes{};
    std::int32_t tag = 0;

    friend bool operator==(const TaggedEdge&, const TaggedEdge&) = default;
};

/// A triangle that lies on a face of the geometry, or on an inner facet.
struct TaggedTriangle {
    TriCorners nodes{};
    std::int32_t tag = 0;

    friend bool operator==(const TaggedTriangle&, const TaggedTriangle&) = default;
};

/// A mesh node that is a vertex of the geometry.
struct TaggedNode {
    Index node = 0;
    std::int32_t tag = 0;

    friend bool operator==(const TaggedNode&, const TaggedNode&) = default;
};

/// A triangulated surface. Triangles of the boundary of the solid are counter-clockwise seen from outside.
struct TaggedSurface {
    TriMesh mesh;
    std::vector<std::int32_t> face_tags;             ///< a tag a triangle, or empty: no tags
    std::vector<TaggedEdge> edges;                   ///< edges on tagged curves; empty if curves are not known
    std::vector<TaggedNode> vertices;                ///< nodes that are vertices of the geometry; empty if not known
    std::map<std::int32_t, std::string> face_names;  ///< names of those face tags that have one
};

/// Tetrahedra, all positive, and what of them lies on the geometry.
struct TaggedTetMesh {
    TetMesh mesh;
    std::vector<TaggedTriangle> triangles;  ///< boundary (counter-clockwise seen from outside) and inner facets
    std::vector<TaggedEdge> edges;
    std::vector<TaggedNode> vertices;
};

}  // namespace pavior
