#include <pavior/part/block_reference.hpp>

#include "gmsh_kernels.hpp"

#include <pavior/cad/gmsh_brep.hpp>
#include <pavior/cad/triangulation.hpp>
#include <pavior/core/error.hpp>
#include <pavior/core/stopwatch.hpp>
#include <pavior/dual/features.hpp>
#include <pavior/io/surface_file.hpp>
#include <pavior/io/tet_mesh_file.hpp>
#include <pavior/mesh/verify_tets.hpp>
#include <pavior/part/local_lengths.hpp>
#include <pavior/tetra/tetrahedralize.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace pavior {

namespace {

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
    result.cad = true;
    TriangulationOptions own;
    own.element_size = size;
    own.longest = longest;
    own.per_turn = per_turn;
    CadTriangulation made = triangulate_solid(*model, solid, own);
    result.surface = std::move(made.surface);
    std::map<std::int32_t, std::int32_t> file_tag;
    for (const OrientedFace& f : model->solid_faces(solid)) {
        file_tag[model->gmsh_tag(2, f.face.index())] = model->tag(2, f.face.index());
    }
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
            own.element_size = std::max(options.size, 0.0);
            CadTriangulation model = triangulate_solids(file, own);
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
