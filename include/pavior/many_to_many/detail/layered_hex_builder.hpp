#pragma once
/// \file
/// Makes the nodes, hexahedra and boundary quads of layered hexahedra.

#include <pavior/core/compiled.hpp>
#include <pavior/many_to_many/column_heights.hpp>
#include <pavior/many_to_many/layered_hexes.hpp>
#include <pavior/many_to_many/level_program.hpp>
#include <pavior/many_to_many/plane_mesh.hpp>

#include <cstddef>
#include <vector>

namespace pavior {

namespace detail {

/// The solid over each cell between each level and the next, no_index: none.
class LayerSolids {
public:
    LayerSolids(const ExtrudedBody& body, const std::vector<CapsOverCell>& stacks, const CapLevels& levels);
    [[nodiscard]] std::size_t layers() const { return layers_; }
    [[nodiscard]] Index operator()(Index cell, std::size_t layer) const {
        return cell == no_index ? no_index : solid_[cell * layers_ + layer];
    }

private:
    std::size_t layers_;
    std::vector<Index> solid_;
};

/// Makes the nodes, hexahedra and boundary quads; their places are another matter.
class LayeredHexBuilder {
public:
    LayeredHexBuilder(const ExtrudedBody& body, const PlaneArrangement& arrangement, const PlaneMesh& plane,
                      const std::vector<CapsOverCell>& stacks, const CapLevels& levels);

    [[nodiscard]] const ColumnNodes& nodes() const { return nodes_; }
    [[nodiscard]] const LayerSolids& solids() const { return solids_; }
    [[nodiscard]] LayeredHexes& result() { return result_; }

private:
    template <class Visit>
    void for_quads(Index cell, Visit&& visit) const {
        for (std::size_t q = plane_.cell_quads[cell]; q < plane_.cell_quads[cell + 1]; ++q) {
            visit(plane_.quads[q]);
        }
    }

    void number_nodes();

    void add_hexes();

    void add_quad(QuadCorners quad, bool flip, Index surface, Index solid);

    void add_caps();

    void add_sides();

    const ExtrudedBody& body_;
    const PlaneArrangement& arrangement_;
    const PlaneMesh& plane_;
    const std::vector<CapsOverCell>& stacks_;
    const CapLevels& levels_;
    LayerSolids solids_;
    ColumnNodes nodes_;
    LayeredHexes result_;
};

}  // namespace detail

}  // namespace pavior

#ifndef PAVIOR_COMPILED
#include <pavior/many_to_many/detail/layered_hex_builder-inl.hpp>
#endif
