#include "blocked.hpp"

#include <pavior/cad/gmsh_brep.hpp>
#include <pavior/cad/triangulation.hpp>
#include <pavior/core/error.hpp>
#include <pavior/core/stopwatch.hpp>
#include <pavior/dual/features.hpp>
#include <pavior/io/surface_file.hpp>
#include <pavior/io/tet_mesh_file.hpp>
#include <pavior/tetra/tetrahedralize.hpp>

#include <algorithm>
#include <utility>

namespace pavior::cli {

namespace {

double diagonal(const std::vector<Vec3>& nodes) {
    Vec3 low = nodes.front();
    Vec3 high = nodes.front();
    for (const Vec3& x : nodes) {
        low = low.cwiseMin(x);
        high = high.cwiseMax(x);
    }
    return (high - low).norm();
}

/// Fine hexahedra lie on the triangles: where they are small, these follow the curved faces more closely.
CadTriangulation triangulate_for(const BlockCommand& command) {
    CadTriangulation coarse = triangulate_solids(command.input);
    if (command.size > 0.0) {
        const double size = diagonal(coarse.surface.mesh.nodes);
        TriangulationOptions options;
        options.chord = std::max(0.05 * command.size, size / 2000.0);
        if (options.chord < size / 200.0) {
            return triangulate_solids(command.input, options);
        }
    }
    return coarse;
}

/// The triangles on some faces, with what lies on them.
TaggedSurface part_of(const TaggedSurface& surface, std::vector<int> faces) {
    std::sort(faces.begin(), faces.end());
    TaggedSurface part;
    std::vector<Index> number(surface.mesh.nodes.size(), no_index);
    for (std::size_t t = 0; t < surface.mesh.triangles.size(); ++t) {
        if (!std::binary_search(faces.begin(), faces.end(), surface.face_tags[t])) {
            continue;
        }
        auto corners = surface.mesh.triangles[t];
        for (Index& corner : corners) {
            if (number[corner] == no_index) {
                number[corner] = static_cast<Index>(part.mesh.nodes.size());
                part.mesh.nodes.push_back(surface.mesh.nodes[corner]);
            }
            corner = number[corner];
        }
        part.mesh.triangles.push_back(corners);
        part.face_tags.push_back(surface.face_tags[t]);
    }
    for (TaggedEdge edge : surface.edges) {
        if (number[edge.nodes[0]] != no_index && number[edge.nodes[1]] != no_index) {
            edge.nodes = {number[edge.nodes[0]], number[edge.nodes[1]]};
            part.edges.push_back(edge);
        }
    }
    for (TaggedNode vertex : surface.vertices) {
        if (number[vertex.node] != no_index) {
            vertex.node = number[vertex.node];
            part.vertices.push_back(vertex);
        }
    }
    return part;
}

/// The boundary triangles of tetrahedra as a surface.
TaggedSurface boundary_of(const TaggedTetMesh& tets) {
    TaggedSurface surface;
    surface.mesh.nodes = tets.mesh.nodes;
    for (const TaggedTriangle& triangle : tets.triangles) {
        surface.mesh.triangles.push_back(triangle.nodes);
        surface.face_tags.push_back(triangle.tag);
    }
    return surface;
}

}  // namespace

BlockInput read_block_input(const BlockCommand& command, const Progress& progress) {
    BlockInput input;
    Stopwatch watch;
    report(progress, "reading", 0.0);
    TaggedTetMesh tets;
    if (can_read_tet_mesh(command.input)) {
        tets = read_tet_mesh(command.input);
        input.surface = boundary_of(tets);
        input.read_seconds = watch.lap();
    } else {
        std::vector<TaggedTriangle> inner_facets;
        input.cad = can_read_cad(command.input);
        if (input.cad) {
            CadTriangulation model = triangulate_for(command);
            if (command.faces.empty()) {
                input.surface = std::move(model.surface);
                inner_facets = std::move(model.inner_facets);
            } else {
                input.surface = part_of(model.surface, command.faces);
            }
        } else if (can_read_surface(command.input)) {
            input.surface = read_surface(command.input);
        } else {
            throw FileError(
                command.input,
                "unknown input format; known are .stl .obj .off .ply, .step .stp .iges .igs .brep, .vtk .vtu "
                ".msh");
        }
        input.read_seconds = watch.lap();
        report(progress, "tetrahedra", 0.1);
        tets = tetrahedralize(input.surface, inner_facets);
    }
    FeatureOptions features;
    if (!command.feature_angles.empty()) {
        features.end_below = command.feature_angles[0];
        features.corner_above = command.feature_angles[1];
        features.reversal_above = command.feature_angles[2];
    }
    input.reference = make_reference_mesh(tets, features);
    input.tetra_seconds = watch.lap();
    return input;
}

}  // namespace pavior::cli
