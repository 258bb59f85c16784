#pragma once

#include <pavior/brep/solids_mesh.hpp>
#include <pavior/mesh/append_mesh.hpp>

#include <vector>

namespace pavior {

namespace detail {

template <class T>
void append_entries(const std::vector<T>& from, std::vector<T>& to) {
    to.insert(to.end(), from.begin(), from.end());
}

}  // namespace detail

PAVIOR_INLINE void append_solids(const SolidsMesh& other, SolidsMesh& mesh) {
    append_mesh(other.mesh, other.quads, mesh.mesh, mesh.quads);
    detail::append_entries(other.hex_solid, mesh.hex_solid);
    detail::append_entries(other.quad_face, mesh.quad_face);
}

PAVIOR_INLINE void extend_solids(const SolidsMesh& other, SolidsMesh& mesh) {
    mesh.mesh.nodes = other.mesh.nodes;
    detail::append_entries(other.mesh.hexes, mesh.mesh.hexes);
    detail::append_entries(other.hex_solid, mesh.hex_solid);
    detail::append_entries(other.quads, mesh.quads);
    detail::append_entries(other.quad_face, mesh.quad_face);
}

}  // namespace pavior
