#pragma once
/// \file
/// Any brep behind one type, so that what takes it is compiled once.

#include <pavior/brep/all_tags.hpp>
#include <pavior/brep/brep.hpp>
#include <pavior/part/model_extras.hpp>

#include <array>
#include <concepts>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace pavior {

/// A view of a model; models brep, and knows beyond it what the model knows (part/model_extras.hpp). Made from any
/// brep, to which it keeps a reference. A call costs what the model takes and a virtual call. Copies are cheap;
/// thread-safe as the model is.
class AnyModel {
public:
    template <class B>
    requires(!std::same_as<B, AnyModel> && brep<B>) AnyModel(const B& b)
        : model_(std::make_shared<const Of<B>>(b)) {}  // NOLINT: a model is passed as it is
    template <class B>
    requires(!std::same_as<B, AnyModel> && brep<B>) AnyModel(const B&& b)
    = delete;

    [[nodiscard]] std::size_t vertex_count() const { return model_->vertex_count(); }
    [[nodiscard]] std::size_t edge_count() const { return model_->edge_count(); }
    [[nodiscard]] std::size_t face_count() const { return model_->face_count(); }
    [[nodiscard]] std::size_t solid_count() const { return model_->solid_count(); }
    [[nodiscard]] std::span<const OrientedFace> solid_faces(SolidId s) const { return model_->solid_faces(s); }
    [[nodiscard]] std::span<const EdgeLoop> face_loops(FaceId f) const { return model_->face_loops(f); }
    [[nodiscard]] std::array<VertexId, 2> edge_vertices(EdgeId e) const { return model_->edge_vertices(e); }
    [[nodiscard]] Vec3 vertex_point(VertexId v) const { return model_->vertex_point(v); }
    [[nodiscard]] std::array<double, 2> edge_range(EdgeId e) const { return model_->edge_range(e); }
    [[nodiscard]] Vec3 edge_point(EdgeId e, double t) const { return model_->edge_point(e, t); }
    [[nodiscard]] Vec3 edge_derivative(EdgeId e, double t) const { return model_->edge_derivative(e, t); }
    [[nodiscard]] double edge_length(EdgeId e) const { return model_->edge_length(e); }
    [[nodiscard]] Vec3 face_point(FaceId f, const Vec2& uv) const { return model_->face_point(f, uv); }
    [[nodiscard]] std::pair<Vec3, Vec3> face_derivatives(FaceId f, const Vec2& uv) const {
        return model_->face_derivatives(f, uv);
    }
    [[nodiscard]] Vec2 closest_on_face(FaceId f, const Vec3& x) const { return model_->closest_on_face(f, x); }
    [[nodiscard]] Vec2 edge_on_face(EdgeId e, double t, FaceId f, bool forward) const {
        return model_->edge_on_face(e, t, f, forward);
    }
    [[nodiscard]] std::array<double, 2> face_period(FaceId f) const { return model_->face_period(f); }
    [[nodiscard]] int tag(int dimension, std::size_t index) const { return model_->tag(dimension, index); }

    /// As the free function of the same name.
    [[nodiscard]] std::vector<int> all_tags(int dimension, std::size_t index) const {
        return model_->all_tags(dimension, index);
    }

    /// As plane_of(), is_plane() ("Plane" or nothing), volume_of(), diagonal_of() and name_of() of the model.
    [[nodiscard]] std::optional<FacePlane> face_plane(FaceId f) const { return model_->face_plane(f); }
    [[nodiscard]] std::string face_kind(FaceId f) const { return model_->plane(f) ? "Plane" : ""; }
    [[nodiscard]] std::optional<double> solid_volume(SolidId s) const { return model_->solid_volume(s); }
    [[nodiscard]] double diagonal() const { return model_->diagonal(); }
    [[nodiscard]] std::string face_name(FaceId f) const { return model_->face_name(f); }
    [[nodiscard]] std::string solid_name(SolidId s) const { return model_->solid_name(s); }

private:
    struct Model {
        Model() = default;
        Model(const Model&) = delete;
        Model& operator=(const Model&) = delete;
        virtual ~Model() = default;
        [[nodiscard]] virtual std::size_t vertex_count() const = 0;
        [[nodiscard]] virtual std::size_t edge_count() const = 0;
        [[nodiscard]] virtual std::size_t face_count() const = 0;
        [[nodiscard]] virtual std::size_t solid_count() const = 0;
        [[nodiscard]] virtual std::span<const OrientedFace> solid_faces(SolidId s) const = 0;
        [[nodiscard]] virtual std::span<const EdgeLoop> face_loops(FaceId f) const = 0;
        [[nodiscard]] virtual std::array<VertexId, 2> edge_vertices(EdgeId e) const = 0;
        [[nodiscard]] virtual Vec3 vertex_point(VertexId v) const = 0;
        [[nodiscard]] virtual std::array<double, 2> edge_range(EdgeId e) const = 0;
        [[nodiscard]] virtual Vec3 edge_point(EdgeId e, double t) const = 0;
        [[nodiscard]] virtual Vec3 edge_derivative(EdgeId e, double t) const = 0;
        [[nodiscard]] virtual double edge_length(EdgeId e) const = 0;
        [[nodiscard]] virtual Vec3 face_point(FaceId f, const Vec2& uv) const = 0;
        [[nodiscard]] virtual std::pair<Vec3, Vec3> face_derivatives(FaceId f, const Vec2& uv) const = 0;
        [[nodiscard]] virtual Vec2 closest_on_face(FaceId f, const Vec3& x) const = 0;
        [[nodiscard]] virtual Vec2 edge_on_face(EdgeId e, double t, FaceId f, bool forward) const = 0;
        [[nodiscard]] virtual std::array<double, 2> face_period(FaceId f) const = 0;
        [[nodiscard]] virtual int tag(int dimension, std::size_t index) const = 0;
        [[nodiscard]] virtual std::vector<int> all_tags(int dimension, std::size_t index) const = 0;
        [[nodiscard]] virtual std::optional<FacePlane> face_plane(FaceId f) const = 0;
        [[nodiscard]] virtual bool plane(FaceId f) const = 0;
        [[nodiscard]] virtual std::optional<double> solid_volume(SolidId s) const = 0;
        [[nodiscard]] virtual double diagonal() const = 0;
        [[nodiscard]] virtual std::string face_name(FaceId f) const = 0;
        [[nodiscard]] virtual std::string solid_name(SolidId s) const = 0;
    };

    template <brep B>
    struct Of final : Model {
        explicit Of(const B& b) : b_(b) {}
        std::size_t vertex_count() const override { return b_.vertex_count(); }
        std::size_t edge_count() const override { return b_.edge_count(); }
        std::size_t face_count() const override { return b_.face_count(); }
        std::size_t solid_count() const override { return b_.solid_count(); }
        std::span<const OrientedFace> solid_faces(SolidId s) const override { return b_.solid_faces(s); }
        std::span<const EdgeLoop> face_loops(FaceId f) const override { return b_.face_loops(f); }
        std::array<VertexId, 2> edge_vertices(EdgeId e) const override { return b_.edge_vertices(e); }
        Vec3 vertex_point(VertexId v) const override { return b_.vertex_point(v); }
        std::array<double, 2> edge_range(EdgeId e) const override { return b_.edge_range(e); }
        Vec3 edge_point(EdgeId e, double t) const override { return b_.edge_point(e, t); }
        Vec3 edge_derivative(EdgeId e, double t) const override { return b_.edge_derivative(e, t); }
        double edge_length(EdgeId e) const override { return b_.edge_length(e); }
        Vec3 face_point(FaceId f, const Vec2& uv) const override { return b_.face_point(f, uv); }
        std::pair<Vec3, Vec3> face_derivatives(FaceId f, const Vec2& uv) const override {
            return b_.face_derivatives(f, uv);
        }
        Vec2 closest_on_face(FaceId f, const Vec3& x) const override { return b_.closest_on_face(f, x); }
        Vec2 edge_on_face(EdgeId e, double t, FaceId f, bool forward) const override {
            return b_.edge_on_face(e, t, f, forward);
        }
        std::array<double, 2> face_period(FaceId f) const override { return b_.face_period(f); }
        int tag(int dimension, std::size_t index) const override { return b_.tag(dimension, index); }
        std::vector<int> all_tags(int dimension, std::size_t index) const override {
            return pavior::all_tags(b_, dimension, index);
        }
        std::optional<FacePlane> face_plane(FaceId f) const override { return plane_of(b_, f); }
        bool plane(FaceId f) const override { return is_plane(b_, f); }
        std::optional<double> solid_volume(SolidId s) const override { return volume_of(b_, s); }
        double diagonal() const override { return diagonal_of(b_); }
        std::string face_name(FaceId f) const override { return name_of(b_, f); }
        std::string solid_name(SolidId s) const override { return name_of(b_, s); }

    private:
        const B& b_;
    };

    std::shared_ptr<const Model> model_;
};

static_assert(brep<AnyModel>);

}  // namespace pavior
