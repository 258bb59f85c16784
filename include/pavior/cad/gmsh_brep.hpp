#pragma once
/// \file
/// CAD files as a model of the brep concept: Gmsh's interface to OpenCASCADE, behind plain types.

#include <pavior/brep/brep.hpp>
#include <pavior/cad/imprint_report.hpp>
#include <pavior/core/error.hpp>
#include <pavior/math/point.hpp>

#include <array>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

namespace pavior {

namespace detail {
class GmshModel;
struct Topology;
}  // namespace detail

/// How a CAD model is read.
struct CadOptions {
    /// Intersect the solids with each other, so that touching solids share faces, edges and vertices. Overlapping
    /// solids are split; the common piece becomes a solid of its own that carries tag and name of the solid that it is
    /// all of, else those of the first. imprint_report() tells.
    bool imprint = true;
    /// Vertices, edges and faces of different solids that are closer than this are made one when they are intersected:
    /// gaps are closed, thin overlaps vanish. In the unit of the model; 0: what the file itself says.
    double imprint_tolerance = 0;
    /// A file is first read in a child process, so that a crash or an endless loop of the CAD kernel on a damaged file
    /// becomes an error; the child may take this many seconds. Solids that it imprinted come back as a file of
    /// OpenCASCADE's own in a temporary folder, with the same tags; coordinates are those to 15 digits. 0: read it
    /// directly.
    double trial_seconds = 300;
    std::stop_token stop = {};  ///< ends that first reading by Stopped
};

/// Whether the name of \p file ends as that of a CAD file: .step, .stp, .iges, .igs or .brep, in any case.
[[nodiscard]] bool can_read_cad(const std::filesystem::path& file);

/// The solids of a CAD model and the faces, edges and vertices that bound them. Models brep.
///
/// Units are those of Gmsh: STEP and IGES lengths in the unit of the file's geometry as OpenCASCADE converts it
/// (millimetres), since Geometry.OCCTargetUnit is left alone. Ids are dense, in the order of Gmsh's tags; tag() gives
/// those of the file before its solids were intersected. Entities that bound no solid are left out, and
/// so are degenerate edges (the pole of a sphere, the apex of a cone): at such a point a loop runs on with the next
/// edge, and the parameters jump.
///
/// Gmsh is one global machine. Sessions are counted, so that it is initialised by the first and finalised by the last
/// user in the process; each GmshBrep owns a Gmsh model of its own and leaves the current one as it was. NOT
/// thread-safe: no two calls, on whatever objects, may run at the same time. Results are deterministic.
///
/// Errors: FileError for what cannot be read, is no CAD file, is damaged or holds no solid; Error(cad_failure) with the
/// tag of the entity where the kernel fails; nothing of Gmsh's own passes through, nothing is printed.
class GmshBrep {
public:
    /// Reads .step, .stp, .iges, .igs or .brep (any case). Faces without a solid are sewn if that makes solids.
    [[nodiscard]] static GmshBrep load(const std::filesystem::path& file, const CadOptions& options = {});

    /// Reads the shapes that \p make_shapes puts into the current Gmsh model through gmsh::model::occ; entity names and
    /// physical groups that it sets are kept. With several solids it may be called twice, and must do the same again.
    [[nodiscard]] static GmshBrep build(const std::function<void()>& make_shapes, const CadOptions& options = {});

    GmshBrep(GmshBrep&&) noexcept;
    GmshBrep& operator=(GmshBrep&&) noexcept;
    ~GmshBrep();

    [[nodiscard]] std::size_t vertex_count() const;
    [[nodiscard]] std::size_t edge_count() const;
    [[nodiscard]] std::size_t face_count() const;
    [[nodiscard]] std::size_t solid_count() const;

    /// The faces of a solid in the order of their tags. `outward` follows from the loops (neighbouring faces run along
    /// a common edge in opposite senses) and from the sign of the enclosed volume. A face inside a solid, with the same
    /// solid on both sides, does not occur.
    [[nodiscard]] std::span<const OrientedFace> solid_faces(SolidId solid) const;
    /// The outer loop first, then the holes. A loop runs counter-clockwise round the face in (u, v), holes clockwise.
    [[nodiscard]] std::span<const EdgeLoop> face_loops(FaceId face) const;
    [[nodiscard]] std::array<VertexId, 2> edge_vertices(EdgeId edge) const;

    [[nodiscard]] Vec3 vertex_point(VertexId vertex) const;
    [[nodiscard]] std::array<double, 2> edge_range(EdgeId edge) const;
    [[nodiscard]] Vec3 edge_point(EdgeId edge, double t) const;
    [[nodiscard]] Vec3 edge_derivative(EdgeId edge, double t) const;
    [[nodiscard]] double edge_length(EdgeId edge) const;
    /// Parameters beyond the ends of a closed direction are brought back by its period.
    [[nodiscard]] Vec3 face_point(FaceId face, Vec2 uv) const;
    [[nodiscard]] std::pair<Vec3, Vec3> face_derivatives(FaceId face, Vec2 uv) const;
    /// On the whole surface inside the parameter box of the face, so possibly outside the loops.
    [[nodiscard]] Vec2 closest_on_face(FaceId face, const Vec3& x) const;
    /// Continuous in t also across the seam of a periodic face, and head to tail along a loop.
    /// InputError(bad_index) if \p edge does not bound \p face.
    [[nodiscard]] Vec2 edge_on_face(EdgeId edge, double t, FaceId face, bool forward) const;
    /// The period in u and v; also of a surface that is closed without being periodic (a spline).
    [[nodiscard]] std::array<double, 2> face_period(FaceId face) const;
    /// The tag in the file of entity \p index of dimension \p dim (0 vertex, 1 edge, 2 face, 3 solid): the number that
    /// Gmsh gives it when it reads the file. Pieces of a solid or a face that was cut share its tag; edges and vertices
    /// have one each, and what the file has not got has a number beyond those.
    [[nodiscard]] int tag(int dim, std::size_t index) const;
    /// tag(), and where entities of several solids have become one (or overlap) the tags of the others.
    [[nodiscard]] std::vector<int> all_tags(int dim, std::size_t index) const;
    /// The tag in gmsh_model().
    [[nodiscard]] int gmsh_tag(int dim, std::size_t index) const;
    /// What was found when the solids were intersected; empty for one solid, or without CadOptions::imprint.
    [[nodiscard]] const ImprintReport& imprint_report() const;

    /// The index of the first entity with this tag(), or nothing.
    [[nodiscard]] std::optional<std::size_t> find(int dim, int tag) const;
    /// The label in the file (the last part of a STEP path), else the name of its physical group, else empty. Labels
    /// that OpenCASCADE's writer makes up ("Open CASCADE STEP translator ...") count as none.
    [[nodiscard]] const std::string& solid_name(SolidId solid) const;
    [[nodiscard]] const std::string& face_name(FaceId face) const;

    /// The kind of surface as Gmsh names it: "Plane", "Cylinder", "Cone", "Sphere", "Torus", "BSpline", ...
    [[nodiscard]] const std::string& face_kind(FaceId face) const;
    /// The corners {lowest, highest} of the parameter box of the face.
    [[nodiscard]] std::array<Vec2, 2> face_bounds(FaceId face) const;
    /// Parameters of a point strictly inside the loops.
    [[nodiscard]] Vec2 face_interior(FaceId face) const;
    [[nodiscard]] double face_area(FaceId face) const;
    [[nodiscard]] double solid_volume(SolidId solid) const;
    /// Length of the diagonal of the box round the model.
    [[nodiscard]] double diagonal() const;

    /// Many evaluations in one call, about three times as fast as one by one. Both spans have the same length.
    void face_points(FaceId face, std::span<const Vec2> uv, std::span<Vec3> points) const;
    void edge_points(EdgeId edge, std::span<const double> t, std::span<Vec3> points) const;
    void edge_on_face(EdgeId edge, std::span<const double> t, FaceId face, bool forward, std::span<Vec2> uv) const;

    /// The Gmsh model, for the other parts of the component.
    [[nodiscard]] const detail::GmshModel& gmsh_model() const;
    [[nodiscard]] const detail::Topology& topology() const;

private:
    friend class GmshCutter;
    struct Data;
    explicit GmshBrep(std::unique_ptr<Data> data);
    void set_tags(std::array<std::vector<std::vector<int>>, 4> tags);
    std::unique_ptr<Data> data_;
};

static_assert(brep<GmshBrep>);

}  // namespace pavior
