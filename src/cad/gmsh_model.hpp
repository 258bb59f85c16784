#pragma once
// One Gmsh model: made, made current, evaluated, removed. Internal to the cad component.

#include "../common/gmsh_session.hpp"

#include <pavior/core/error.hpp>
#include <pavior/math/box.hpp>
#include <pavior/math/point.hpp>

#include <gmsh.h>

#include <array>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace pavior::detail {

/// "face 12", "edge 3" ... with Gmsh's tag.
std::string entity_label(int dim, int tag);

/// The box that Gmsh knows round an entity of the current model; without a tag round all of them.
inline Box<> bounding_box(int dim = -1, int tag = -1) {
    Box<> box;
    gmsh::model::getBoundingBox(dim, tag, box.low[0], box.low[1], box.low[2], box.high[0], box.high[1], box.high[2]);
    return box;
}

/// Runs \p body; what Gmsh throws becomes Error(cad_failure) that names the entity.
template <class Body>
auto on_entity(int dim, int tag, Body&& body) -> decltype(body()) {
    return with_gmsh(std::forward<Body>(body), [&](const std::string& message) {
        throw Error(ErrorCode::cad_failure, entity_label(dim, tag) + ": " + message, {tag});
    });
}

/// A Gmsh model of its own name, alive as long as this object.
class GmshModel {
public:
    GmshModel();
    GmshModel(const GmshModel&) = delete;
    GmshModel& operator=(const GmshModel&) = delete;
    ~GmshModel();

    [[nodiscard]] const std::string& name() const { return name_; }

    /// While alive the model is current; then the one that was.
    class Current {
    public:
        explicit Current(const GmshModel& model);
        Current(const Current&) = delete;
        Current& operator=(const Current&) = delete;
        ~Current();

    private:
        std::string previous_;
        bool switched_;
    };

    [[nodiscard]] std::array<double, 2> edge_range(int tag) const;
    [[nodiscard]] std::array<Vec2, 2> face_bounds(int tag) const;
    [[nodiscard]] Vec3 vertex_point(int tag) const;
    void edge_points(int tag, std::span<const double> t, std::span<Vec3> points) const;
    [[nodiscard]] Vec3 edge_derivative(int tag, double t) const;
    void face_points(int tag, std::span<const Vec2> uv, std::span<Vec3> points) const;
    /// {d/du, d/dv} of each.
    void face_derivatives(int tag, std::span<const Vec2> uv, std::span<std::array<Vec3, 2>> derivatives) const;
    /// What Gmsh takes for the parameters of the points of an edge on a face; `side` picks one of two on a seam.
    void edge_on_face(int edge, std::span<const double> t, int face, int side, std::span<Vec2> uv) const;
    /// Gmsh's own orthogonal projection; false if it finds none.
    [[nodiscard]] bool project_on_face(int tag, const Vec3& x, Vec2& uv) const;
    [[nodiscard]] bool inside_face(int tag, const Vec2& uv) const;
    [[nodiscard]] double mass(int dim, int tag) const;

private:
    GmshSession session_;
    std::string name_;
    mutable std::vector<double> in_;
    mutable std::vector<double> out_;
};

/// Keeps standard output, std::cout and std::cerr quiet: OpenCASCADE and the matching code in Gmsh print.
class Hush {
public:
    Hush();
    Hush(const Hush&) = delete;
    Hush& operator=(const Hush&) = delete;
    ~Hush();

private:
    std::streambuf* out_;
    std::streambuf* error_;
    int descriptor_;
};

}  // namespace pavior::detail
