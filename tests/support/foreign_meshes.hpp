#pragma once
// The smallest types that model the mesh concepts: what an algorithm may use, and nothing more.

#include <pavior/mesh/span_mesh.hpp>

#include <cstddef>
#include <utility>
#include <vector>

namespace archetype {

/// Three floats behind operator[], nothing else.
class Point {
public:
    explicit Point(const pavior::Vec3& p)
        : x_(static_cast<float>(p.x())), y_(static_cast<float>(p.y())), z_(static_cast<float>(p.z())) {}
    float operator[](int axis) const { return axis == 0 ? x_ : axis == 1 ? y_ : z_; }

private:
    float x_, y_, z_;
};

/// Corners behind operator[], convertible to Index.
class Corners {
public:
    explicit Corners(const pavior::Index* at) : at_(at) {}
    pavior::Index operator[](int k) const { return at_[k]; }

private:
    const pavior::Index* at_;
};

/// Quad mesh that can be neither copied nor default-constructed. Coordinates are rounded to float.
class Quads {
public:
    explicit Quads(pavior::QuadMesh mesh) : mesh_(std::move(mesh)) {}
    Quads(const Quads&) = delete;
    Quads& operator=(const Quads&) = delete;
    [[nodiscard]] const pavior::QuadMesh& get() const { return mesh_; }

private:
    pavior::QuadMesh mesh_;
};

/// Hexahedral mesh, likewise.
class Hexes {
public:
    explicit Hexes(pavior::HexMesh mesh) : mesh_(std::move(mesh)) {}
    Hexes(const Hexes&) = delete;
    Hexes& operator=(const Hexes&) = delete;
    [[nodiscard]] const pavior::HexMesh& get() const { return mesh_; }

private:
    pavior::HexMesh mesh_;
};

}  // namespace archetype

template <>
struct pavior::mesh_access<archetype::Quads> {
    static unsigned node_count(const archetype::Quads& m) { return static_cast<unsigned>(m.get().nodes.size()); }
    static archetype::Point node(const archetype::Quads& m, Index i) { return archetype::Point(m.get().nodes[i]); }
    static unsigned quad_count(const archetype::Quads& m) { return static_cast<unsigned>(m.get().quads.size()); }
    static archetype::Corners quad(const archetype::Quads& m, Index q) {
        return archetype::Corners(m.get().quads[q].data());
    }
};

template <>
struct pavior::mesh_access<archetype::Hexes> {
    static unsigned node_count(const archetype::Hexes& m) { return static_cast<unsigned>(m.get().nodes.size()); }
    static archetype::Point node(const archetype::Hexes& m, Index i) { return archetype::Point(m.get().nodes[i]); }
    static unsigned hex_count(const archetype::Hexes& m) { return static_cast<unsigned>(m.get().hexes.size()); }
    static archetype::Corners hex(const archetype::Hexes& m, Index h) {
        return archetype::Corners(m.get().hexes[h].data());
    }
};
