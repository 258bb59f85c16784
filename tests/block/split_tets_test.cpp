#include "support/catch.hpp"
#include "support/tet_meshes.hpp"

#include <pavior/block/split_tets.hpp>
#include <pavior/mesh/boundary_quads.hpp>
#include <pavior/mesh/quality.hpp>
#include <pavior/mesh/verify_hexes.hpp>
#include <pavior/mesh/verify_tets.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <span>

using namespace pavior;

namespace {

/// A voxel solid as tetrahedra with the boundary triangles tagged by the direction that they look in, and the edges
/// along x at y = z = 0.
TaggedTetMesh tagged(const tet_meshes::Voxels& voxels) {
    TaggedTetMesh result;
    result.mesh = tet_meshes::tetrahedra(voxels).mesh;
    const TetTopology topology = tet_topology(result.mesh);
    for (const Index f : IndexRange(topology.faces.size())) {
        if (topology.boundary(f)) {
            const Index t = topology.face_tets[f][0];
            const TriCorners c =
                detail::tet_face(result.mesh.tets[t], static_cast<std::size_t>(detail::local_face(topology, t, f)));
            const auto& x = result.mesh.nodes;
            const Vec3 n = (x[c[1]] - x[c[0]]).cross(x[c[2]] - x[c[0]]);
            Eigen::Index axis = 0;
            n.cwiseAbs().maxCoeff(&axis);
            result.triangles.push_back({c, static_cast<std::int32_t>(2 * axis + (n[axis] > 0 ? 1 : 0))});
        }
    }
    for (const auto& [a, b] : topology.edges) {
        const Vec3 &x = result.mesh.nodes[a], &y = result.mesh.nodes[b];
        if (x.tail<2>() == Eigen::Vector2d::Zero() && y.tail<2>() == Eigen::Vector2d::Zero()) {
            result.edges.push_back({{b, a}, 7});
        }
    }
    return result;
}

tet_meshes::Voxels l_shape() {
    return tet_meshes::voxels({3, 2, 2}, [](Index i, Index, Index k) { return i < 2 || k == 0; });
}

}  // namespace

TEST_CASE("a regular tetrahedron becomes four hexahedra whose corners are as the formulas say") {
    TaggedTetMesh tet;
    tet.mesh.nodes = {Vec3(1, 1, 1), Vec3(-1, 1, -1), Vec3(1, -1, -1), Vec3(-1, -1, 1)};
    tet.mesh.tets = {{0, 1, 2, 3}};
    REQUIRE(verify_tets(tet.mesh).ok());
    for (std::size_t k = 0; k < 4; ++k) {
        tet.triangles.push_back({detail::tet_face(tet.mesh.tets[0], k), static_cast<std::int32_t>(k)});
    }
    const SplitTets split = split_tets(tet);
    CHECK(split.first == std::array<Index, 5>{0, 4, 10, 14, 15});
    REQUIRE(split.mesh.hexes.size() == 4);
    CHECK(split.quads.size() == 12);
    CHECK(verify_hexes(split.mesh, std::span<const QuadCorners>(split.quads)).ok());
    // Three edges at 60 degrees; the dihedral angle, arccos(1/3), at the middle of an edge; 120 degrees beside a right
    // angle at the centroid of a triangle; three directions at arccos(-1/3) in the middle.
    const std::array corner{std::sqrt(0.5), std::sqrt(8.0) / 3, std::sqrt(0.75), 4 / std::sqrt(27.0)};
    for (const HexCorners& hex : split.mesh.hexes) {
        HexPoints x;
        for (std::size_t i = 0; i < 8; ++i) {
            x[i] = split.mesh.nodes[hex[i]];
        }
        CHECK(hex_volume(x) == Approx(8.0 / 3 / 4));
        CHECK(hex_scaled_jacobian(x) == Approx(std::sqrt(0.5)));
        for (const auto& [at, want] : {std::pair(0U, corner[0]), {1U, corner[1]}, {2U, corner[2]}, {6U, corner[3]}}) {
            std::array<Vec3, 3> u;
            for (std::size_t k = 0; k < 3; ++k) {
                u[k] = (x[static_cast<std::size_t>(hex_corner_neighbours[at][k])] - x[at]).normalized();
            }
            CHECK(u[0].cross(u[1]).dot(u[2]) == Approx(want));
        }
    }
}

TEST_CASE("counts, conformity, volume, tags and chains of a solid with a concave edge") {
    const TaggedTetMesh tets = tagged(l_shape());
    const TetTopology topology = tet_topology(tets.mesh);
    const SplitTets split = split_tets(tets);
    CHECK(split.mesh.hexes.size() == 4 * tets.mesh.tets.size());
    CHECK(split.quads.size() == 3 * tets.triangles.size());
    CHECK(split.first[4] == split.mesh.nodes.size());
    CHECK(split.first[2] - split.first[1] == topology.edges.size());
    CHECK(split.first[3] - split.first[2] == topology.faces.size());
    const HexReport report = verify_hexes(split.mesh, std::span<const QuadCorners>(split.quads));
    INFO(report.text());
    CHECK(report.ok());
    CHECK(report.volume == Approx(10.0).epsilon(1e-12));
    CHECK(report.boundary_quads == split.quads.size());
    CHECK(hex_quality(split.mesh).inverted == 0);
    std::map<std::int32_t, double> area;
    for (std::size_t q = 0; q < split.quads.size(); ++q) {
        const auto& x = split.mesh.nodes;
        const QuadCorners& c = split.quads[q];
        const Vec3 normal = 0.5 * (x[c[2]] - x[c[0]]).cross(x[c[3]] - x[c[1]]);
        const Eigen::Index axis = split.quad_tags[q] / 2;
        CHECK((normal[axis] > 0) == (split.quad_tags[q] % 2 == 1));
        area[split.quad_tags[q]] += normal.norm();
        CHECK(split.quad_tags[q] == tets.triangles[q / 3].tag);
    }
    CHECK(area[0] == Approx(4));
    CHECK(area[2] == Approx(5));
    CHECK(area[5] == Approx(6));
    REQUIRE(split.edges.size() == 2 * tets.edges.size());
    for (std::size_t i = 0; i < tets.edges.size(); ++i) {
        const auto& x = split.mesh.nodes;
        CHECK(split.edges[2 * i].nodes[0] == tets.edges[i].nodes[0]);
        CHECK(split.edges[2 * i + 1].nodes[1] == tets.edges[i].nodes[1]);
        CHECK(split.edges[2 * i].nodes[1] == split.edges[2 * i + 1].nodes[0]);
        CHECK(x[split.edge_node(i)] == 0.5 * (x[tets.edges[i].nodes[0]] + x[tets.edges[i].nodes[1]]));
        CHECK(split.edges[2 * i].tag == 7);
    }
    const TriCorners& c = tets.triangles[5].nodes;
    const auto& x = split.mesh.nodes;
    CHECK((x[split.triangle_node(5)] - (x[c[0]] + x[c[1]] + x[c[2]]) / 3.0).norm() < 1e-15);
}

TEST_CASE("facets between solids get quads too, and hexahedra know their tetrahedron by their number") {
    TaggedTetMesh tets = tagged(tet_meshes::box(2, 1, 1));
    const std::size_t outer = tets.triangles.size();
    const TetTopology topology = tet_topology(tets.mesh);
    for (const TriCorners& c : topology.faces) {
        const bool wall = std::all_of(c.begin(), c.end(), [&](Index i) { return tets.mesh.nodes[i].x() == 1.0; });
        if (wall) {
            tets.triangles.push_back({c, 99});
        }
    }
    REQUIRE(tets.triangles.size() == outer + 2);
    const SplitTets split = split_tets(tets);
    CHECK(std::count(split.quad_tags.begin(), split.quad_tags.end(), 99) == 6);
    CHECK(boundary_quads(split.mesh).size() == 3 * outer);
    for (std::size_t h = 0; h < split.mesh.hexes.size(); ++h) {
        CHECK(split.mesh.hexes[h][0] == tets.mesh.tets[h / 4][h % 4]);
        CHECK(split.mesh.hexes[h][6] == split.first[3] + h / 4);
    }
}

TEST_CASE("a foreign mesh, the smallest type, and any number of threads give the same bytes") {
    const ReferenceMesh reference = tet_meshes::reference(tet_meshes::box(2, 2, 1));
    const SplitTets ours = split_tets(reference, reference.patches);
    const archetype::Tets tets(reference);
    const SplitTets other = split_tets(tets, reference.patches, {}, {3});
    CHECK(other.mesh.nodes == ours.mesh.nodes);
    CHECK(other.mesh.hexes == ours.mesh.hexes);
    CHECK(other.quads == ours.quads);
    std::vector<std::array<float, 3>> points;  // single precision, arrays of another type
    std::vector<std::array<int, 4>> corners;
    for (const Vec3& x : reference.nodes) {
        points.push_back({static_cast<float>(x[0]), static_cast<float>(x[1]), static_cast<float>(x[2])});
    }
    for (const TetCorners& c : reference.tets) {
        corners.push_back(
            {static_cast<int>(c[0]), static_cast<int>(c[1]), static_cast<int>(c[2]), static_cast<int>(c[3])});
    }
    const SplitTets foreign = split_tets(TetMeshView{points, corners}, reference.patches);
    CHECK(foreign.mesh.hexes == ours.mesh.hexes);
    CHECK(verify_hexes(foreign.mesh, std::span<const QuadCorners>(foreign.quads)).ok());
    const tet_meshes::VoxelTets large = tet_meshes::tetrahedra(tet_meshes::box(12, 10, 8));
    const SplitTets one = split_tets(large.mesh);
    const SplitTets three = split_tets(large.mesh, {}, {}, {3});
    CHECK(one.mesh.nodes == three.mesh.nodes);
    CHECK(one.mesh.hexes == three.mesh.hexes);
    CHECK(one.quads.empty());
}

TEST_CASE("what is none of the tetrahedra is refused by its number; no tetrahedra give no hexahedra") {
    TaggedTetMesh tets = tagged(tet_meshes::box(1, 1, 1));
    CHECK(split_tets(TaggedTetMesh{}).mesh.hexes.empty());
    const auto refused = [](const TaggedTetMesh& mesh, std::int64_t id) {
        try {
            static_cast<void>(split_tets(mesh));
        } catch (const InputError& error) {
            return error.code() == ErrorCode::bad_index && error.ids() == Error::Ids{id};
        }
        return false;
    };
    TaggedTetMesh bad = tets;
    bad.triangles[3].nodes[1] = bad.triangles[3].nodes[0];
    CHECK(refused(bad, 3));
    bad = tets;
    bad.edges.push_back({{0, 1000}, 1});
    CHECK(refused(bad, 1));
    bad = tets;
    bad.mesh.tets[2] = {0, 1, 2, 99};
    CHECK(refused(bad, 2));
}
