#pragma once
/// \file
/// The hexahedral mesh of a sweep: stored nodes, implicit hexahedra.

#include <pavior/core/compiled.hpp>
#include <pavior/mesh/cells.hpp>
#include <pavior/mesh/mesh_access.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace pavior {

/// Numbering of the nodes and hexahedra of a sweep with n nodes a level, q quads and r layers.
///
///     node (k, i) = k n + i                  level k = 0 .. r, node i of the source
///     hexahedron (k, j) = k q + j            layer k = 0 .. r - 1, quad j of the source
///     corners 0 1 2 3: quad j at level k;  corners 4 5 6 7: quad j at level k + 1
struct SweepNumbering {
    std::size_t level_size = 0;  ///< n
    std::size_t layers = 0;      ///< r

    [[nodiscard]] std::size_t node(std::size_t k, std::size_t i) const { return k * level_size + i; }
    /// Corners of the hexahedron on \p quad in layer k. \pre the ids fit into Index
    [[nodiscard]] HexCorners hex(std::size_t k, const QuadCorners& quad) const;
    /// \throws InputError overflow if a node or hexahedron id does not fit into Index
    void check(std::size_t quads) const;
};

/// Models hex_mesh: nodes stored level by level in source order, hexahedra made when asked for. Immutable topology;
/// nodes may be moved. Safe to read from several threads.
class SweepMesh {
public:
    SweepMesh() = default;
    /// \param nodes (r + 1) n points, level by level  \param quads of the source
    /// \throws InputError size_mismatch, overflow (ids)
    SweepMesh(std::vector<Vec3> nodes, std::vector<QuadCorners> quads, std::size_t layers);

    [[nodiscard]] std::size_t layer_count() const { return numbering_.layers; }
    [[nodiscard]] std::size_t level_size() const { return numbering_.level_size; }
    [[nodiscard]] const SweepNumbering& numbering() const { return numbering_; }
    [[nodiscard]] std::span<const Vec3> nodes() const { return nodes_; }
    [[nodiscard]] std::span<Vec3> nodes() { return nodes_; }
    [[nodiscard]] std::span<const QuadCorners> quads() const { return quads_; }
    /// The nodes of level k, 0 <= k <= r.
    [[nodiscard]] std::span<const Vec3> level(std::size_t k) const {
        return nodes().subspan(k * level_size(), level_size());
    }

    [[nodiscard]] std::size_t hex_count() const { return numbering_.layers * quads_.size(); }
    [[nodiscard]] HexCorners hex(std::size_t h) const {
        return numbering_.hex(h / quads_.size(), quads_[h % quads_.size()]);
    }
    /// All hexahedra, for those who need the connectivity in memory. O(r q)
    [[nodiscard]] std::vector<HexCorners> hexes() const;

private:
    std::vector<Vec3> nodes_;
    std::vector<QuadCorners> quads_;
    SweepNumbering numbering_;
};

template <>
struct mesh_access<SweepMesh> {
    static std::size_t node_count(const SweepMesh& m) { return m.nodes().size(); }
    static const Vec3& node(const SweepMesh& m, Index i) { return m.nodes()[i]; }
    static std::size_t hex_count(const SweepMesh& m) { return m.hex_count(); }
    static HexCorners hex(const SweepMesh& m, Index h) { return m.hex(h); }
};

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/sweep/sweep_mesh-inl.hpp>
#endif
