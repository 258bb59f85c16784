#pragma once

#include <pavior/brep/match_quads.hpp>
#include <pavior/one_to_one/side_grid.hpp>
#include <pavior/one_to_one/structure_side.hpp>

#include <cstddef>
#include <utility>
#include <vector>

namespace pavior {

PAVIOR_INLINE bool structure_side(BoundaryMesh& mesh, const LinkingSide& side, const Periods& periods) {
    FaceMesh& face = mesh.faces[side.face.index()];
    const std::vector<Index> bottom = detail::chain_ids(mesh, side.bottom);
    const std::vector<Index> left = detail::chain_ids(mesh, side.left);
    const std::vector<Index> right = detail::chain_ids(mesh, side.right);
    const std::size_t columns = bottom.size() - 1;
    const std::size_t rows = left.size() - 1;
    if (bottom.empty() || left.empty() || right.size() != left.size() || columns * rows != face.quads.size()) {
        return false;
    }
    std::vector<QuadCorners> quads = side.outward ? face.quads : detail::flipped(face.quads);
    for (QuadCorners& quad : quads) {
        for (Index& corner : quad) {
            corner = face.nodes[corner];
        }
    }
    const detail::HalfEdgeTable table(quads);
    std::vector<Index> ids = bottom;
    for (std::size_t k = 0; k < rows; ++k) {
        for (std::size_t i = 0; i < columns; ++i) {
            const auto half = table.find(ids[k * (columns + 1) + i], ids[k * (columns + 1) + i + 1]);
            if (!half) {
                return false;
            }
            const QuadCorners& quad = quads[*half / 4];
            const Index above = quad[(*half + 3) % 4];
            const Index beyond = quad[(*half + 2) % 4];
            if (i == 0) {
                ids.push_back(above);
            } else if (ids.back() != above) {
                return false;
            }
            ids.push_back(beyond);
        }
        if (ids[(k + 1) * (columns + 1)] != left[k + 1] || ids.back() != right[k + 1]) {
            return false;
        }
    }
    if (std::vector<Index>(ids.end() - static_cast<std::ptrdiff_t>(columns) - 1, ids.end()) !=
        detail::chain_ids(mesh, side.top)) {
        return false;
    }
    const detail::PositionOf position(face.nodes);
    std::vector<Vec2> uv;
    for (std::size_t n = 0; n < ids.size(); ++n) {
        uv.push_back(face.uv[position(ids[n])]);
        if (n > 0) {
            const std::size_t before = n % (columns + 1) > 0 ? n - 1 : n - columns - 1;
            uv.back() += nearest_image_shift(uv.back(), uv[before], periods);
        }
    }
    face.columns = static_cast<int>(columns);
    face.rows = static_cast<int>(rows);
    face.nodes = std::move(ids);
    face.uv = std::move(uv);
    face.quads = side_quads(side, columns, rows);
    return true;
}

}  // namespace pavior
