#pragma once
/// \file
/// Meshes kept as Eigen matrices: V (nodes by 3) and F (quads by 4, triangles by 3), T (tetrahedra by 4) or H
/// (hexahedra by 8).

#include <pavior/core/error.hpp>
#include <pavior/mesh/mesh_access.hpp>

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <limits>
#include <string>

namespace pavior {

namespace detail {
/// Rows of V as points and of C as cells of N corners, both by reference.
template <class DerivedV, class DerivedC, int N>
class EigenMesh {
    static_assert(DerivedV::ColsAtCompileTime == Eigen::Dynamic || DerivedV::ColsAtCompileTime == 2 ||
                      DerivedV::ColsAtCompileTime == 3,
                  "V needs 2 or 3 columns");
    static_assert(DerivedC::ColsAtCompileTime == Eigen::Dynamic || DerivedC::ColsAtCompileTime == N,
                  "one column for each corner of a cell");

public:
    EigenMesh(const DerivedV& nodes, const DerivedC& cells) : nodes_(nodes), cells_(cells) {
        if ((nodes.cols() != 3 && nodes.cols() != 2) || cells.cols() != N) {
            throw InputError(ErrorCode::size_mismatch,
                             "V has " + std::to_string(nodes.cols()) + " columns, wanted 3 or 2; the cells have " +
                                 std::to_string(cells.cols()) + ", wanted " + std::to_string(N));
        }
    }

    [[nodiscard]] std::size_t node_count() const { return static_cast<std::size_t>(nodes_.rows()); }
    [[nodiscard]] std::size_t cell_count() const { return static_cast<std::size_t>(cells_.rows()); }
    [[nodiscard]] Vec3 node(Index i) const {
        const auto row = static_cast<Eigen::Index>(i);
        const auto at = [&](Eigen::Index axis) { return static_cast<double>(nodes_.coeff(row, axis)); };
        return {at(0), at(1), nodes_.cols() == 3 ? at(2) : 0.0};
    }
    [[nodiscard]] std::array<Index, std::size_t{N}> cell(Index c) const {
        std::array<Index, std::size_t{N}> corners;
        for (int k = 0; k < N; ++k) {
            corners[static_cast<std::size_t>(k)] = id(cells_.coeff(static_cast<Eigen::Index>(c), k));
        }
        return corners;
    }

private:
    /// An id that Index cannot hold stays out of range.
    template <class Integer>
    [[nodiscard]] static Index id(Integer value) {
        static_assert(std::numeric_limits<Integer>::is_integer, "cells are matrices of integers");
        constexpr Index last = std::numeric_limits<Index>::max();
        if constexpr (std::numeric_limits<Integer>::is_signed) {
            if (value < 0) {
                return last;
            }
        }
        return static_cast<std::size_t>(value) > last ? last : static_cast<Index>(value);
    }

    const DerivedV& nodes_;
    const DerivedC& cells_;
};
}  // namespace detail

/// Quad mesh over the user's matrices, by reference: row i of V is node i (3 columns, or 2: z = 0), row q of F the four
/// corners of quad q. Any dense type with coefficients: Matrix, Array, Map, Ref; float or double, any integer.
///
///     Eigen::MatrixXd V; Eigen::MatrixXi F;
///     const auto loops = pavior::boundary_loops(pavior::EigenQuadMesh(V, F));
///
/// Both must outlive the view; temporaries do not compile. Throws InputError (size_mismatch) for other numbers of
/// columns. Negative ids read as out of range.
template <class DerivedV, class DerivedF>
class EigenQuadMesh : public detail::EigenMesh<DerivedV, DerivedF, 4> {
public:
    EigenQuadMesh(const DerivedV& nodes, const DerivedF& quads)
        : detail::EigenMesh<DerivedV, DerivedF, 4>(nodes, quads) {}
    EigenQuadMesh(const DerivedV&&, const DerivedF&) = delete;
    EigenQuadMesh(const DerivedV&, const DerivedF&&) = delete;
    EigenQuadMesh(const DerivedV&&, const DerivedF&&) = delete;
};

/// Hexahedral mesh over the user's matrices: row h of H has the eight corners of hexahedron h. Otherwise as
/// EigenQuadMesh.
template <class DerivedV, class DerivedH>
class EigenHexMesh : public detail::EigenMesh<DerivedV, DerivedH, 8> {
public:
    EigenHexMesh(const DerivedV& nodes, const DerivedH& hexes)
        : detail::EigenMesh<DerivedV, DerivedH, 8>(nodes, hexes) {}
    EigenHexMesh(const DerivedV&&, const DerivedH&) = delete;
    EigenHexMesh(const DerivedV&, const DerivedH&&) = delete;
    EigenHexMesh(const DerivedV&&, const DerivedH&&) = delete;
};

/// Triangle mesh over the user's matrices: row t of F has the three corners of triangle t. Otherwise as EigenQuadMesh.
template <class DerivedV, class DerivedF>
class EigenTriMesh : public detail::EigenMesh<DerivedV, DerivedF, 3> {
public:
    EigenTriMesh(const DerivedV& nodes, const DerivedF& triangles)
        : detail::EigenMesh<DerivedV, DerivedF, 3>(nodes, triangles) {}
    EigenTriMesh(const DerivedV&&, const DerivedF&) = delete;
    EigenTriMesh(const DerivedV&, const DerivedF&&) = delete;
    EigenTriMesh(const DerivedV&&, const DerivedF&&) = delete;
};

/// Tetrahedral mesh over the user's matrices: row t of T has the four corners of tetrahedron t. Otherwise as
/// EigenQuadMesh.
template <class DerivedV, class DerivedT>
class EigenTetMesh : public detail::EigenMesh<DerivedV, DerivedT, 4> {
public:
    EigenTetMesh(const DerivedV& nodes, const DerivedT& tets) : detail::EigenMesh<DerivedV, DerivedT, 4>(nodes, tets) {}
    EigenTetMesh(const DerivedV&&, const DerivedT&) = delete;
    EigenTetMesh(const DerivedV&, const DerivedT&&) = delete;
    EigenTetMesh(const DerivedV&&, const DerivedT&&) = delete;
};

template <class V, class F>
struct mesh_access<EigenQuadMesh<V, F>> {
    static std::size_t node_count(const EigenQuadMesh<V, F>& m) { return m.node_count(); }
    static Vec3 node(const EigenQuadMesh<V, F>& m, Index i) { return m.node(i); }
    static std::size_t quad_count(const EigenQuadMesh<V, F>& m) { return m.cell_count(); }
    static QuadCorners quad(const EigenQuadMesh<V, F>& m, Index q) { return m.cell(q); }
};

template <class V, class H>
struct mesh_access<EigenHexMesh<V, H>> {
    static std::size_t node_count(const EigenHexMesh<V, H>& m) { return m.node_count(); }
    static Vec3 node(const EigenHexMesh<V, H>& m, Index i) { return m.node(i); }
    static std::size_t hex_count(const EigenHexMesh<V, H>& m) { return m.cell_count(); }
    static HexCorners hex(const EigenHexMesh<V, H>& m, Index h) { return m.cell(h); }
};

template <class V, class F>
struct mesh_access<EigenTriMesh<V, F>> {
    static std::size_t node_count(const EigenTriMesh<V, F>& m) { return m.node_count(); }
    static Vec3 node(const EigenTriMesh<V, F>& m, Index i) { return m.node(i); }
    static std::size_t triangle_count(const EigenTriMesh<V, F>& m) { return m.cell_count(); }
    static TriCorners triangle(const EigenTriMesh<V, F>& m, Index t) { return m.cell(t); }
};

template <class V, class T>
struct mesh_access<EigenTetMesh<V, T>> {
    static std::size_t node_count(const EigenTetMesh<V, T>& m) { return m.node_count(); }
    static Vec3 node(const EigenTetMesh<V, T>& m, Index i) { return m.node(i); }
    static std::size_t tet_count(const EigenTetMesh<V, T>& m) { return m.cell_count(); }
    static TetCorners tet(const EigenTetMesh<V, T>& m, Index t) { return m.cell(t); }
};

}  // namespace pavior
