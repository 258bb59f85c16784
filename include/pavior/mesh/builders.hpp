#pragma once
/// \file
/// Writing hexahedral meshes into the user's type.

#include <pavior/mesh/span_mesh.hpp>

#include <concepts>
#include <cstddef>
#include <utility>

namespace pavior {

/// A type B is a hex_builder if, for a B& b:
/// 1. b.add_node(x) takes a Vec3;
/// 2. b.add_hex(corners) takes a HexCorners;
/// 3. (not checkable) nodes come in the order of their ids 0, 1, 2 ..., and a hexahedron comes after its nodes: the
///    builder may store or write both at once and needs no random access;
/// 4. (not checkable) calls come from one thread at a time; what they throw passes through the algorithm.
/// A member b.reserve(nodes, hexes), if there is one, is called first with the final counts. Results are ignored.
template <class B>
concept hex_builder = requires(B& b, const Vec3& x, const HexCorners& corners) {
    b.add_node(x);
    b.add_hex(corners);
};

/// Builds a HexMesh.
class HexMeshBuilder {
public:
    void reserve(std::size_t nodes, std::size_t hexes) {
        mesh_.nodes.reserve(mesh_.nodes.size() + nodes);
        mesh_.hexes.reserve(mesh_.hexes.size() + hexes);
    }
    void add_node(const Vec3& x) { mesh_.nodes.push_back(x); }
    void add_hex(const HexCorners& corners) { mesh_.hexes.push_back(corners); }

    [[nodiscard]] const HexMesh& mesh() const& { return mesh_; }
    /// Gives the mesh away and starts a new one.
    [[nodiscard]] HexMesh take() { return std::exchange(mesh_, {}); }

private:
    HexMesh mesh_;
};

/// Announces the final counts to a builder that wants them.
template <hex_builder B>
void reserve(B& builder, std::size_t nodes, std::size_t hexes) {
    if constexpr (requires { builder.reserve(nodes, hexes); }) {
        builder.reserve(nodes, hexes);
    }
}

/// Writes all of \p mesh, nodes first. The builder must be new: node ids are written as they are. O(n).
template <hex_mesh M, hex_builder B>
void write(const M& mesh, B& builder) {
    reserve(builder, node_count(mesh), hex_count(mesh));
    for (const Index i : IndexRange(node_count(mesh))) {
        builder.add_node(node(mesh, i));
    }
    for (const Index h : IndexRange(hex_count(mesh))) {
        builder.add_hex(hex(mesh, h));
    }
}

}  // namespace pavior
