// expect: face_period.*invalid
#include <pavior/brep/brep.hpp>

// Just enough of a model for the compiler.
struct Model {
    std::size_t vertex_count() const;
    std::size_t edge_count() const;
    std::size_t face_count() const;
    std::size_t solid_count() const;
    std::span<const pavior::OrientedFace> solid_faces(pavior::SolidId) const;
    std::span<const pavior::EdgeLoop> face_loops(pavior::FaceId) const;
    std::array<pavior::VertexId, 2> edge_vertices(pavior::EdgeId) const;
    pavior::Vec3 vertex_point(pavior::VertexId) const;
    std::array<double, 2> edge_range(pavior::EdgeId) const;
    pavior::Vec3 edge_point(pavior::EdgeId, double) const;
    pavior::Vec3 edge_derivative(pavior::EdgeId, double) const;
    double edge_length(pavior::EdgeId) const;
    pavior::Vec3 face_point(pavior::FaceId, pavior::Vec2) const;
    std::pair<pavior::Vec3, pavior::Vec3> face_derivatives(pavior::FaceId, pavior::Vec2) const;
    pavior::Vec2 closest_on_face(pavior::FaceId, pavior::Vec3) const;
    pavior::Vec2 edge_on_face(pavior::EdgeId, double, pavior::FaceId, bool) const;
#ifndef MISUSE
    std::array<double, 2> face_period(pavior::FaceId) const;
#endif
    int tag(int, std::size_t) const;
};

template <pavior::brep B>
std::size_t faces(const B& model) {
    return model.face_count();
}

std::size_t count(const Model& model) { return faces(model); }
