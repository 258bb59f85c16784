#pragma once
// The smallest types that model the concepts beside those of meshes (foreign_meshes.hpp): what an algorithm may use,
// and nothing more. None can be copied, moved or default-constructed, and what their functions return is nothing but
// convertible to what the concept asks for.

#include <pavior/brep/brep.hpp>
#include <pavior/core/index.hpp>
#include <pavior/math/point.hpp>

#include <array>
#include <cstddef>
#include <functional>
#include <span>
#include <utility>
#include <vector>

namespace archetype {

/// Convertible to T, and nothing else.
template <class T>
class Convertible {
public:
    explicit Convertible(T value) : value_(std::move(value)) {}
    Convertible(const Convertible&) = delete;
    Convertible& operator=(const Convertible&) = delete;
    operator T() const { return value_; }  // NOLINT: implicit on purpose

private:
    T value_;
};

/// A callable that need not be const: an integer_solver, plane_imprinter, region_mesher or cap_mesher. Counts its
/// calls.
template <class Signature>
class Callable;
template <class R, class... Arguments>
class Callable<R(Arguments...)> {
public:
    explicit Callable(std::function<R(Arguments...)> function) : function_(std::move(function)) {}
    Callable(const Callable&) = delete;
    Callable& operator=(const Callable&) = delete;
    Convertible<R> operator()(Arguments... arguments) {
        ++calls_;
        return Convertible<R>(function_(arguments...));
    }
    [[nodiscard]] int calls() const { return calls_; }

private:
    std::function<R(Arguments...)> function_;
    int calls_ = 0;
};

/// A rib_curve.
class Curve {
public:
    explicit Curve(std::function<pavior::Vec3(double)> function) : function_(std::move(function)) {}
    Curve(const Curve&) = delete;
    Curve& operator=(const Curve&) = delete;
    Convertible<pavior::Vec3> operator()(double t) const { return Convertible<pavior::Vec3>(function_(t)); }

private:
    std::function<pavior::Vec3(double)> function_;
};

/// A parametric_surface that does as another one.
template <class S>
class Surface {
public:
    explicit Surface(const S& surface) : surface_(surface) {}
    Surface(const Surface&) = delete;
    Surface& operator=(const Surface&) = delete;
    [[nodiscard]] Convertible<pavior::Vec3> point(const pavior::Vec2& uv) const {
        return Convertible<pavior::Vec3>(surface_.point(uv));
    }
    [[nodiscard]] Convertible<std::pair<pavior::Vec3, pavior::Vec3>> derivatives(const pavior::Vec2& uv) const {
        return Convertible<std::pair<pavior::Vec3, pavior::Vec3>>(surface_.derivatives(uv));
    }

private:
    const S& surface_;
};

/// An extruded_geometry that does as another one.
template <class G>
class Geometry {
public:
    explicit Geometry(const G& geometry) : geometry_(geometry) {}
    Geometry(const Geometry&) = delete;
    Geometry& operator=(const Geometry&) = delete;
    [[nodiscard]] Convertible<pavior::Vec3> curve_point(pavior::Index curve, const pavior::Vec2& near) const {
        return Convertible<pavior::Vec3>(geometry_.curve_point(curve, near));
    }
    [[nodiscard]] Convertible<double> cap_height(pavior::Index cap, const pavior::Vec2& at) const {
        return Convertible<double>(geometry_.cap_height(cap, at));
    }

private:
    const G& geometry_;
};

/// A brep that does as another one. Its vectors are those that brep names.
template <pavior::brep B>
class Brep {
public:
    explicit Brep(const B& b) : b_(b) {}
    Brep(const Brep&) = delete;
    Brep& operator=(const Brep&) = delete;
    [[nodiscard]] std::size_t vertex_count() const { return b_.vertex_count(); }
    [[nodiscard]] std::size_t edge_count() const { return b_.edge_count(); }
    [[nodiscard]] std::size_t face_count() const { return b_.face_count(); }
    [[nodiscard]] std::size_t solid_count() const { return b_.solid_count(); }
    [[nodiscard]] std::span<const pavior::OrientedFace> solid_faces(pavior::SolidId s) const {
        return b_.solid_faces(s);
    }
    [[nodiscard]] std::span<const pavior::EdgeLoop> face_loops(pavior::FaceId f) const { return b_.face_loops(f); }
    [[nodiscard]] std::array<pavior::VertexId, 2> edge_vertices(pavior::EdgeId e) const { return b_.edge_vertices(e); }
    [[nodiscard]] pavior::Vec3 vertex_point(pavior::VertexId v) const { return b_.vertex_point(v); }
    [[nodiscard]] std::array<double, 2> edge_range(pavior::EdgeId e) const { return b_.edge_range(e); }
    [[nodiscard]] pavior::Vec3 edge_point(pavior::EdgeId e, double t) const { return b_.edge_point(e, t); }
    [[nodiscard]] pavior::Vec3 edge_derivative(pavior::EdgeId e, double t) const { return b_.edge_derivative(e, t); }
    [[nodiscard]] double edge_length(pavior::EdgeId e) const { return b_.edge_length(e); }
    [[nodiscard]] pavior::Vec3 face_point(pavior::FaceId f, const pavior::Vec2& uv) const {
        return b_.face_point(f, uv);
    }
    [[nodiscard]] std::pair<pavior::Vec3, pavior::Vec3> face_derivatives(pavior::FaceId f,
                                                                         const pavior::Vec2& uv) const {
        return b_.face_derivatives(f, uv);
    }
    [[nodiscard]] pavior::Vec2 closest_on_face(pavior::FaceId f, const pavior::Vec3& x) const {
        return b_.closest_on_face(f, x);
    }
    [[nodiscard]] pavior::Vec2 edge_on_face(pavior::EdgeId e, double t, pavior::FaceId f, bool forward) const {
        return b_.edge_on_face(e, t, f, forward);
    }
    [[nodiscard]] std::array<double, 2> face_period(pavior::FaceId f) const { return b_.face_period(f); }
    [[nodiscard]] int tag(int dim, std::size_t index) const { return b_.tag(dim, index); }

private:
    const B& b_;
};

}  // namespace archetype
