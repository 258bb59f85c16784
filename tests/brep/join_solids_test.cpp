#include <pavior/brep/join_solids.hpp>

#include "support/catch.hpp"
#include "support/test_brep.hpp"

#include <pavior/brep/neighbour_boundary.hpp>
#include <pavior/mesh/verify_hexes.hpp>

using namespace pavior;
using namespace pavior::test;

namespace {

/// Two unit cubes, one on the other; face `shared` is the first.
struct Pair {
    TestBrep b;
    FaceId shared;
    SolidId low, high;

    Pair() {
        std::array<std::array<VertexId, 4>, 3> v;
        for (std::size_t k = 0; k < 3; ++k) {
            const auto z = static_cast<double>(k);
            v[k] = {b.vertex({0, 0, z}), b.vertex({1, 0, z}), b.vertex({1, 1, z}), b.vertex({0, 1, z})};
        }
        const auto flat = [&](std::size_t k) { return b.flat_polygon({v[k][0], v[k][1], v[k][2], v[k][3]}); };
        const auto walls = [&](std::size_t k, std::vector<OrientedFace> faces) {
            for (std::size_t i = 0; i < 4; ++i) {
                const std::size_t j = (i + 1) % 4;
                faces.push_back({b.flat_polygon({v[k][i], v[k][j], v[k + 1][j], v[k + 1][i]}), true});
            }
            return b.solid(std::move(faces));
        };
        shared = flat(1);
        low = walls(0, {{flat(0), false}, {shared, true}});
        high = walls(1, {{shared, false}, {flat(2), true}});
    }
};

/// A grid of n x n x n hexahedra in the cube at z; the mesh of face `shared` (at z = 1) as its only quads.
SolidsMesh grid(const Pair& pair, SolidId solid, double z, Index n, double shift = 0) {
    SolidsMesh result;
    const auto id = [n](Index i, Index j, Index k) { return i + (n + 1) * (j + (n + 1) * k); };
    for (Index k = 0; k <= n; ++k) {
        for (Index j = 0; j <= n; ++j) {
            for (Index i = 0; i <= n; ++i) {
                const bool inner = i > 0 && i < n && j > 0 && j < n;
                result.mesh.nodes.emplace_back(Vec3(i, j, k) / n + Vec3(inner ? shift : 0.0, 0, z));
            }
        }
    }
    const auto at = static_cast<Index>(z < 0.5 ? n : 0);
    for (Index k = 0; k < n; ++k) {
        for (Index j = 0; j < n; ++j) {
            for (Index i = 0; i < n; ++i) {
                result.mesh.hexes.push_back({id(i, j, k), id(i + 1, j, k), id(i + 1, j + 1, k), id(i, j + 1, k),
                                             id(i, j, k + 1), id(i + 1, j, k + 1), id(i + 1, j + 1, k + 1),
                                             id(i, j + 1, k + 1)});
                result.hex_solid.push_back(solid);
                if (k == 0) {
                    result.quads.push_back({id(i, j, at), id(i + 1, j, at), id(i + 1, j + 1, at), id(i, j + 1, at)});
                    result.quad_face.push_back(pair.shared);
                }
            }
        }
    }
    return result;
}

}  // namespace

TEST_CASE("a mesh that keeps its neighbour's nodes is joined to it") {
    const Pair pair;
    SolidsMesh mesh = grid(pair, pair.low, 0, 3);
    const BoundaryMesh given =
        neighbour_boundary(pair.b, mesh.mesh.nodes, mesh.quads, mesh.quad_face, std::vector{pair.shared});
    const SolidsMesh other = grid(pair, pair.high, 1, 3);
    const std::vector<Index> same = given_nodes(pair.b, std::array{pair.high}, other, given);
    CHECK(std::count(same.begin(), same.end(), no_index) == 64 - 16);
    join_solids(other, same, given, mesh);
    CHECK(mesh.mesh.nodes.size() == 128 - 16);
    CHECK(mesh.quads.size() == 9);
    CHECK(mesh.hex_solid.back() == pair.high);
    const HexReport report = verify_hexes(mesh.mesh);
    INFO(report.text());
    CHECK(report.ok());
    CHECK(report.volume == Approx(2));
}

TEST_CASE("a mesh that differs on the shared face, or along its edges, is refused with the name") {
    const Pair pair;
    const SolidsMesh mesh = grid(pair, pair.low, 0, 3);
    const BoundaryMesh given =
        neighbour_boundary(pair.b, mesh.mesh.nodes, mesh.quads, mesh.quad_face, std::vector{pair.shared});
    const auto face = Catch::Contains("face " + std::to_string(pair.b.tag(2, pair.shared.index())));
    CHECK_THROWS_WITH(given_nodes(pair.b, std::array{pair.high}, grid(pair, pair.high, 1, 3, 0.01), given), face);
    CHECK_THROWS_WITH(given_nodes(pair.b, std::array{pair.high}, grid(pair, pair.high, 1, 6), given), face);
    BoundaryMesh edges = given;
    edges.faces[pair.shared.index()] = {};
    CHECK_THROWS_WITH(given_nodes(pair.b, std::array{pair.high}, grid(pair, pair.high, 1, 6), edges),
                      Catch::Contains("edge "));
    CHECK_NOTHROW(given_nodes(pair.b, std::array{pair.high}, grid(pair, pair.high, 1, 3, 0.01), edges));
}
