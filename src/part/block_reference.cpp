#include <pavior/part/block_reference.hpp>

#include "gmsh_kernels.hpp"

#include <pavior/cad/gmsh_brep.hpp>
#include <pavior/cad/triangulation.hpp>
#include <pavior/core/error.hpp>
#include <pavior/core/stopwatch.hpp>
#include <pavior/dual/features.hpp>
#include <pavior/io/surface_file.hpp>
#include <pavior/io/tet_mesh_file.hpp>
#include <pavior/math/box.hpp>
#include <pavior/mesh/verify_tets.hpp>
#include <pavior/part/local_lengths.hpp>
#include <pavior/tetra/tetrahedralize.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

namespace pavior {

namespace {

/// Fine hexahedra lie on the triangles: where they are small, these follow the curved faces more closely.
template <class Cad>
CadTriangulation triangulate_for(const Cad& cad, double wanted, TriangulationOptions options = {}) {
    CadTriangulation coarse = triangulate_solids(cad, options);
    if (wanted > 0.0) {
        const double size = box_round(std::span<const Vec3>(coarse.surface.mesh.nodes)).extent().norm();
        options.chord = std::max(0.05 * wanted, size / 2000.0);
        if (options.chord < size / 200.0) {
            return triangulate_solids(cad, options);
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

/// No more hexahedra than asked for are to be expected in \p surface.
void check_expected(const TaggedSurface& surface, const ReferenceOptions& options) {
    if (options.size > 0) {
        double volume = 0;
        for (const TriCorners& c : surface.mesh.triangles) {
            const auto& x = surface.mesh.nodes;
            volume += x[c[0]].cross(x[c[1]]).dot(x[c[2]]) / 6;
        }
        require_expected_at_most(std::abs(volume) / std::pow(options.size, 3), options.max_hexahedra, options.size);
    }
}

}  // namespace

BlockReference detail::GmshReferenceMesher::operator()(SolidId solid, double size,
                                                       const FeatureOptions& features) const {
    BlockReference result;
    Stopwatch watch;
    std::vector<int> faces;
    std::map<std::int32_t, std::int32_t> file_tag;
    for (const OrientedFace& f : model->solid_faces(solid)) {
        faces.push_back(model->gmsh_tag(2, f.face.index()));
        file_tag[faces.back()] = model->tag(2, f.face.index());
    }
    result.cad = true;
    const CadTriangulation made = triangulate_for(*model, size);
    result.surface = part_of(made.surface, std::move(faces));
    for (std::int32_t& tag : result.surface.face_tags) {
        tag = file_tag.at(tag);
    }
    result.chord = made.chord;
    result.volume = model->solid_volume(solid);
    result.read_seconds = watch.lap();
    result.mesh = make_reference_mesh(tetrahedralize(result.surface), features);
    result.tetra_seconds = watch.lap();
    return result;
}

BlockReference read_block_reference(const std::filesystem::path& file, const ReferenceOptions& options) {
    BlockReference result;
    const std::string name = file.string();
    Stopwatch watch;
    report(options.progress, "reading", 0.0);
    TaggedTetMesh tets;
    if (can_read_tet_mesh(name)) {
        tets = read_tet_mesh(name);
        if (const TetReport check = verify_tets(tets.mesh); !check.ok()) {  // folded over: faces with both on one side
            throw FileError(name, check.text());
        }
        result.surface = boundary_of(tets);
        result.read_seconds = watch.lap();
    } else {
        std::vector<TaggedTriangle> inner_facets;
        result.cad = can_read_cad(file);
        if (result.cad) {
            TriangulationOptions own;
            own.trial_seconds = options.seconds > 0 ? options.seconds : own.trial_seconds;
            own.stop = options.stop;
            CadTriangulation model = triangulate_for(file, options.size, own);
            result.surface = std::move(model.surface);
            result.chord = model.chord;
            result.volume = model.volume;
            result.warnings = warnings_of(model.imprint);
            inner_facets = std::move(model.inner_facets);
        } else if (can_read_surface(name)) {
            result.surface = read_surface(name);
        } else {
            throw FileError(
                name,
                "unknown input format; known are .stl .obj .off .ply, .step .stp .iges .igs .brep, .vtk .vtu "
                ".msh");
        }
        result.read_seconds = watch.lap();
        check_expected(result.surface, options);
        report(options.progress, "tetrahedra", 0.1);
        TetOptions own;
        own.time_limit = options.seconds > 0 ? options.seconds : own.time_limit;
        own.stop = options.stop;
        tets = tetrahedralize(result.surface, inner_facets, own);
    }
    result.mesh = make_reference_mesh(tets, options.features);
    result.tetra_seconds = watch.lap();
    return result;
}

}  // namespace pavior
